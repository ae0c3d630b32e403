// lane.hpp - numbers of eight vehicles side by side, and C compiled for them: after this header a `double` is
// eight. To be included by one source alone, first and outside of every namespace; what follows it belongs
// into a namespace of its own, so that nothing of it meets the same names for one vehicle.
//
// Each lane gets the bits that it would get alone: the same operations in the same order, nothing fused.
// Where code branches on a number, the lanes may part. Those that are fewer leave: `lanes_in` says who is
// still in, what the others compute from there on is of no use, and the caller moves them one by one. So what
// compiles is right; what parts them often is slow, and says where() in place of `? :` (base/where.h).
// Needs AVX2 (-mavx2); with AVX-512 (-mavx512f) eight numbers are one register, not two.
#ifndef SIM_BASE_LANE_HPP
#define SIM_BASE_LANE_HPP

#include "base/lane.h"

// All that knows a plain double.
#include <immintrin.h>
#include <limits.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The places of headers of which lanes have their own: see below.
#define SIM_BASE_PAIR_H
#define SIM_BASE_WHERE_H

namespace {

#define LANE inline __attribute__((always_inline))

typedef double number_t; // of one vehicle

// Lanes 0 to 7 that took part in every branch so far.
thread_local unsigned lanes_in = 0;

// As a condition a comparison is what most lanes say; the others leave.
LANE bool vote(unsigned of_lanes) {
  const unsigned say = of_lanes & lanes_in;
  if (say == 0 || say == lanes_in) return say != 0;
  const bool most = 2 * __builtin_popcount(say) >= __builtin_popcount(lanes_in);
  lanes_in = most ? say : lanes_in & ~say;
  return most;
}

// What of them a processor has instructions for.
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
// Who is not in may have any i.
LANE lane_t element_at(const lane_t *list, lane_t i) {
  number_t x[LANES], at[LANES];
  memcpy(at, &i, sizeof at);
  for (int k = 0; k < LANES; k++) x[k] = lanes_in >> k & 1 ? ((const number_t *)&list[(int)at[k]])[k] : 0.0;
  return lane_of(x);
}

// --- the C library's -----------------------------------------------------------------------------------

// One by one, by the library itself.
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
LANE_FUNCTION(sin)
LANE_FUNCTION(cos)
LANE_FUNCTION(tan)
LANE_FUNCTION(asin)
LANE_FUNCTION(acos)
LANE_FUNCTION(atan)
LANE_FUNCTION(sinh)
LANE_FUNCTION(cosh)
LANE_FUNCTION(tanh)
LANE_FUNCTION(exp)
LANE_FUNCTION(exp2)
LANE_FUNCTION(expm1)
LANE_FUNCTION(log)
LANE_FUNCTION(log2)
LANE_FUNCTION(log10)
LANE_FUNCTION(log1p)
LANE_FUNCTION(cbrt)
LANE_FUNCTION(erf)
LANE_FUNCTION(floor)
LANE_FUNCTION(ceil)
LANE_FUNCTION(round)
LANE_FUNCTION(trunc)
LANE_FUNCTION_OF_TWO(pow)
LANE_FUNCTION_OF_TWO(hypot)
LANE_FUNCTION_OF_TWO(atan2)
LANE_FUNCTION_OF_TWO(fmod)
LANE_FUNCTION_OF_TWO(copysign)
LANE_FUNCTION_OF_TWO(fmin)
LANE_FUNCTION_OF_TWO(fmax)

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

// --- base/pair.h: two numbers of every lane ---------------------------------------------------------------

struct pair_truth_t {
  truth_t a[2];
};
struct pair_t {
  lane_t a[2];
  LANE lane_t operator[](int i) const { return a[i]; }
};
#define LANE_PAIR(sign)                                                                                      \
  LANE pair_t operator sign(pair_t x, pair_t y) {                                                            \
    return {{x.a[0] sign y.a[0], x.a[1] sign y.a[1]}};                                                       \
  }                                                                                                          \
  LANE pair_t operator sign(lane_t x, pair_t y) {                                                            \
    return {{x sign y.a[0], x sign y.a[1]}};                                                                 \
  }                                                                                                          \
  LANE pair_t operator sign(pair_t x, lane_t y) {                                                            \
    return {{x.a[0] sign y, x.a[1] sign y}};                                                                 \
  }                                                                                                          \
  LANE pair_t &operator sign##=(pair_t &x, pair_t y) {                                                       \
    return x = x sign y;                                                                                     \
  }
LANE_PAIR(+)
LANE_PAIR(-)
LANE_PAIR(*)
LANE_PAIR(/)
LANE pair_truth_t operator<(pair_t x, pair_t y) {
  return {{x.a[0] < y.a[0], x.a[1] < y.a[1]}};
}
LANE pair_truth_t operator>(pair_t x, pair_t y) {
  return {{x.a[0] > y.a[0], x.a[1] > y.a[1]}};
}

LANE pair_t pair_of(const lane_t *p) {
  return {{p[0], p[1]}};
}
LANE void pair_put(lane_t *p, pair_t x) {
  p[0] = x.a[0];
  p[1] = x.a[1];
}
LANE pair_t pair_both(lane_t x) {
  return {{x, x}};
}
LANE lane_t pair_sum(pair_t x) {
  return x.a[0] + x.a[1];
}
LANE pair_t pair_where(pair_truth_t holds, pair_t x, pair_t y) {
  return {{where(holds.a[0], x.a[0], y.a[0]), where(holds.a[1], x.a[1], y.a[1])}};
}
LANE pair_t pair_min(pair_t x, pair_t y) {
  return pair_where(x < y, x, y);
}
LANE pair_t pair_max(pair_t x, pair_t y) {
  return pair_where(x > y, x, y);
}
LANE pair_t pair_sqrt(pair_t x) {
  return {{sqrt(x.a[0]), sqrt(x.a[1])}};
}
LANE pair_t pair_exp2_of_bits(pair_t x) {
  return {{exp2_of_bits(x.a[0]), exp2_of_bits(x.a[1])}};
}

} // namespace

#define double lane_t

#endif
