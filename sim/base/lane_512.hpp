// lane_512.hpp - eight numbers in one register of 512 bits: a part of base/lane.hpp, which includes it.
#ifndef SIM_BASE_LANE_512_HPP
#define SIM_BASE_LANE_512_HPP

struct truth_t {
  __mmask8 of; // one bit per lane
  LANE unsigned bits() const { return of; }
  LANE operator bool() const { return vote(bits()); }
};
LANE truth_t operator&&(truth_t a, truth_t b) {
  return {(__mmask8)(a.of & b.of)};
}
LANE truth_t operator||(truth_t a, truth_t b) {
  return {(__mmask8)(a.of | b.of)};
}
LANE truth_t operator!(truth_t a) {
  return {(__mmask8)~a.of};
}

struct lane_t {
  __m512d v;
  lane_t() = default;
  LANE lane_t(__m512d a) : v(a) {}
  constexpr LANE lane_t(number_t a) : v{a, a, a, a, a, a, a, a} {}
  // As a whole number: the first lane's; lanes with another one leave.
  explicit operator int() const;
};

#define LANE_OPERATOR(sign, does)                                                                            \
  LANE lane_t operator sign(lane_t a, lane_t b) {                                                            \
    return {does(a.v, b.v)};                                                                                 \
  }
LANE_OPERATOR(+, _mm512_add_pd)
LANE_OPERATOR(-, _mm512_sub_pd)
LANE_OPERATOR(*, _mm512_mul_pd)
LANE_OPERATOR(/, _mm512_div_pd)

#define LANE_COMPARISON(sign, kind)                                                                          \
  LANE truth_t operator sign(lane_t a, lane_t b) {                                                           \
    return {_mm512_cmp_pd_mask(a.v, b.v, kind)};                                                             \
  }
LANE_COMPARISON(<, _CMP_LT_OQ)
LANE_COMPARISON(<=, _CMP_LE_OQ)
LANE_COMPARISON(>, _CMP_GT_OQ)
LANE_COMPARISON(>=, _CMP_GE_OQ)
LANE_COMPARISON(==, _CMP_EQ_OQ)
LANE_COMPARISON(!=, _CMP_NEQ_UQ)

LANE lane_t lane_of(const number_t *p) {
  return {_mm512_loadu_pd(p)};
}
LANE void lane_put(number_t *p, lane_t a) {
  _mm512_storeu_pd(p, a.v);
}

LANE lane_t operator-(lane_t a) {
  const __m512i sign = _mm512_castpd_si512(_mm512_set1_pd(-0.0));
  return {_mm512_castsi512_pd(_mm512_xor_si512(_mm512_castpd_si512(a.v), sign))};
}

// a where the comparison holds, elsewhere b.
LANE lane_t where(truth_t holds, lane_t a, lane_t b) {
  return {_mm512_mask_blend_pd(holds.of, b.v, a.v)};
}

// A mask that selects all lanes: without one, gcc's header warns about its own code.
constexpr __mmask8 ALL = 0xff;
LANE lane_t whole_part(lane_t a) {
  return {_mm512_maskz_roundscale_pd(ALL, a.v, _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC)};
}
LANE lane_t sqrt(lane_t a) {
  return {_mm512_maskz_sqrt_pd(ALL, a.v)};
}
LANE lane_t fabs(lane_t a) {
  return {_mm512_abs_pd(a.v)};
}

// 2^n for a whole number n that stands in the lowest bits of x.
LANE lane_t exp2_of_bits(lane_t x) {
  const __m512i n = _mm512_add_epi64(_mm512_castpd_si512(x.v), _mm512_set1_epi64(1023));
  return {_mm512_castsi512_pd(_mm512_maskz_slli_epi64(ALL, n, 52))};
}

#endif
