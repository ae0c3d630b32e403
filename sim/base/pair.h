// pair.h - two doubles at a time, as every processor with 64 bits has them: arithmetic of the estimator's
// inner loops, which a compiler does not find there by itself. +, -, * and / act on both; the
// results are those of one at a time, to the bit. An extension of C that gcc and clang share. Header only.
#ifndef SIM_BASE_PAIR_H
#define SIM_BASE_PAIR_H

#include "base/wide.h"
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

// Before a function of many such operations: it is compiled once more for AVX2, with all that it calls and is
// seen here, and which one is called is found out when the program starts. An instruction need not overwrite
// what it takes there, which saves a sixth of them. Not for AVX-512, where gcc fuses (base/wide.h), and not
// by clang, which does not take both attributes.
#if defined(__x86_64__) && !WIDE_SANITIZED && !defined(__clang__)
#define PAIR_COPIES __attribute__((flatten, target_clones("avx2", "default")))
#else
#define PAIR_COPIES
#endif

typedef double pair_t __attribute__((vector_size(16)));
typedef int64_t pair_bits_t __attribute__((vector_size(16)));

// Bit by bit the same: of a few dozen bytes the library's call costs more than they do. bytes: a multiple
// of 8.
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
// a where a comparison holds, elsewhere b.
static inline pair_t pair_where(pair_bits_t holds, pair_t a, pair_t b) {
  return (pair_t)((holds & (pair_bits_t)a) | (~holds & (pair_bits_t)b));
}
// The smaller; where a is NaN, b.
static inline pair_t pair_min(pair_t a, pair_t b) {
  return pair_where(a < b, a, b);
}

#endif
