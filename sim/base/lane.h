// lane.h - how many vehicles are simulated side by side, and whether the processor can do it.
#ifndef SIM_BASE_LANE_H
#define SIM_BASE_LANE_H

#include <stdbool.h>

#define LANES 8

// C library functions, of one and of two arguments, that are called lane by lane (lane.hpp, lane_c.hpp).
// clang-format off
#define LANE_LIBRARY(X) \
  X(sin) X(cos) X(tan) X(asin) X(acos) X(atan) X(sinh) X(cosh) X(tanh) X(exp) X(exp2) X(expm1) \
  X(log) X(log2) X(log10) X(log1p) X(cbrt) X(erf) X(round)
#define LANE_LIBRARY_OF_TWO(X) X(pow) X(hypot) X(atan2) X(fmod) X(copysign) X(fmin) X(fmax)
// clang-format on

// True if this processor has what lane.hpp needs: AVX2.
static inline bool lane_possible(void) {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx2");
#else
  return false;
#endif
}

// True if it also has what lanes of AVX-512 need; only the first such processors lack it.
static inline bool lane_has_512(void) {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
         __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
#else
  return false;
#endif
}

// The width of the widest registers for lanes, bits; 0: none.
static inline int lane_bits(void) {
#ifdef __x86_64__
  return !lane_possible() ? 0 : lane_has_512() ? 512 : 256;
#else
  return 0;
#endif
}

#endif
