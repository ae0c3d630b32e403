// lane_wide_512.hpp - flags of eight doubles, one bit each: a part of base/lane_whole.hpp, which includes it.
#ifndef SIM_BASE_LANE_WIDE_512_HPP
#define SIM_BASE_LANE_WIDE_512_HPP

struct lane_wide_flag_t {
  __mmask8 of;
  LANE unsigned bits() const { return of; }
  LANE explicit operator bool() const { return lanes_vote(bits()); }
  LANE operator lane_flag_t() const { return (words_t)_mm256_movm_epi32(of); }
};
LANE lane_wide_flag_t wide(lane_flag_t a) {
  return {_mm256_movepi32_mask((__m256i)a.v)};
}
LANE lane_wide_flag_t operator&&(lane_wide_flag_t a, lane_wide_flag_t b) {
  return {(__mmask8)(a.of & b.of)};
}
LANE lane_wide_flag_t operator||(lane_wide_flag_t a, lane_wide_flag_t b) {
  return {(__mmask8)(a.of | b.of)};
}
LANE lane_wide_flag_t operator!(lane_wide_flag_t a) {
  return {(__mmask8)~a.of};
}

#endif
