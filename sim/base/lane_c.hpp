// lane_c.hpp - C compiled for eight vehicles side by side: in code after this header every number, flag and
// enum is eight, one per vehicle. The build puts it before each such source (tools/lanes.sed), which then
// stands in the namespace `lanes`.
//
// Each lane gets the bits that it would get alone: the same operations in the same order, nothing fused.
// Where code branches, the lanes may disagree. The minority then leaves: `lanes_in` holds the lanes that
// remain, the results of the others are meaningless from there on, and the caller repeats the work for those,
// one by one. So whatever compiles is correct. Code on which lanes often disagree is slow and should use
// either() instead of `? :` (base/either.h).
//
// One thing differs from C: && and || of flags for eight evaluate both sides. So operands with side effects
// must not stand there.
#ifndef SIM_BASE_LANE_C_HPP
#define SIM_BASE_LANE_C_HPP

#include "base/lane.h"

// All headers that use plain numbers.
#include <atomic>
#include <concepts>
#include <float.h>
#include <immintrin.h>
#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <type_traits>

// Include guards of headers that lanes replace by their own version, below.
#define SIM_BASE_PAIR_H
#define SIM_BASE_EITHER_H
#define SIM_BASE_WHERE_H

#ifdef LANE_FIELDS // numbers that report their place (lane_fields.h)
#include "base/lane_fields.h"
#define lanes lane_fields
#define LANE_MADE(me, kind)                                                                                  \
  me() {                                                                                                     \
    lane_note(this, kind);                                                                                   \
  }
#else
#define LANE_MADE(me, kind) me() = default;
#endif

namespace lanes {

#define LANE inline __attribute__((always_inline))

// The lanes (bits 0 to 7) that took part in every branch so far.
inline constinit thread_local unsigned lanes_in = 0;

typedef int plain_int; // of a loop
typedef int alike_t;   // base/either.h
typedef unsigned plain_unsigned;
typedef float plain_float;
typedef double plain_double;

typedef int32_t words_t __attribute__((vector_size(32)));
typedef uint32_t uwords_t __attribute__((vector_size(32)));
typedef float floats_t __attribute__((vector_size(32)));
typedef double doubles_t __attribute__((vector_size(32)));
typedef int64_t longs_t __attribute__((vector_size(32)));

template <typename T>
concept plain = std::is_arithmetic_v<T> || std::is_enum_v<T>;
template <typename T>
concept plain_whole = std::is_integral_v<T> || std::is_enum_v<T>;

} // namespace lanes

// The order matters.
// clang-format off
#include "base/lane_whole.hpp"
#include "base/lane_number.hpp"
// clang-format on

namespace lanes {

typedef lane_double_t pair_number_t;
typedef lane_wide_flag_t pair_flag_t;
#include "base/lane_pair.hpp"
#include "base/lane_leave.hpp"

// What C has and C++ lacks, or defines differently.
typedef lane_int_t int32_t;
typedef lane_unsigned_t uint32_t;
typedef lane_small_t<::int16_t> int16_t;
typedef lane_small_t<::uint16_t> uint16_t;
typedef lane_small_t<::int8_t> int8_t;
typedef lane_small_t<::uint8_t> uint8_t;
using std::atomic_signal_fence;
using std::memory_order_seq_cst;

} // namespace lanes

#define volatile
#define _Alignas(n) // lanes are aligned to more
#define _Thread_local constinit thread_local
#define _Static_assert static_assert
#define float lane_float_t
#define double lane_double_t
#define int lane_int_t
#define unsigned lane_unsigned_t
#define bool lane_flag_t

#endif
