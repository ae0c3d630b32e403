// lane_number.hpp - floats and doubles of eight vehicles, and the C library's functions of them: a part of
// base/lane_c.hpp, which includes it.
#ifndef SIM_BASE_LANE_NUMBER_HPP
#define SIM_BASE_LANE_NUMBER_HPP

namespace lanes {

// --- numbers ---------------------------------------------------------------------------------------------

struct lane_double_t;

struct lane_float_t {
  floats_t v;
  LANE_MADE(lane_float_t, LANE_32)
  constexpr LANE lane_float_t(floats_t a) : v(a) {}
  template <plain T> static constexpr LANE float of(T a) { return (float)a; }
  template <plain T>
  constexpr LANE lane_float_t(T a) : v{of(a), of(a), of(a), of(a), of(a), of(a), of(a), of(a)} {}
  template <typename T> LANE lane_float_t(lane_small_t<T> a) : lane_float_t((lane_int_t)a) {}
  LANE explicit lane_float_t(lane_int_t a) : v(__builtin_convertvector(a.all(), floats_t)) {}
  LANE explicit lane_float_t(lane_unsigned_t a) : v(__builtin_convertvector(a.all(), floats_t)) {}
  LANE explicit lane_float_t(lane_double_t a);
  LANE explicit operator lane_int_t() const { return (words_t)_mm256_cvttps_epi32((__m256)v); }
  LANE explicit operator lane_unsigned_t() const { return (words_t)_mm256_cvttps_epi32((__m256)v); } // < 2^31
  template <typename T> LANE explicit operator lane_small_t<T>() const {
    return lane_small_t<T>((lane_int_t) * this);
  }
};

#ifdef LANES_512
#include "base/lane_double_512.hpp"
#else
#include "base/lane_double_256.hpp"
#endif

#define LANE_NUMBER(sign)                                                                                    \
  LANE lane_float_t operator sign(lane_float_t a, lane_float_t b) {                                          \
    return a.v sign b.v;                                                                                     \
  }                                                                                                          \
  LANE lane_float_t &operator sign##=(lane_float_t &a, lane_float_t b) {                                     \
    return a = a sign b;                                                                                     \
  }                                                                                                          \
  LANE lane_double_t &operator sign##=(lane_double_t &a, lane_double_t b) {                                  \
    return a = a sign b;                                                                                     \
  }
LANE_NUMBER(+)
LANE_NUMBER(-)
LANE_NUMBER(*)
LANE_NUMBER(/)
// Whole numbers together with plain doubles.
#define LANE_MIXED(result, sign)                                                                             \
  template <bool A> LANE result operator sign(plain_double a, lane_whole_t<A> b) {                           \
    return lane_double_t(a) sign lane_double_t(b);                                                           \
  }                                                                                                          \
  template <bool A> LANE result operator sign(lane_whole_t<A> a, plain_double b) {                           \
    return lane_double_t(a) sign lane_double_t(b);                                                           \
  }
#define LANE_COMPARED(sign)                                                                                  \
  LANE lane_flag_t operator sign(lane_float_t a, lane_float_t b) {                                           \
    return (words_t)(a.v sign b.v);                                                                          \
  }
LANE_COMPARED(<)
LANE_COMPARED(<=)
LANE_COMPARED(>)
LANE_COMPARED(>=)
LANE_COMPARED(==)
LANE_COMPARED(!=)
LANE_MIXED(lane_double_t, +)
LANE_MIXED(lane_double_t, -)
LANE_MIXED(lane_double_t, *)
LANE_MIXED(lane_double_t, /)
LANE lane_float_t operator-(lane_float_t a) {
  return -a.v;
}
LANE lane_flag_t operator!(lane_float_t a) {
  return a == 0.0f;
}

// a where the condition holds, elsewhere b. Both are computed.
LANE lane_float_t either(lane_flag_t holds, lane_float_t a, lane_float_t b) {
  return (floats_t)_mm256_blendv_ps((__m256)b.v, (__m256)a.v, (__m256)holds.v);
}
LANE lane_double_t either(lane_flag_t holds, lane_double_t a, lane_double_t b) {
  return either(wide(holds), a, b);
}
LANE lane_flag_t either(lane_flag_t holds, lane_flag_t a, lane_flag_t b) {
  return (holds.v & a.v) | (~holds.v & b.v);
}
template <bool A, bool B>
LANE lane_whole_t<A && B> either(lane_flag_t holds, lane_whole_t<A> a, lane_whole_t<B> b) {
  return (holds.v & a.v) | (~holds.v & b.v);
}
template <typename E> LANE lane_kind_t<E> either(lane_flag_t holds, lane_kind_t<E> a, lane_kind_t<E> b) {
  return lane_kind_t<E>(lane_int_t((holds.v & a.v) | (~holds.v & b.v)));
}
template <typename E>
requires(std::is_enum_v<E>) LANE lane_kind_t<E> lanes_of(E a) {
  return a;
}
LANE lane_float_t lanes_of(plain_float a) {
  return a;
}
LANE lane_double_t lanes_of(plain_double a) {
  return a;
}
LANE lane_int_t lanes_of(plain_int a) {
  return a;
}
LANE lane_unsigned_t lanes_of(plain_unsigned a) {
  return a;
}
template <typename T>
requires(!plain<T>) LANE T lanes_of(T a) {
  return a;
}
// Element i of a list; each lane has its own i.
template <typename T, bool A> LANE T lanes_pick(const T *list, lane_whole_t<A> i) {
  const unsigned first = (unsigned)i.v[0];
  if (lane_flag_t(i == lane_whole_t<A>(first)).bits() == (1u << LANES) - 1) [[likely]]
    return list[first];
  typedef std::conditional_t<sizeof(T) == 64, plain_double, uint32_t> one_t;
  alignas(32) one_t of[LANES];
  alignas(32) uint32_t at[LANES];
  memcpy(at, &i, sizeof at);
  for (int k = 0; k < LANES; k++)
    memcpy(&of[k], (const char *)&list[at[k]] + (size_t)k * sizeof of[k], sizeof of[k]);
  T t;
  memcpy(&t, of, sizeof t);
  return t;
}
template <bool A> LANE void lanes_place(lane_float_t *list, lane_whole_t<A> i, lane_float_t value) {
  alignas(32) uint32_t at[LANES];
  memcpy(at, &i, sizeof at);
  for (int k = 0; k < LANES; k++)
    memcpy((char *)&list[at[k]] + (size_t)k * sizeof at[k], (const char *)&value + (size_t)k * sizeof at[k],
           sizeof at[k]);
}
#define PICK(list, i)         lanes_pick(list, i)
#define PLACE(list, i, value) lanes_place(list, i, value)
#define ANY(holds)            ((lane_flag_t(holds).bits() & lanes_in) != 0)
#define EITHER(holds, a, b)   either(lane_flag_t(holds), lanes_of(a), lanes_of(b))

