// lane_double_512.hpp - eight doubles in one register of 512 bits: a part of base/lane_number.hpp, which
// includes it. A mask selects all lanes where gcc's header would warn about its own code without one.
#ifndef SIM_BASE_LANE_DOUBLE_512_HPP
#define SIM_BASE_LANE_DOUBLE_512_HPP

typedef double eight_t __attribute__((vector_size(64)));
typedef int64_t eight_bits_t __attribute__((vector_size(64)));

struct lane_double_t {
  eight_t v;
  LANE_MADE(lane_double_t, LANE_64)
  constexpr LANE lane_double_t(eight_t a) : v(a) {}
  template <plain T> static constexpr LANE double of(T a) { return (double)a; }
  template <plain T>
  constexpr LANE lane_double_t(T a) : v{of(a), of(a), of(a), of(a), of(a), of(a), of(a), of(a)} {}
  LANE explicit lane_double_t(lane_float_t a) : v(__builtin_convertvector(a.v, eight_t)) {}
  template <bool A>
  LANE lane_double_t(lane_whole_t<A> a) : v(__builtin_convertvector(a.v, eight_t)) {} // below 2^31
  LANE explicit operator lane_int_t() const { return (words_t)_mm512_maskz_cvttpd_epi32(0xff, (__m512d)v); }
  LANE explicit operator lane_unsigned_t() const {
    return lane_unsigned_t((lane_int_t) * this);
  } // below 2^31
  template <typename T> LANE explicit operator lane_small_t<T>() const {
    return lane_small_t<T>((lane_int_t) * this);
  }
};
LANE lane_float_t::lane_float_t(lane_double_t a) : v(__builtin_convertvector(a.v, floats_t)) {}

#define LANE_DOUBLE(sign)                                                                                    \
  LANE lane_double_t operator sign(lane_double_t a, lane_double_t b) {                                       \
    return a.v sign b.v;                                                                                     \
  }
LANE_DOUBLE(+)
LANE_DOUBLE(-)
LANE_DOUBLE(*)
LANE_DOUBLE(/)
#define LANE_DOUBLE_COMPARED(sign, kind)                                                                     \
  LANE lane_wide_flag_t operator sign(lane_double_t a, lane_double_t b) {                                    \
    return {_mm512_cmp_pd_mask((__m512d)a.v, (__m512d)b.v, kind)};                                           \
  }
LANE_DOUBLE_COMPARED(<, _CMP_LT_OQ)
LANE_DOUBLE_COMPARED(<=, _CMP_LE_OQ)
LANE_DOUBLE_COMPARED(>, _CMP_GT_OQ)
LANE_DOUBLE_COMPARED(>=, _CMP_GE_OQ)
LANE_DOUBLE_COMPARED(==, _CMP_EQ_OQ)
LANE_DOUBLE_COMPARED(!=, _CMP_NEQ_UQ)
LANE lane_double_t operator-(lane_double_t a) {
  return -a.v;
}

// a where the condition holds, elsewhere b. Both are computed.
LANE lane_double_t either(lane_wide_flag_t holds, lane_double_t a, lane_double_t b) {
  return (eight_t)_mm512_mask_blend_pd(holds.of, (__m512d)b.v, (__m512d)a.v);
}

// 2^n for a whole number n that stands in the lowest bits of x.
LANE lane_double_t exp2_of_bits(lane_double_t x) {
  return (eight_t)(((eight_bits_t)x.v + 1023) << 52);
}

LANE lane_double_t sqrt(lane_double_t a) {
  return (eight_t)_mm512_maskz_sqrt_pd(0xff, (__m512d)a.v);
}
LANE lane_double_t fabs(lane_double_t a) {
  return (eight_t)((eight_bits_t)a.v & INT64_MAX);
}
template <int how> LANE lane_double_t lanes_round(lane_double_t a) {
  return (eight_t)_mm512_maskz_roundscale_pd(0xff, (__m512d)a.v, how);
}

#endif
