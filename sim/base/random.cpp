// random.cpp - repeatable noise: the numbers of the C++ library's generator and distribution, but faster.
#include "base/random.h"

#include "base/rows.h"
#include "base/wide.h"
#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>

namespace {

constexpr int TOGETHER = 16; // pairs whose logarithms are computed in one loop

using unsigned_four_t = uint64_t __attribute__((vector_size(32)));

// Converts whole numbers below 2^32 to doubles, exactly: they become the low bits of 2^52's mantissa.
WIDE_INLINE void whole(const unsigned_four_t &bits, four_t &x) {
  x = (four_t)(bits | 0x4330000000000000u) - 0x1p52;
}

// 2 c - 1 for c in [0, 1) as the library computes it. Each 32-bit half is exact as a double, so that only the
// sum is rounded.
WIDE_COPIES void units_of(const uint64_t *bits, int n, double *unit) {
  for (int i = 0; i < n; i += HALF) {
    unsigned_four_t b;
    four_t high, low;
    FOUR_LOAD(b, bits + i);
    whole(b >> 32, high);
    whole(b & 0xffffffffu, low);
    const four_t c = 0x1p-64 * (0x1p32 * high + low), most = c - c + (1.0 - 0x1p-53);
    const four_t x = 2.0 * (c < most ? c : most) - 1.0;
    FOUR_PUT(unit + i, x);
  }
}

double canonical(uint64_t b) {
  const double all =
      0x1p32 * static_cast<double>(b >> 32) + static_cast<double>(static_cast<int64_t>(b & 0xffffffffu));
  return std::min(0x1p-64 * all, 1.0 - 0x1p-53);
}

// Multiplies the points (x, y) by the polar method's factor and stores y first.
WIDE_COPIES void stretch(int n, const double *log, const double *square, const double *x, const double *y,
                         double *out) {
  double times[TOGETHER];
  for (int k = 0; k < n; k++) times[k] = std::sqrt(-2.0 * log[k] / square[k]);
  for (int k = 0; k < n; k++) {
    out[2 * k] = y[k] * times[k];
    out[2 * k + 1] = x[k] * times[k];
  }
}

constexpr int N = 312, AHEAD = 156; // of the Mersenne twister

WIDE_INLINE uint64_t mixed(uint64_t high, uint64_t low, uint64_t ahead) {
  const uint64_t x = (high & 0xffffffff80000000u) | (low & 0x7fffffffu);
  return ahead ^ x >> 1 ^ (0xb5026f5aa96619e9u & -(low & 1));
}

WIDE_INLINE uint64_t tempered(uint64_t x) {
  x ^= x >> 29 & 0x5555555555555555u;
  x ^= x << 17 & 0x71d67fffeda60000u;
  x ^= x << 37 & 0xfff7eee000000000u;
  return x ^ x >> 43;
}

// Computes all next states at once, partly side by side.
WIDE_COPIES void turn_all(uint64_t *state) {
  for (int i = 0; i < N - AHEAD; i++) state[i] = mixed(state[i], state[i + 1], state[i + AHEAD]);
  for (int i = N - AHEAD; i < N - 1; i++) state[i] = mixed(state[i], state[i + 1], state[i + AHEAD - N]);
  state[N - 1] = mixed(state[N - 1], state[0], state[AHEAD - 1]);
}
WIDE_COPIES void temper_all(const uint64_t *state, uint64_t *out) {
  for (int i = 0; i < N; i++) out[i] = tempered(state[i]);
}

// std::mt19937_64, number for number. The library's branches at every number, half of the time each way, and
// takes three times as long.
class twister {
public:
  explicit twister(uint64_t seed) {
    state[0] = seed;
    for (int i = 1; i < N; i++)
      state[i] = 6364136223846793005u * (state[i - 1] ^ state[i - 1] >> 62) + static_cast<uint64_t>(i);
  }

  uint64_t operator()() {
    if (next == N) turn();
    return out[next++];
  }

  // The next number, scaled to [-1, 1).
  double unit() {
    if (next == N) turn();
    if (!spread) spread_out();
    return units[next++];
  }

