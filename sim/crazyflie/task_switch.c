// task_switch.c - one task of the firmware beside the stabilizer.
#include "task_switch.h"

#include <stdlib.h>
#include <ucontext.h>

#define STACK_BYTES 262144 // sanitizers need much more than the vehicle's 350 words

struct task_switch {
  ucontext_t here, task;
  uint32_t due_ms, now_ms;
  bool runs;
  char stack[STACK_BYTES];
};

task_switch_t *task_open(void (*task)(void)) {
  task_switch_t *const t = calloc(1, sizeof *t);
  if (!t) return NULL;
  getcontext(&t->task);
  t->task.uc_stack.ss_sp = t->stack;
  t->task.uc_stack.ss_size = sizeof t->stack;
  t->task.uc_link = &t->here;
  makecontext(&t->task, task, 0);
  return t;
}

void task_close(task_switch_t *t) {
  free(t);
}

void task_run(task_switch_t *t, uint32_t now_ms) {
  t->now_ms = now_ms;
  if ((int32_t)(now_ms - t->due_ms) < 0) return;
  t->runs = true;
  swapcontext(&t->here, &t->task);
  t->runs = false;
}

void task_rest(task_switch_t *t, uint32_t ms) {
  t->due_ms = t->now_ms + ms;
  swapcontext(&t->task, &t->here);
}

bool task_runs(const task_switch_t *t) {
  return t->runs;
}
