// pace.c - how far the flight should be, by the wall clock.
#define _POSIX_C_SOURCE 200809L // clock_gettime
#include "desk/pace.h"

#include <time.h>

double pace_wall_s(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

pace_t pace_begin(double speed, double wall_s, double at_s) {
  return (pace_t){.speed = speed, .begin_s = wall_s - at_s / speed};
}

double pace_until_s(pace_t *p, double wall_s, double at_s) {
  p->behind_s = wall_s - p->begin_s - at_s / p->speed;
  if (p->behind_s > PACE_BEHIND_S) p->begin_s += p->behind_s - PACE_BEHIND_S;
  return p->speed * (wall_s - p->begin_s);
}
