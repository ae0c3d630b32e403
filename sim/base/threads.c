// threads.c - how threads that share a program's work wait for one another.
#define _POSIX_C_SOURCE 200809L // setenv, readlink, execv
#include "base/threads.h"

#include "base/folder.h"
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#ifdef _OPENMP
static bool is_said(void) {
  const char *const threads = getenv("OMP_NUM_THREADS");
  return getenv("OMP_WAIT_POLICY") || getenv("GOMP_SPINCOUNT") || (threads && strcmp(threads, "1") == 0);
}

// The path, and not the link to it: under that the process would have another name.
void threads_sleep(char **argv) {
  char path[4096];
  const ssize_t n = is_said() ? -1 : readlink("/proc/self/exe", path, sizeof path - 1);
  if (n <= 0 || !argv[0]) return;
  path[n] = '\0';
  if (strcmp(folder_file(path), folder_file(argv[0])) != 0) return;
  if (setenv("OMP_WAIT_POLICY", "passive", 0) == 0) (void)execv(path, argv);
}
#else
void threads_sleep(char **argv) {
  (void)argv;
}
#endif
