// lane.h - how many vehicles are moved side by side, where the processor can.
#ifndef SIM_BASE_LANE_H
#define SIM_BASE_LANE_H

#include <stdbool.h>

#define LANES 8

// A sanitizer of addresses knows one stack a thread. gcc and clang say in two ways that it is on.
#ifdef __has_feature
#define LANE_SANITIZED __has_feature(address_sanitizer)
#elif defined(__SANITIZE_ADDRESS__)
#define LANE_SANITIZED 1
#else
#define LANE_SANITIZED 0
#endif

// Whether this processor has what lane.hpp needs.
static inline bool lane_possible(void) {
#if defined(__x86_64__) && !LANE_SANITIZED
  return __builtin_cpu_supports("avx2");
#else
  return false;
#endif
}

#endif
