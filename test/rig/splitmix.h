// splitmix.h - pseudo-random numbers for tests, the same in every run: splitmix64.
#ifndef TEST_RIG_SPLITMIX_H
#define TEST_RIG_SPLITMIX_H

#include <math.h>
#include <stdint.h>

typedef struct {
  uint64_t state; // any number is a seed
} splitmix_t;

static inline uint64_t splitmix_bits(splitmix_t *r) {
  uint64_t x = (r->state += 0x9e3779b97f4a7c15u);
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

// Uniform in lo..hi.
static inline double splitmix_between(splitmix_t *r, double lo, double hi) {
  return lo + (hi - lo) * (double)(splitmix_bits(r) >> 11) * 0x1p-53;
}

// Normal with mean 0 (Box and Muller; the second number is not used).
static inline double splitmix_normal(splitmix_t *r, double sd) {
  const double radius = sqrt(-2.0 * log(splitmix_between(r, 0x1p-60, 1.0)));
  return sd * radius * cos(splitmix_between(r, 0.0, 6.283185307179586));
}

#endif
