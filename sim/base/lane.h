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

// The widest registers that it has for them; 0: none.
static inline int lane_bits(void) {
#ifdef __x86_64__
  return !lane_possible() ? 0 : __builtin_cpu_supports("avx512f") ? 512 : 256;
#else
  return 0;
#endif
}

#endif
