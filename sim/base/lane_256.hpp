// lane_256.hpp - eight numbers in two registers of 256 bits: a part of base/lane.hpp, which includes it.
#ifndef SIM_BASE_LANE_256_HPP
#define SIM_BASE_LANE_256_HPP

struct truth_t {
  __m256d lo, hi; // per lane all bits set, or none
  LANE unsigned bits() const {
    return (unsigned)_mm256_movemask_pd(lo) | (unsigned)_mm256_movemask_pd(hi) << 4;
  }
  LANE operator bool() const { return vote(bits()); }
};
LANE truth_t operator&&(truth_t a, truth_t b) {
  return {_mm256_and_pd(a.lo, b.lo), _mm256_and_pd(a.hi, b.hi)};
}
LANE truth_t operator||(truth_t a, truth_t b) {
  return {_mm256_or_pd(a.lo, b.lo), _mm256_or_pd(a.hi, b.hi)};
}
LANE truth_t operator!(truth_t a) {
  const __m256d all = _mm256_castsi256_pd(_mm256_set1_epi64x(-1));
  return {_mm256_xor_pd(a.lo, all), _mm256_xor_pd(a.hi, all)};
}

struct lane_t {
  __m256d lo, hi;
  lane_t() = default;
  LANE lane_t(__m256d l, __m256d h) : lo(l), hi(h) {}
  constexpr LANE lane_t(number_t a) : lo{a, a, a, a}, hi{a, a, a, a} {}
  // As a whole number: the first lane's; lanes with another one leave.
  explicit operator int() const;
};

#define LANE_OPERATOR(sign, does)                                                                            \
  LANE lane_t operator sign(lane_t a, lane_t b) {                                                            \
    return {does(a.lo, b.lo), does(a.hi, b.hi)};                                                             \
  }
LANE_OPERATOR(+, _mm256_add_pd)
LANE_OPERATOR(-, _mm256_sub_pd)
LANE_OPERATOR(*, _mm256_mul_pd)
LANE_OPERATOR(/, _mm256_div_pd)

#define LANE_COMPARISON(sign, kind)                                                                          \
  LANE truth_t operator sign(lane_t a, lane_t b) {                                                           \
    return {_mm256_cmp_pd(a.lo, b.lo, kind), _mm256_cmp_pd(a.hi, b.hi, kind)};                               \
  }
LANE_COMPARISON(<, _CMP_LT_OQ)
LANE_COMPARISON(<=, _CMP_LE_OQ)
LANE_COMPARISON(>, _CMP_GT_OQ)
LANE_COMPARISON(>=, _CMP_GE_OQ)
LANE_COMPARISON(==, _CMP_EQ_OQ)
LANE_COMPARISON(!=, _CMP_NEQ_UQ)

LANE lane_t lane_of(const number_t *p) {
  return {_mm256_loadu_pd(p), _mm256_loadu_pd(p + 4)};
}
LANE void lane_put(number_t *p, lane_t a) {
  _mm256_storeu_pd(p, a.lo);
  _mm256_storeu_pd(p + 4, a.hi);
}

LANE lane_t operator-(lane_t a) {
  const __m256d sign = _mm256_set1_pd(-0.0);
  return {_mm256_xor_pd(a.lo, sign), _mm256_xor_pd(a.hi, sign)};
}

// a where the comparison holds, elsewhere b.
LANE lane_t where(truth_t holds, lane_t a, lane_t b) {
  return {_mm256_blendv_pd(b.lo, a.lo, holds.lo), _mm256_blendv_pd(b.hi, a.hi, holds.hi)};
}

LANE lane_t whole_part(lane_t a) {
  constexpr int how = _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC;
  return {_mm256_round_pd(a.lo, how), _mm256_round_pd(a.hi, how)};
}
LANE lane_t sqrt(lane_t a) {
  return {_mm256_sqrt_pd(a.lo), _mm256_sqrt_pd(a.hi)};
}
LANE lane_t fabs(lane_t a) {
  const __m256d sign = _mm256_set1_pd(-0.0);
  return {_mm256_andnot_pd(sign, a.lo), _mm256_andnot_pd(sign, a.hi)};
}

// 2^n for a whole number n that stands in the lowest bits of x.
LANE lane_t exp2_of_bits(lane_t x) {
  const __m256i bias = _mm256_set1_epi64x(1023);
  return {_mm256_castsi256_pd(_mm256_slli_epi64(_mm256_add_epi64(_mm256_castpd_si256(x.lo), bias), 52)),
          _mm256_castsi256_pd(_mm256_slli_epi64(_mm256_add_epi64(_mm256_castpd_si256(x.hi), bias), 52))};
}

#endif
