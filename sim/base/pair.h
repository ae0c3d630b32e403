// pair.h - two doubles at a time, which every 64-bit processor supports, for the estimator's inner loops;
// compilers do not vectorise these by themselves. +, -, * and / act on both; the results are bit for bit
// those of one number at a time. Uses an extension of C that gcc and clang share. Header only.
#ifndef SIM_BASE_PAIR_H
#define SIM_BASE_PAIR_H

#include "base/wide.h"
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

// Stands before a function with many such operations. Compiles it a second time for AVX2, with all inlined
// callees that are visible here; the version is selected when the program starts. AVX2 instructions need not
// overwrite an operand, which saves a sixth of them. Not for AVX-512, where gcc fuses (base/wide.h), nor with
// clang, which does not accept both attributes.
#if defined(__x86_64__) && !WIDE_SANITIZED && !defined(__clang__)
#define PAIR_COPIES __attribute__((flatten, target_clones("avx2", "default")))
#else
#define PAIR_COPIES
#endif

typedef double pair_t __attribute__((vector_size(16)));
typedef int64_t pair_bits_t __attribute__((vector_size(16)));

// True if the bytes are identical; for a few dozen bytes faster than a library call. bytes: a multiple of 8.
static inline bool same_in_bits(const void *a, const void *b, size_t bytes) {
  uint64_t differ = 0;
  for (size_t i = 0; i < bytes; i += sizeof differ) {
    uint64_t x, y;
    memcpy(&x, (const char *)a + i, sizeof x);
    memcpy(&y, (const char *)b + i, sizeof y);
    differ |= x ^ y;
  }
  return differ == 0;
}

static inline pair_t pair_of(const double *p) {
  pair_t a;
  memcpy(&a, p, sizeof a);
  return a;
}
static inline void pair_put(double *p, pair_t a) {
  memcpy(p, &a, sizeof a);
}
static inline pair_t pair_both(double a) {
  return (pair_t){a, a};
}
// a where the comparison holds, elsewhere b.
static inline pair_t pair_where(pair_bits_t holds, pair_t a, pair_t b) {
  return (pair_t)((holds & (pair_bits_t)a) | (~holds & (pair_bits_t)b));
}
// The smaller; b where a is NaN.
static inline pair_t pair_min(pair_t a, pair_t b) {
  return pair_where(a < b, a, b);
}

#endif
