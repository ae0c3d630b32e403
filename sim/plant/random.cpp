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
void random_triangles(random_t *r, int n, double *out) {
  const double scale = 2.4494897427831781 / 0x10000; // sd of the sum: sqrt(2 / 12) of 2^16
  for (int i = 0; i + 1 < n; i += 2) {
    const uint64_t b = r->bits();
    out[i] = scale * (static_cast<int>((b & 0xffff) + (b >> 16 & 0xffff)) - 0xffff);
    out[i + 1] = scale * (static_cast<int>((b >> 32 & 0xffff) + (b >> 48)) - 0xffff);
  }
}
double random_uniform(random_t *r, double lo, double hi) {
  return std::uniform_real_distribution<double>(lo, hi)(r->bits);
}
void random_close(random_t *r) {
  delete r;
}
