// lane_one.hpp - C compiled for one vehicle, with numbers that report their place in a struct, to match them
// one by one with those of the same struct for eight vehicles (base/lane_c.hpp). Nothing computes with it.
#ifndef SIM_BASE_LANE_ONE_HPP
#define SIM_BASE_LANE_ONE_HPP

#include "base/lane_fields.h"

#include <atomic>
#include <concepts>
#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <type_traits>

#define SIM_BASE_PAIR_H
#define SIM_BASE_FEW_H
#define SIM_BASE_EITHER_H
#define SIM_BASE_WHERE_H

namespace lane_one {

typedef int plain_int;
typedef unsigned plain_unsigned;
typedef int alike_t;

template <typename T> struct number {
  T v;
  number() { lane_note(this, lane_field_kind<T>); }
  template <typename U>
  requires std::is_convertible_v<U, T> number(U a) : v((T)a) {}
  operator T() const { return v; }
  template <typename U> number &operator+=(U a) { return *this = number((T)(v + (T)a)); }
  template <typename U> number &operator-=(U a) { return *this = number((T)(v - (T)a)); }
  template <typename U> number &operator|=(U a) { return *this = number((T)(v | (T)a)); }
};
template <typename E> struct lane_kind_t : number<int> {
  using number<int>::number;
  operator E() const { return (E)v; }
};

template <typename A, typename B> auto either(bool holds, A a, B b) {
  return holds ? a : A(b);
}
#define EITHER(holds, a, b) either((bool)(holds), a, b)
#define PICK(list, i)       ((list)[i])
inline double where(bool holds, double a, double b) {
  return holds ? a : b;
}

typedef number<::int32_t> int32_t;
typedef number<::uint32_t> uint32_t;
typedef number<::int16_t> int16_t;
typedef number<::uint16_t> uint16_t;
typedef number<::int8_t> int8_t;
typedef number<::uint8_t> uint8_t;

} // namespace lane_one

#define volatile
#define _Alignas(n) alignas(n)
#define _Thread_local constinit thread_local
#define _Static_assert static_assert
typedef float plain_float;
typedef double plain_double;
typedef bool plain_bool;
#define float number<plain_float>
#define double number<plain_double>
#define int number<plain_int>
#define unsigned number<plain_unsigned>
#define bool number<plain_bool>

#endif