// Restores the numbers of the lanes `of` to what they were. All numbers have 32 bits.
typedef uwords_t any_words_t __attribute__((may_alias));
inline __attribute__((noinline)) void lanes_undo(unsigned of, void *now, const void *was, size_t bytes) {
  const uwords_t bit = {1, 2, 4, 8, 16, 32, 64, 128}, back = (uwords_t)((bit & of) != 0);
  any_words_t *const to = (any_words_t *)now;
  const any_words_t *const from = (const any_words_t *)was;
  for (size_t i = 0; i < bytes / sizeof *to; i++) to[i] = (from[i] & back) | (to[i] & ~back);
}
// A statement that changes a state only where a condition holds (FOR_WHOM). Lanes that disagree within it
// have left, as anywhere.
template <typename T> struct lanes_some_t {
  T *state;
  unsigned in, say;
  bool todo;
  T was;
  LANE lanes_some_t(lane_flag_t holds, T *of)
      : state(of), in(lanes_in), say(holds.bits() & in), todo(say != 0) {
    static_assert(sizeof(T) % sizeof(words_t) == 0);
    static_assert(alignof(T) < alignof(lane_double_t), "no double in a state of FOR_WHOM");
    if (!todo || say == in) [[likely]]
      return;
    memcpy((void *)&was, of, sizeof was);
    lanes_in = say;
  }
  LANE ~lanes_some_t() {
    if (say == 0 || say == in) [[likely]]
      return;
    lanes_undo(~say, state, &was, sizeof was);
    lanes_in |= in & ~say;
  }
  LANE bool once() {
    const bool now = todo;
    todo = false;
    return now;
  }
};
#define FOR_WHOM(holds, state) for (lanes_some_t some_(lane_flag_t(holds), state); some_.once();)

template <typename F> LANE lane_double_t where(F holds, lane_double_t a, lane_double_t b) {
  return either(holds, a, b);
}

// --- the C library -------------------------------------------------------------------------------------

LANE lane_float_t sqrtf(lane_float_t a) {
  return (floats_t)_mm256_sqrt_ps((__m256)a.v);
}
LANE lane_float_t fabsf(lane_float_t a) {
  return (floats_t)((words_t)a.v & INT32_MAX);
}
LANE lane_double_t trunc(lane_double_t a) {
  return lanes_round<_MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC>(a);
}
LANE lane_double_t floor(lane_double_t a) {
  return lanes_round<_MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC>(a);
}
LANE lane_double_t ceil(lane_double_t a) {
  return lanes_round<_MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC>(a);
}
LANE lane_double_t nearbyint(lane_double_t a) {
  return lanes_round<_MM_FROUND_CUR_DIRECTION | _MM_FROUND_NO_EXC>(a);
}

// Calls the library lane by lane.
template <typename one_t, typename all_t, typename F> LANE all_t lanes_each(F f, all_t a, all_t b) {
  alignas(32) one_t x[LANES], y[LANES];
  memcpy(x, &a, sizeof x);
  memcpy(y, &b, sizeof y);
  for (int i = 0; i < LANES; i++) x[i] = f(x[i], y[i]);
  memcpy(&a, x, sizeof x);
  return a;
}
#define LANE_FUNCTION(name)                                                                                  \
  LANE lane_double_t name(lane_double_t a) {                                                                 \
    return lanes_each<double>([](double x, double) { return ::name(x); }, a, a);                             \
  }
#define LANE_FUNCTION_OF_TWO(name, one_t, all_t)                                                             \
  LANE all_t name(all_t a, all_t b) {                                                                        \
    return lanes_each<one_t>([](one_t x, one_t y) { return ::name(x, y); }, a, b);                           \
  }
LANE_LIBRARY(LANE_FUNCTION)
#define LANE_FUNCTION_OF_TWO_DOUBLES(name) LANE_FUNCTION_OF_TWO(name, double, lane_double_t)
LANE_LIBRARY_OF_TWO(LANE_FUNCTION_OF_TWO_DOUBLES)
LANE_FUNCTION_OF_TWO(remainder, double, lane_double_t)
LANE_FUNCTION_OF_TWO(fminf, float, lane_float_t)
LANE_FUNCTION_OF_TWO(fmaxf, float, lane_float_t)

#undef isfinite
#undef isnan
LANE lane_wide_flag_t isfinite(lane_double_t a) {
  return fabs(a) < lane_double_t(HUGE_VAL);
}
LANE lane_wide_flag_t isnan(lane_double_t a) {
  return a != a;
}

} // namespace lanes

#endif
