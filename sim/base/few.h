// few.h - a few doubles at a time, one per rotor: for the plant's inner loops and for commands on their way
// there. +, -, * and / act on all of them; the results are bit for bit those of one number at a time. Four,
// one register in functions compiled for AVX2 (PAIR_COPIES), or two where each number stands for eight
// vehicles (base/lane_pair.hpp). Uses an extension of C that gcc and clang share. Header only.
#ifndef SIM_BASE_FEW_H
#define SIM_BASE_FEW_H

#include "base/pair.h"

#define FEW_N 4 // how many

// Functions that take or return few_t are inlined: how such arguments are passed depends on the processor.
#define FEW_INLINE WIDE_INLINE

typedef four_t few_t;
typedef four_bits_t few_bits_t;

FEW_INLINE few_t few_of(const double *p) {
  few_t a;
  memcpy(&a, p, sizeof a);
  return a;
}
FEW_INLINE void few_put(double *p, few_t a) {
  memcpy(p, &a, sizeof a);
}
// Stores four numbers at once, so that a later load of few_t from there need not wait for four single stores.
FEW_INLINE void few_put_four(double *p, double a, double b, double c, double d) {
  few_put(p, (few_t){a, b, c, d});
}
FEW_INLINE few_t few_all(double a) {
  return (few_t){a, a, a, a};
}
// The sum of partial sums that began at 0, in the order of code that adds two at a time, for the same bits.
FEW_INLINE double few_sum(few_t a) {
  return (a[0] + a[2]) + (a[1] + a[3]);
}
// a where the comparison holds, elsewhere b.
FEW_INLINE few_t few_where(few_bits_t holds, few_t a, few_t b) {
  return (few_t)((holds & (few_bits_t)a) | (~holds & (few_bits_t)b));
}
// 2^n for whole numbers n, -1022..1023, that stand in the lowest bits of a.
FEW_INLINE few_t few_exp2_of_bits(few_t a) {
  return (few_t)(((few_bits_t)a + 1023) << 52);
}
FEW_INLINE bool few_any(few_bits_t holds) {
  return (holds[0] | holds[1] | holds[2] | holds[3]) != 0;
}
// The smaller and the larger; b where a is NaN.
FEW_INLINE few_t few_min(few_t a, few_t b) {
  return few_where(a < b, a, b);
}
FEW_INLINE few_t few_max(few_t a, few_t b) {
  return few_where(a > b, a, b);
}
FEW_INLINE few_t few_sqrt(few_t a) {
  return (few_t){sqrt(a[0]), sqrt(a[1]), sqrt(a[2]), sqrt(a[3])};
}
FEW_INLINE few_t few_trunc(few_t a) {
  return (few_t){trunc(a[0]), trunc(a[1]), trunc(a[2]), trunc(a[3])};
}

#endif
