// lane.hpp - numbers of eight vehicles side by side: C that follows this header is compiled for eight, as
// each `double` stands for eight. Exactly one source may include it, first and outside of every namespace;
// the code that follows belongs in a namespace of its own, so that its names do not collide with those for
// one vehicle.
//
// Each lane gets the bits that it would get alone: the same operations in the same order, nothing fused.
// Where code branches on a number, the lanes may disagree. The minority then leaves: `lanes_in` holds the
// lanes that remain, the results of the others are meaningless from there on, and the caller moves those one
// by one. So whatever compiles is correct. Code on which lanes often disagree is slow and should use where()
// instead of `? :` (base/where.h). Needs AVX2 (-mavx2); with AVX-512 (-mavx512f) eight numbers are one
// register, not two.
#ifndef SIM_BASE_LANE_HPP
#define SIM_BASE_LANE_HPP

#include "base/lane.h"

// All headers that use a plain double.
#include <immintrin.h>
#include <limits.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Include guards of headers that lanes replace by their own version, below.
#define SIM_BASE_PAIR_H
#define SIM_BASE_WHERE_H

namespace {

#define LANE inline __attribute__((always_inline))

typedef double number_t; // of one vehicle

// The lanes (bits 0 to 7) that took part in every branch so far.
thread_local unsigned lanes_in = 0;

// A comparison used as a condition: returns what most lanes say; the other lanes leave.
LANE bool vote(unsigned of_lanes) {
  const unsigned say = of_lanes & lanes_in;
  if (say == 0 || say == lanes_in) return say != 0;
  const bool most = 2 * __builtin_popcount(say) >= __builtin_popcount(lanes_in);
  lanes_in = most ? say : lanes_in & ~say;
  return most;
}

// The operations for which a processor has instructions.
#ifdef __AVX512F__
#include "base/lane_512.hpp"
#else
#include "base/lane_256.hpp"
#endif

LANE lane_t &operator+=(lane_t &a, lane_t b) {
  return a = a + b;
}
LANE lane_t &operator-=(lane_t &a, lane_t b) {
  return a = a - b;
}
LANE lane_t &operator*=(lane_t &a, lane_t b) {
  return a = a * b;
}
LANE lane_t &operator/=(lane_t &a, lane_t b) {
  return a = a / b;
}

LANE bool any_of(truth_t holds) {
  return (holds.bits() & lanes_in) != 0;
}
// Lanes that have left may have any i.
LANE lane_t element_at(const lane_t *list, lane_t i) {
  number_t x[LANES], at[LANES];
  memcpy(at, &i, sizeof at);
  for (int k = 0; k < LANES; k++) x[k] = lanes_in >> k & 1 ? ((const number_t *)&list[(int)at[k]])[k] : 0.0;
  return lane_of(x);
}

// --- the C library -------------------------------------------------------------------------------------

// Calls the library lane by lane.
template <typename f_t> LANE lane_t each(f_t f, lane_t a, lane_t b) {
  number_t x[LANES], y[LANES];
  memcpy(x, &a, sizeof x);
  memcpy(y, &b, sizeof y);
  for (int i = 0; i < LANES; i++) x[i] = f(x[i], y[i]);
  memcpy(&a, x, sizeof x);
  return a;
}
#define LANE_FUNCTION(name)                                                                                  \
  LANE lane_t name(lane_t a) {                                                                               \
    return each([](number_t x, number_t) { return ::name(x); }, a, a);                                       \
  }
#define LANE_FUNCTION_OF_TWO(name)                                                                           \
  LANE lane_t name(lane_t a, lane_t b) {                                                                     \
    return each([](number_t x, number_t y) { return ::name(x, y); }, a, b);                                  \
  }
LANE_LIBRARY(LANE_FUNCTION)
LANE_FUNCTION(floor)
LANE_FUNCTION(ceil)
LANE_FUNCTION(trunc)
LANE_LIBRARY_OF_TWO(LANE_FUNCTION_OF_TWO)

LANE truth_t isfinite(lane_t a) {
  return fabs(a) < lane_t(HUGE_VAL);
}
LANE truth_t isnan(lane_t a) {
  return a != a;
}

inline lane_t::operator int() const {
  number_t x[LANES];
  memcpy(x, this, sizeof x);
  const int first = (int)x[__builtin_ctz(lanes_in | 1u << LANES) % LANES];
  for (int i = 0; i < LANES; i++)
    if ((int)x[i] != first) lanes_in &= ~(1u << i);
  return first;
}

typedef lane_t pair_number_t;
typedef truth_t pair_flag_t;
#include "base/lane_pair.hpp"
#include "base/lane_leave.hpp"

} // namespace

#define double lane_t

#endif
