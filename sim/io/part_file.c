// part_file.c - files that do not outlive an interruption.
#define _XOPEN_SOURCE 700 // mkstemp, sigaction
#include "io/part_file.h"

#include <errno.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define NAME_MAX_BYTES 4096

// A signal handler can read nothing but what stands still: `taken` says which names do.
static char names[PART_FILES_MAX][NAME_MAX_BYTES];
static volatile sig_atomic_t taken[PART_FILES_MAX];
static volatile sig_atomic_t holds, waiting;

// Only calls that POSIX allows in a signal handler.
static void interrupted(int number) {
  if (holds > 0) {
    waiting = number;
    return;
  }
  for (int i = 0; i < PART_FILES_MAX; i++)
    if (taken[i]) unlink(names[i]);
  signal(number, SIG_DFL);
  raise(number);
}

static void listen(void) {
  static const int number[] = {SIGINT, SIGTERM, SIGHUP};
  for (unsigned i = 0; i < sizeof number / sizeof *number; i++) {
    struct sigaction old, ours = {.sa_handler = interrupted, .sa_flags = SA_RESTART};
    sigemptyset(&ours.sa_mask);
    const bool free = sigaction(number[i], NULL, &old) == 0 && old.sa_handler == SIG_DFL;
    if (free) sigaction(number[i], &ours, NULL);
  }
}

void part_hold(void) {
  holds++;
}

void part_release(void) {
  holds--;
  if (holds > 0 || !waiting) return;
  const int number = waiting;
  waiting = 0;
  raise(number);
}

// -1: there is none.
static int index_of(const char *name) {
  for (int i = 0; i < PART_FILES_MAX; i++)
    if (name ? taken[i] && strcmp(names[i], name) == 0 : !taken[i]) return i;
  return -1;
}

static void forget(const char *name) {
  const int at = index_of(name);
  if (at >= 0) taken[at] = 0;
}

int part_file_open(char *name) {
  const int at = index_of(NULL);
  if (at < 0 || strlen(name) >= NAME_MAX_BYTES) {
    errno = at < 0 ? EMFILE : ENAMETOOLONG;
    return -1;
  }
  listen();
  part_hold();
  const int file = mkstemp(name);
  if (file >= 0) {
    memcpy(names[at], name, strlen(name) + 1);
    atomic_thread_fence(memory_order_release); // the name first: the handler may run in another thread
    taken[at] = 1;
  }
  part_release();
  return file;
}

void part_file_remove(const char *name) {
  remove(name);
  forget(name);
}

bool part_file_move(const char *name, const char *place) {
  if (rename(name, place) != 0) return false;
  forget(name);
  return true;
}
