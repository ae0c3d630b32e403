// target.c - the image for the emulated Cortex-M4F: reads records, writes answers and the cost of each call.
//
// Command line by semihosting: IN OUT COST BATCH. Answers are written after every BATCH records, so that a
// BATCH of 1 closes a loop over two pipes. COST (`-`: none) gets two words per call: ticks of SysTick, and
// bytes of stack below the caller.
#include "pil/pil.h"

#include <stdlib.h>
#include <string.h>

#define BATCH_MAX   64
#define STACK_BYTES 4096u
#define PAINT       0xa5a5a5a5u
#define REG(at)     (*(volatile uint32_t *)(at))
#define CPACR       REG(0xE000ED88)
#define SYST_CSR    REG(0xE000E010)
#define SYST_RVR    REG(0xE000E014)
#define SYST_CVR    REG(0xE000E018)

extern uint32_t data_start[], data_end[], data_load[], bss_start[], bss_end[], stack_top[];
void reset(void);
static void fault(void);

__attribute__((section(".vectors"), used)) static void *const vectors[16] = {
    stack_top, (void *)reset, (void *)fault, (void *)fault, (void *)fault, (void *)fault, (void *)fault};

// --- semihosting ------------------------------------------------------------------------------------------

enum { SYS_OPEN = 1, SYS_CLOSE = 2, SYS_WRITE = 5, SYS_READ = 6, SYS_GET_CMDLINE = 0x15, SYS_EXIT = 0x18 };

static int call(int number, const void *argument) {
  register int r0 __asm__("r0") = number;
  register const void *r1 __asm__("r1") = argument;
  __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
  return r0;
}

static void stop(void) {
  for (;;) call(SYS_EXIT, (const void *)0x20026); // ADP_Stopped_ApplicationExit
}
static void fault(void) {
  for (;;) call(SYS_EXIT, (const void *)0x20023); // ADP_Stopped_RunTimeErrorUnknown
}

static int open(const char *path, uint32_t mode) {
  const uint32_t argument[3] = {(uint32_t)path, mode, strlen(path)};
  const int file = call(SYS_OPEN, argument);
  if (file < 0) fault();
  return file;
}

// Returns the bytes read: less than wanted only at the end.
static uint32_t read(int file, void *to, uint32_t size) {
  uint32_t done = 0;
  while (done < size) {
    const uint32_t argument[3] = {(uint32_t)file, (uint32_t)to + done, size - done};
    const uint32_t left = (uint32_t)call(SYS_READ, argument);
    if (left >= size - done) break;
    done = size - left;
  }
  return done;
}

static void write(int file, const void *from, uint32_t size) {
  uint32_t argument[3] = {(uint32_t)file, (uint32_t)from, size};
  if (size > 0 && call(SYS_WRITE, argument) != 0) fault();
}

// --- measuring --------------------------------------------------------------------------------------------

static uint32_t used_stack(const uint32_t *top) {
  const uint32_t *lowest = top - STACK_BYTES / 4;
  while (lowest < top && *lowest == PAINT) lowest++;
  return (uint32_t)((const char *)top - (const char *)lowest);
}

// Paints the stack below this frame, calls `what` and measures it. What measuring costs itself is in empty().
__attribute__((noinline)) static void measured(void (*what)(void), uint32_t cost[2]) {
  uint32_t *top;
  __asm__ volatile("mov %0, sp" : "=r"(top));
  for (uint32_t *at = top - STACK_BYTES / 4; at < top - 8; at++) *at = PAINT;
  SYST_CVR = 0;
  const uint32_t from = SYST_CVR;
  what();
  const uint32_t to = SYST_CVR;
  cost[0] = (from - to) & 0xffffffu;
  cost[1] = used_stack(top);
}

__attribute__((noinline)) static void empty(void) {
  __asm__ volatile("");
}

// --- the run ----------------------------------------------------------------------------------------------

static pil_in_t in[BATCH_MAX];
static pil_out_t out[BATCH_MAX];
static uint32_t cost[BATCH_MAX][2];
static const pil_in_t *now;

static void start(void) {
  pil_before(now);
}

static void run(int from, int to, int costs, uint32_t batch) {
  uint32_t none[2] = {0, 0}, first[2];
  if (costs >= 0) {
    measured(empty, none);
    write(costs, none, sizeof none);
  }
  for (;;) {
    const uint32_t n = read(from, in, batch * sizeof *in) / sizeof *in;
    for (uint32_t i = 0; i < n; i++) {
      now = &in[i];
      measured(start, first);
      measured(pil_call, cost[i]);
      if (in[i].flags & PIL_START) cost[i][1] |= first[1] << 16; // stack of selecting it in flight
      pil_after(&out[i]);
    }
    write(to, out, n * sizeof *out);
    if (costs >= 0) write(costs, cost, n * sizeof *cost);
    if (n < batch) return;
  }
}

static char line[512];

static void main_of_target(void) {
  const uint32_t argument[2] = {(uint32_t)line, sizeof line};
  if (call(SYS_GET_CMDLINE, argument) != 0) fault();
  const char *word[5] = {"", "", "", "-", "64"};
  int n = 0;
  for (char *at = line; *at && n < 5; n++) {
    word[n] = at;
    at += strcspn(at, " ");
    if (*at) *at++ = '\0';
  }
  const uint32_t batch = (uint32_t)atoi(word[4]);
  if (n < 5 || batch < 1 || batch > BATCH_MAX) fault();
  const int from = open(word[1], 1), to = open(word[2], 5); // rb, wb
  run(from, to, strcmp(word[3], "-") == 0 ? -1 : open(word[3], 5), batch);
  stop();
}

void reset(void) {
  CPACR |= 0xfu << 20; // the FPU, before the first float instruction
  __asm__ volatile("dsb\nisb");
  const uint32_t *load = data_load;
  for (uint32_t *to = data_start; to < data_end; to++) *to = *load++;
  for (uint32_t *to = bss_start; to < bss_end; to++) *to = 0;
  SYST_RVR = 0xffffff;
  SYST_CSR = 5; // processor clock, no interrupt
  main_of_target();
}
