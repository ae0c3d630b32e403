// threads.c - how threads that share a program's work wait for one another.
#define _POSIX_C_SOURCE 200809L // setenv, execv
#include "base/threads.h"

#include <stdlib.h>
#include <unistd.h>

void threads_sleep(char **argv) {
  if (getenv("OMP_WAIT_POLICY") || getenv("GOMP_SPINCOUNT")) return;
  if (setenv("OMP_WAIT_POLICY", "passive", 0) == 0) (void)execv("/proc/self/exe", argv);
}
