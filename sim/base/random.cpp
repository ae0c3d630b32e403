// random.cpp - repeatable noise from the C++ library's distributions.
#include "base/random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <new>

namespace {

// std::mt19937_64, number for number. The library's has a branch for every number, which is taken half of the
// time, and costs three times as much.
class twister {
public:
  explicit twister(uint64_t seed) {
    state[0] = seed;
    for (unsigned i = 1; i < N; i++)
      state[i] = 6364136223846793005u * (state[i - 1] ^ state[i - 1] >> 62) + i;
  }

  uint64_t operator()() {
    if (next == N) turn();
    return out[next++];
  }

private:
  static constexpr unsigned N = 312, AHEAD = 156;
  std::array<uint64_t, N> state, out;
  unsigned next = N;

  static uint64_t mixed(uint64_t high, uint64_t low, uint64_t ahead) {
    const uint64_t x = (high & 0xffffffff80000000u) | (low & 0x7fffffffu);
    return ahead ^ x >> 1 ^ (0xb5026f5aa96619e9u & -(low & 1));
  }

  static uint64_t tempered(uint64_t x) {
    x ^= x >> 29 & 0x5555555555555555u;
    x ^= x << 17 & 0x71d67fffeda60000u;
    x ^= x << 37 & 0xfff7eee000000000u;
    return x ^ x >> 43;
  }

  // All that come next, at once: two of them side by side.
  void turn() {
    for (unsigned i = 0; i < N - AHEAD; i++) state[i] = mixed(state[i], state[i + 1], state[i + AHEAD]);
    for (unsigned i = N - AHEAD; i < N - 1; i++)
      state[i] = mixed(state[i], state[i + 1], state[i + AHEAD - N]);
    state[N - 1] = mixed(state[N - 1], state[0], state[AHEAD - 1]);
    for (unsigned i = 0; i < N; i++) out[i] = tempered(state[i]);
    next = 0;
  }
};

// In [0, 1), as the library has it. A processor without AVX-512 makes a double of 64 bits by a branch that is
// taken half of the time; of either half it is exact without one, so that the sum alone is rounded.
inline double canonical(uint64_t b) {
  const double all = 0x1p32 * static_cast<double>(static_cast<int64_t>(b >> 32)) +
                     static_cast<double>(static_cast<int64_t>(b & 0xffffffffu));
  return std::min(0x1p-64 * all, 1.0 - 0x1p-53);
}

constexpr int TOGETHER = 16; // pairs whose logarithms are taken one behind the other

} // namespace

struct noise_source {
  explicit noise_source(uint64_t seed) : bits(seed) {}
  twister bits;
  bool keeps = false; // the second one of a pair
  double kept = 0.0;

  // Number for number those of std::normal_distribution (Marsaglia's polar method): each point in the unit
  // circle gives two. A point outside is drawn over, without a branch.
  int pairs(int wanted, double *out) {
    double x[TOGETHER], y[TOGETHER], square[TOGETHER];
    for (int k = 0; k < wanted;) {
      x[k] = 2.0 * canonical(bits()) - 1.0;
      y[k] = 2.0 * canonical(bits()) - 1.0;
      square[k] = x[k] * x[k] + y[k] * y[k];
      k += static_cast<int>(square[k] <= 1.0) & static_cast<int>(square[k] != 0.0);
    }
    double log[TOGETHER];
    for (int k = 0; k < wanted; k++) log[k] = std::log(square[k]);
    for (int k = 0; k < wanted; k++) {
      const double times = std::sqrt(-2.0 * log[k] / square[k]);
      out[2 * k] = y[k] * times;
      out[2 * k + 1] = x[k] * times;
    }
    return 2 * wanted;
  }

  double normal() {
    if (!keeps) {
      double two[2];
      pairs(1, two);
      kept = two[1];
      keeps = true;
      return two[0];
    }
    keeps = false;
    return kept;
  }
};

random_t *random_open(uint64_t seed) {
  return new (std::nothrow) noise_source(seed);
}
double random_normal(random_t *r) {
  return r->normal();
}
void random_normals(random_t *r, int n, double *out) {
  int i = 0;
  if (n > 0 && r->keeps) out[i++] = r->normal();
  while (n - i > 1) i += r->pairs(std::min(TOGETHER, (n - i) / 2), out + i);
  if (i < n) out[i] = r->normal();
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
  return canonical(r->bits()) * (hi - lo) + lo;
}
void random_close(random_t *r) {
  delete r;
}