  // Makes numbers available without a refill, and returns how many.
  int at_hand() {
    if (next == N) turn();
    if (!spread) spread_out();
    return N - next;
  }
  const double *first() const { return &units[next]; }
  void take(int n) { next += n; }

  // The next n words, copied to `room` if they are not contiguous.
  const uint64_t *words(int n, uint64_t *room) {
    if (next + n > N) {
      for (int i = 0; i < n; i++) room[i] = (*this)();
      return room;
    }
    next += n;
    return &out[next - n];
  }

private:
  uint64_t state[N], out[N];
  double units[N];
  int next = N;
  bool spread = false; // units belong to out

  // All at once, side by side, as callers that draw normal numbers draw many.
  void spread_out() {
    units_of(out, N, units);
    spread = true;
  }

  void turn() {
    turn_all(state);
    temper_all(state, out);
    next = 0;
    spread = false;
  }
};

} // namespace

struct noise_source {
  explicit noise_source(uint64_t seed) : bits(seed) {}
  twister bits;
  bool keeps = false; // the second number of a pair is kept
  double kept = 0.0;
  double x[TOGETHER], y[TOGETHER], square[TOGETHER], logs[TOGETHER]; // the points that are being drawn

  // The same numbers as std::normal_distribution (Marsaglia's polar method): each point in the unit circle
  // gives two. A point outside is overwritten by the next, without a branch.
  int pairs(int wanted, double *out) {
    int n_in = 0;
    const auto draw = [&](double a, double b) {
      x[n_in] = a;
      y[n_in] = b;
      square[n_in] = a * a + b * b;
      n_in += static_cast<int>(square[n_in] <= 1.0) & static_cast<int>(square[n_in] != 0.0);
    };
    while (n_in < wanted) {
      const int there = bits.at_hand() / 2;
      const double *const unit = bits.first();
      int n = 0;
      for (; n < there && n_in < wanted; n++) draw(unit[2 * n], unit[2 * n + 1]);
      bits.take(2 * n);
      if (n > 0) continue;
      const double a = bits.unit(), b = bits.unit(); // one of them is from the next refill
      draw(a, b);
    }
    for (int k = 0; k < wanted; k++) logs[k] = std::log(square[k]);
    stretch(wanted, logs, square, x, y, out);
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
// From 32 random bits: the sum of two uniform numbers of 16 bits each.
static inline double triangle(uint32_t b) {
  const double scale = 2.4494897427831781 / 0x10000; // sd of the sum: sqrt(2 / 12) * 2^16
  return scale * (static_cast<int>((b & 0xffff) + (b >> 16)) - 0xffff);
}
void random_triangles(random_t *r, int n, double *out) {
  for (int i = 0; i + 1 < n; i += 2) {
    const uint64_t b = r->bits();
    out[i] = triangle(static_cast<uint32_t>(b));
    out[i + 1] = triangle(static_cast<uint32_t>(b >> 32));
  }
}
// Turns n rows of words into 2 n rows of numbers.
WIDE_COPIES static void triangles_of(const uint64_t *words, int n, double *rows) {
  for (int i = 0; i < n; i++, words += LANES, rows += 2 * LANES)
    for (int k = 0; k < LANES; k++) {
      rows[k] = triangle(static_cast<uint32_t>(words[k]));
      rows[LANES + k] = triangle(static_cast<uint32_t>(words[k] >> 32));
    }
}
void random_triangles_of_all(random_t *const r[LANES], int n, double *rows) {
  constexpr int MOST = RANDOM_ROWS / 2;
  uint64_t room[LANES][MOST] = {{0}}, words[MOST][LANES];
  const char *at[LANES];
  const int some = std::min(n / 2, MOST);
  for (int k = 0; k < LANES; k++)
    at[k] = reinterpret_cast<const char *>(r[k] ? r[k]->bits.words(some, room[k]) : room[k]);
  rows_put_64(some, reinterpret_cast<char *>(words), at);
  triangles_of(words[0], some, rows);
}
double random_uniform(random_t *r, double lo, double hi) {
  return canonical(r->bits()) * (hi - lo) + lo;
}
void random_close(random_t *r) {
  delete r;
}
