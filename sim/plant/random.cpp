// random.cpp - repeatable noise from the C++ library's generator and distributions.
#include "plant/random.h"

#include <new>
#include <random>

struct noise_source {
  explicit noise_source(uint64_t seed) : bits(seed) {}
  std::mt19937_64 bits;
  std::normal_distribution<double> normal;
};

random_t *random_open(uint64_t seed) {
  return new (std::nothrow) noise_source(seed);
}
double random_normal(random_t *r) {
  return r->normal(r->bits);
}
double random_uniform(random_t *r, double lo, double hi) {
  return std::uniform_real_distribution<double>(lo, hi)(r->bits);
}
void random_close(random_t *r) {
  delete r;
}
