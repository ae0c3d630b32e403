// cpu_time.c - the processor time of this thread.
#define _POSIX_C_SOURCE 200809L // clock_gettime
#include "base/cpu_time.h"

#include <math.h>
#include <time.h>

#define LEAST_S 1e-9 // the clock's resolution

double cpu_time_s(void) {
  struct timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double cpu_time_factor(double flight_s, double from_s) {
  return flight_s / fmax(cpu_time_s() - from_s, LEAST_S);
}
