// lane_double_256.hpp - eight doubles in two registers of 256 bits: a part of base/lane_number.hpp, which
// includes it. The layout is that of lane_double_512.hpp, so that both can use one state of eight vehicles.
#ifndef SIM_BASE_LANE_DOUBLE_256_HPP
#define SIM_BASE_LANE_DOUBLE_256_HPP

struct alignas(64) lane_double_t {
  doubles_t lo, hi;
  LANE_MADE(lane_double_t, LANE_64)
  constexpr LANE lane_double_t(doubles_t l, doubles_t h) : lo(l), hi(h) {}
  template <plain T> static constexpr LANE double of(T a) { return (double)a; }
  template <plain T>
  constexpr LANE lane_double_t(T a) : lo{of(a), of(a), of(a), of(a)}, hi{of(a), of(a), of(a), of(a)} {}
  LANE explicit lane_double_t(lane_float_t a)
      : lo((doubles_t)_mm256_cvtps_pd(_mm256_castps256_ps128((__m256)a.v))),
        hi((doubles_t)_mm256_cvtps_pd(_mm256_extractf128_ps((__m256)a.v, 1))) {}
  template <bool A>
  LANE lane_double_t(lane_whole_t<A> a) // below 2^31
      : lo((doubles_t)_mm256_cvtepi32_pd(_mm256_castsi256_si128((__m256i)a.v))),
        hi((doubles_t)_mm256_cvtepi32_pd(_mm256_extracti128_si256((__m256i)a.v, 1))) {}
  LANE explicit operator lane_int_t() const {
    return (words_t)_mm256_set_m128i(_mm256_cvttpd_epi32((__m256d)hi), _mm256_cvttpd_epi32((__m256d)lo));
  }
  LANE explicit operator lane_unsigned_t() const {
    return lane_unsigned_t((lane_int_t) * this);
  } // below 2^31
  template <typename T> LANE explicit operator lane_small_t<T>() const {
    return lane_small_t<T>((lane_int_t) * this);
  }
};
LANE lane_float_t::lane_float_t(lane_double_t a)
    : v((floats_t)_mm256_set_m128(_mm256_cvtpd_ps((__m256d)a.hi), _mm256_cvtpd_ps((__m256d)a.lo))) {}

#define LANE_DOUBLE(sign)                                                                                    \
  LANE lane_double_t operator sign(lane_double_t a, lane_double_t b) {                                       \
    return {a.lo sign b.lo, a.hi sign b.hi};                                                                 \
  }
LANE_DOUBLE(+)
LANE_DOUBLE(-)
LANE_DOUBLE(*)
LANE_DOUBLE(/)
#define LANE_DOUBLE_COMPARED(sign)                                                                           \
  LANE lane_wide_flag_t operator sign(lane_double_t a, lane_double_t b) {                                    \
    return {(longs_t)(a.lo sign b.lo), (longs_t)(a.hi sign b.hi)};                                           \
  }
LANE_DOUBLE_COMPARED(<)
LANE_DOUBLE_COMPARED(<=)
LANE_DOUBLE_COMPARED(>)
LANE_DOUBLE_COMPARED(>=)
LANE_DOUBLE_COMPARED(==)
LANE_DOUBLE_COMPARED(!=)
LANE lane_double_t operator-(lane_double_t a) {
  return {-a.lo, -a.hi};
}

// a where the condition holds, elsewhere b. Both are computed.
LANE lane_double_t either(lane_wide_flag_t holds, lane_double_t a, lane_double_t b) {
  return {(doubles_t)_mm256_blendv_pd((__m256d)b.lo, (__m256d)a.lo, (__m256d)holds.lo),
          (doubles_t)_mm256_blendv_pd((__m256d)b.hi, (__m256d)a.hi, (__m256d)holds.hi)};
}

// 2^n for a whole number n that stands in the lowest bits of x.
LANE lane_double_t exp2_of_bits(lane_double_t x) {
  return {(doubles_t)(((longs_t)x.lo + 1023) << 52), (doubles_t)(((longs_t)x.hi + 1023) << 52)};
}

LANE lane_double_t sqrt(lane_double_t a) {
  return {(doubles_t)_mm256_sqrt_pd((__m256d)a.lo), (doubles_t)_mm256_sqrt_pd((__m256d)a.hi)};
}
LANE lane_double_t fabs(lane_double_t a) {
  return {(doubles_t)((longs_t)a.lo & INT64_MAX), (doubles_t)((longs_t)a.hi & INT64_MAX)};
}
template <int how> LANE lane_double_t lanes_round(lane_double_t a) {
  return {(doubles_t)_mm256_round_pd((__m256d)a.lo, how), (doubles_t)_mm256_round_pd((__m256d)a.hi, how)};
}

#endif
