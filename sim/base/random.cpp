// random.cpp - repeatable noise from the C++ library's distributions.
#include "base/random.h"

#include <array>
#include <new>
#include <random>

namespace {

// std::mt19937_64, number for number. The library's has a branch for every number, which is taken half of the
// time, and costs three times as much.
class twister {
public:
  using result_type = uint64_t;
  static constexpr result_type min() { return 0; }
  static constexpr result_type max() { return UINT64_MAX; }

  explicit twister(uint64_t seed) {
    state[0] = seed;
    for (unsigned i = 1; i < N; i++)
      state[i] = 6364136223846793005u * (state[i - 1] ^ state[i - 1] >> 62) + i;
  }

  uint64_t operator()() {
    if (next == N) turn();
    uint64_t x = state[next++];
    x ^= x >> 29 & 0x5555555555555555u;
    x ^= x << 17 & 0x71d67fffeda60000u;
    x ^= x << 37 & 0xfff7eee000000000u;
    return x ^ x >> 43;
  }

private:
  static constexpr unsigned N = 312, AHEAD = 156;
  std::array<uint64_t, N> state;
  unsigned next = N;

  static uint64_t mixed(uint64_t high, uint64_t low, uint64_t ahead) {
    const uint64_t x = (high & 0xffffffff80000000u) | (low & 0x7fffffffu);
    return ahead ^ x >> 1 ^ (0xb5026f5aa96619e9u & -(low & 1));
  }

  void turn() {
    for (unsigned i = 0; i < N - AHEAD; i++) state[i] = mixed(state[i], state[i + 1], state[i + AHEAD]);
    for (unsigned i = N - AHEAD; i < N - 1; i++)
      state[i] = mixed(state[i], state[i + 1], state[i + AHEAD - N]);
    state[N - 1] = mixed(state[N - 1], state[0], state[AHEAD - 1]);
    next = 0;
  }
};

} // namespace

struct noise_source {
  explicit noise_source(uint64_t seed) : bits(seed) {}
  twister bits;
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
