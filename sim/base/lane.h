// lane.h - how many vehicles are moved side by side, where the processor can.
#ifndef SIM_BASE_LANE_H
#define SIM_BASE_LANE_H

#include <stdbool.h>

#define LANES 8

// Whether this processor has what lane.hpp needs.
static inline bool lane_possible(void) {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx2");
#else
  return false;
#endif
}

#endif
