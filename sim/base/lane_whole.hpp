// lane_whole.hpp - flags and whole numbers of eight vehicles: a part of base/lane_c.hpp, which includes it.
#ifndef SIM_BASE_LANE_WHOLE_HPP
#define SIM_BASE_LANE_WHOLE_HPP

namespace lanes {

// --- flags -------------------------------------------------------------------------------------------------

// What most lanes say; the other lanes leave.
LANE bool lanes_vote(unsigned of_lanes) {
  const unsigned say = of_lanes & lanes_in;
  if (say == 0 || say == lanes_in) [[likely]]
    return say != 0;
  const bool most = 2 * __builtin_popcount(say) >= __builtin_popcount(lanes_in);
  lanes_in = most ? say : lanes_in & ~say;
  return most;
}

// Per lane all bits set, or none.
struct lane_flag_t {
  words_t v;
  LANE_MADE(lane_flag_t, LANE_FLAG)
  constexpr LANE lane_flag_t(words_t a) : v(a) {}
  template <std::same_as<bool> T> constexpr LANE lane_flag_t(T a) : v{-a, -a, -a, -a, -a, -a, -a, -a} {}
  LANE unsigned bits() const { return (unsigned)_mm256_movemask_ps((__m256)v); }
  LANE explicit operator bool() const { return lanes_vote(bits()); }
};

// The same for comparisons of doubles, and conversions between the two.
#ifdef LANES_512
#include "base/lane_wide_512.hpp"
#else
#include "base/lane_wide_256.hpp"
#endif
LANE lane_wide_flag_t wide(lane_wide_flag_t a) {
  return a;
}

#define LANE_LOGIC(sign, bitwise)                                                                            \
  LANE lane_flag_t operator sign(lane_flag_t a, lane_flag_t b) {                                             \
    return a.v bitwise b.v;                                                                                  \
  }                                                                                                          \
  template <std::same_as<bool> T> LANE lane_flag_t operator sign(lane_flag_t a, T b) {                       \
    return a sign lane_flag_t(b);                                                                            \
  }                                                                                                          \
  template <std::same_as<bool> T> LANE lane_flag_t operator sign(T a, lane_flag_t b) {                       \
    return lane_flag_t(a) sign b;                                                                            \
  }                                                                                                          \
  LANE lane_flag_t operator sign(lane_wide_flag_t a, lane_flag_t b) {                                        \
    return lane_flag_t(a) sign b;                                                                            \
  }                                                                                                          \
  LANE lane_flag_t operator sign(lane_flag_t a, lane_wide_flag_t b) {                                        \
    return a sign lane_flag_t(b);                                                                            \
  }                                                                                                          \
  template <std::same_as<bool> T> LANE lane_flag_t operator sign(lane_wide_flag_t a, T b) {                  \
    return lane_flag_t(a) sign lane_flag_t(b);                                                               \
  }                                                                                                          \
  template <std::same_as<bool> T> LANE lane_flag_t operator sign(T a, lane_wide_flag_t b) {                  \
    return lane_flag_t(a) sign lane_flag_t(b);                                                               \
  }
LANE_LOGIC(&&, &)
LANE_LOGIC(||, |)
LANE lane_flag_t operator!(lane_flag_t a) {
  return ~a.v;
}
LANE lane_flag_t operator==(lane_flag_t a, lane_flag_t b) {
  return ~(a.v ^ b.v);
}
LANE lane_flag_t operator!=(lane_flag_t a, lane_flag_t b) {
  return a.v ^ b.v;
}

// --- whole numbers ---------------------------------------------------------------------------------------

inline __attribute__((noinline)) unsigned lanes_disagree(words_t v) {
  alignas(32) int32_t x[LANES];
  memcpy(x, &v, sizeof x);
  const int32_t first = x[__builtin_ctz(lanes_in | 1u << LANES) % LANES];
  for (int i = 0; i < LANES; i++)
    if (x[i] != first) lanes_in &= ~(1u << i);
  return (unsigned)first;
}
// The value of the first lane that is still in; lanes with another one leave.
LANE unsigned lanes_agree(words_t v) {
  const int32_t f = v[0];
  const unsigned same = lane_flag_t((words_t)(v == (words_t){f, f, f, f, f, f, f, f})).bits();
  if ((lanes_in & ~same) == 0) [[likely]]
    return (unsigned)f;
  return lanes_disagree(v);
}

template <bool is_signed> struct lane_whole_t {
  words_t v;
  typedef std::conditional_t<is_signed, int, unsigned> one_t;
  typedef std::conditional_t<is_signed, words_t, uwords_t> all_t;
  LANE_MADE(lane_whole_t, LANE_32)
  constexpr LANE lane_whole_t(words_t a) : v(a) {}
  template <plain T> static constexpr LANE int32_t of(T a) { return (int32_t)(one_t)a; }
  template <plain T>
  constexpr LANE lane_whole_t(T a) : v{of(a), of(a), of(a), of(a), of(a), of(a), of(a), of(a)} {}
  constexpr LANE lane_whole_t(lane_whole_t<!is_signed> a) : v(a.v) {}
  LANE lane_whole_t(lane_flag_t a) : v(a.v & 1) {}
  LANE operator one_t() const { return (one_t)lanes_agree(v); }
  LANE all_t all() const { return (all_t)v; }
  template <typename T> LANE lane_whole_t &operator+=(T b) { return *this = lane_whole_t(*this + b); }
  template <typename T> LANE lane_whole_t &operator-=(T b) { return *this = lane_whole_t(*this - b); }
  template <typename T> LANE lane_whole_t &operator*=(T b) { return *this = lane_whole_t(*this * b); }
  template <typename T> LANE lane_whole_t &operator|=(T b) { return *this = lane_whole_t(*this | b); }
  template <typename T> LANE lane_whole_t &operator&=(T b) { return *this = lane_whole_t(*this & b); }
  template <typename T> LANE lane_whole_t &operator^=(T b) { return *this = lane_whole_t(*this ^ b); }
  LANE lane_whole_t &operator++() { return *this += 1; }
  LANE lane_whole_t operator++(int) {
    const lane_whole_t was = *this;
    *this += 1;
    return was;
  }
  LANE lane_whole_t operator--(int) {
    const lane_whole_t was = *this;
    *this -= 1;
    return was;
  }
};
typedef lane_whole_t<true> lane_int_t;
typedef lane_whole_t<false> lane_unsigned_t;

// The type to which C promotes a plain number beside others; an enum becomes an int.
template <plain_whole T>
using promoted = lane_whole_t<!(std::is_unsigned_v<T> && sizeof(T) >= 4 && !std::is_same_v<T, bool>)>;

#define LANE_WHOLE(sign)                                                                                     \
  template <bool A, bool B> LANE lane_whole_t<A && B> operator sign(lane_whole_t<A> a, lane_whole_t<B> b) {  \
    typedef typename lane_whole_t<A && B>::all_t all;                                                        \
    return (words_t)((all)a.v sign(all) b.v);                                                                \
  }                                                                                                          \
  template <bool A, plain_whole T> LANE auto operator sign(lane_whole_t<A> a, T b) {                         \
    return a sign promoted<T>(b);                                                                            \
  }                                                                                                          \
  template <bool A, plain_whole T> LANE auto operator sign(T a, lane_whole_t<A> b) {                         \
    return promoted<T>(a) sign b;                                                                            \
  }
LANE_WHOLE(+)
LANE_WHOLE(-)
LANE_WHOLE(*)
LANE_WHOLE(&)
LANE_WHOLE(|)
LANE_WHOLE(^)
#define LANE_SHIFT(sign)                                                                                     \
  template <bool A, typename T> LANE lane_whole_t<A> operator sign(lane_whole_t<A> a, T b) {                 \
    return (words_t)(a.all() sign(typename lane_whole_t<A>::all_t) lane_int_t(b).v);                         \
  }
LANE_SHIFT(<<)
LANE_SHIFT(>>)
#define LANE_ORDER(sign)                                                                                     \
  template <bool A, bool B> LANE lane_flag_t operator sign(lane_whole_t<A> a, lane_whole_t<B> b) {           \
    typedef typename lane_whole_t<A && B>::all_t all;                                                        \
    return (words_t)((all)a.v sign(all) b.v);                                                                \
  }                                                                                                          \
  template <bool A, plain_whole T> LANE lane_flag_t operator sign(lane_whole_t<A> a, T b) {                  \
    return a sign promoted<T>(b);                                                                            \
  }                                                                                                          \
  template <bool A, plain_whole T> LANE lane_flag_t operator sign(T a, lane_whole_t<A> b) {                  \
    return promoted<T>(a) sign b;                                                                            \
  }
LANE_ORDER(<)
LANE_ORDER(<=)
LANE_ORDER(>)
LANE_ORDER(>=)
LANE_ORDER(==)
LANE_ORDER(!=)
template <bool A> LANE lane_whole_t<A> operator~(lane_whole_t<A> a) {
  return ~a.v;
}
template <bool A> LANE lane_whole_t<A> operator-(lane_whole_t<A> a) {
  return (words_t)(0 - a.all());
}
template <bool A> LANE lane_flag_t operator!(lane_whole_t<A> a) {
  return a == 0;
}

#define LANE_WITH_FLAG(sign)                                                                                 \
  template <bool A> LANE lane_flag_t operator sign(lane_whole_t<A> a, lane_flag_t b) {                       \
    return a sign lane_int_t(b);                                                                             \
  }
LANE_WITH_FLAG(==)
LANE_WITH_FLAG(!=)

// Processors do not divide several whole numbers at once. Mostly all lanes have the same.
template <bool A, typename F> LANE lane_whole_t<A> lanes_divide(lane_whole_t<A> a, F f) {
  typedef typename lane_whole_t<A>::one_t one;
  const one first = (one)a.v[0];
  if ((lane_flag_t(a == lane_whole_t<A>(first))).bits() == (1u << LANES) - 1) return f(first);
  alignas(32) one x[LANES];
  memcpy(x, &a, sizeof x);
  for (int i = 0; i < LANES; i++) x[i] = f(x[i]);
  memcpy(&a, x, sizeof x);
  return a;
}
template <bool A, plain_whole T> LANE lane_whole_t<A> operator%(lane_whole_t<A> a, T b) {
  typedef typename lane_whole_t<A>::one_t one;
  if (!A && ((one)b & ((one)b - 1)) == 0) return a & ((one)b - 1);
  return lanes_divide(a, [b](one x) { return (one)(x % (one)b); });
}
template <bool A, plain_whole T> LANE lane_whole_t<A> operator/(lane_whole_t<A> a, T b) {
  typedef typename lane_whole_t<A>::one_t one;
  return lanes_divide(a, [b](one x) { return (one)(x / (one)b); });
}

// A whole number with fewer bits.
template <typename T> struct lane_small_t : lane_int_t {
#ifdef LANE_FIELDS
  lane_small_t() : lane_int_t(0) {
    lane_note(this, lane_field_kind<T>);
  }
#else
  lane_small_t() = default;
#endif
  static constexpr LANE words_t cut(words_t a) {
    constexpr int left = 32 - 8 * (int)sizeof(T);
    return std::is_signed_v<T> ? a << left >> left : (words_t)((uwords_t)(a << left) >> left);
  }
  template <plain P> constexpr LANE lane_small_t(P a) : lane_int_t((int)(T)a) {}
  template <bool A> constexpr LANE lane_small_t(lane_whole_t<A> a) : lane_int_t(cut(a.v)) {}
  LANE lane_small_t(lane_flag_t a) : lane_int_t(a.v & 1) {}
  template <typename P> LANE lane_small_t &operator|=(P b) {
    return *this = lane_small_t(*this | b);
  }
  LANE lane_small_t &operator++() {
    return *this = lane_small_t(*this + 1);
  }
  LANE lane_small_t operator++(int) {
    const lane_small_t was = *this;
    *this = lane_small_t(*this + 1);
    return was;
  }
};

// A C enum. C++'s own enum gets another name (tools/lanes.sed).
template <typename E> struct lane_kind_t {
  words_t v;
  LANE_MADE(lane_kind_t, LANE_32)
  static constexpr LANE int32_t of(E a) { return (int32_t)a; }
  constexpr LANE lane_kind_t(E a) : v{of(a), of(a), of(a), of(a), of(a), of(a), of(a), of(a)} {}
  template <bool A> LANE explicit lane_kind_t(lane_whole_t<A> a) : v(a.v) {}
  LANE operator E() const { return (E)lanes_agree(v); }
};
#define LANE_KIND(sign)                                                                                      \
  template <typename E> LANE lane_flag_t operator sign(lane_kind_t<E> a, lane_kind_t<E> b) {                 \
    return (words_t)(a.v sign b.v);                                                                          \
  }                                                                                                          \
  template <typename E> LANE lane_flag_t operator sign(lane_kind_t<E> a, E b) {                              \
    return a sign lane_kind_t<E>(b);                                                                         \
  }                                                                                                          \
  template <typename E> LANE lane_flag_t operator sign(lane_kind_t<E> a, int b) {                            \
    return a sign lane_kind_t<E>((E)b);                                                                      \
  }                                                                                                          \
  template <typename E, bool A> LANE lane_flag_t operator sign(lane_whole_t<A> a, lane_kind_t<E> b) {        \
    return (words_t)(a.v sign b.v);                                                                          \
  }
LANE_KIND(==)
LANE_KIND(!=)
LANE_KIND(>)
LANE_KIND(<)

} // namespace lanes

#endif
