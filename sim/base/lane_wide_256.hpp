// lane_wide_256.hpp - flags of eight doubles in two registers of 256 bits: a part of base/lane_whole.hpp,
// which includes it.
#ifndef SIM_BASE_LANE_WIDE_256_HPP
#define SIM_BASE_LANE_WIDE_256_HPP

struct lane_wide_flag_t {
  longs_t lo, hi;
  LANE unsigned bits() const {
    return (unsigned)_mm256_movemask_pd((__m256d)lo) | (unsigned)_mm256_movemask_pd((__m256d)hi) << 4;
  }
  LANE explicit operator bool() const { return lanes_vote(bits()); }
  LANE operator lane_flag_t() const {
    const __m256 half = _mm256_shuffle_ps((__m256)lo, (__m256)hi, 0x88);
    return (words_t)_mm256_permute4x64_epi64((__m256i)half, 0xd8);
  }
};
LANE lane_wide_flag_t wide(lane_flag_t a) {
  return {(longs_t)_mm256_cvtepi32_epi64(_mm256_castsi256_si128((__m256i)a.v)),
          (longs_t)_mm256_cvtepi32_epi64(_mm256_extracti128_si256((__m256i)a.v, 1))};
}
LANE lane_wide_flag_t operator&&(lane_wide_flag_t a, lane_wide_flag_t b) {
  return {a.lo & b.lo, a.hi & b.hi};
}
LANE lane_wide_flag_t operator||(lane_wide_flag_t a, lane_wide_flag_t b) {
  return {a.lo | b.lo, a.hi | b.hi};
}
LANE lane_wide_flag_t operator!(lane_wide_flag_t a) {
  return {~a.lo, ~a.hi};
}

#endif
