// decay.h - a exp(-k d), a few at a time, to 2 ulp: without a branch or a call, and with the same bits on
// every machine (those of the C library depend on the processor). Header only.
//
//   -k d = n ln 2 + r, |r| <= ln 2 / 2,   exp(-k d) = 2^n (1 + r + r^2 q(r))
//
// q: polynomial of degree 9, Chebyshev approximation of (exp r - 1 - r) / r^2, error 1.3e-17. The chain of
// dependent operations is short, because the integrator's next stage waits for it.
#ifndef SIM_PLANT_DECAY_H
#define SIM_PLANT_DECAY_H

#include "base/few.h"

#define DECAY_FAR 700.0 // of k d; from here on the result is 0

// d >= 0, may be infinite; k > 0.
FEW_INLINE few_t decay(double a, double k, few_t d) {
  const double to_integer = 0x1.8p52; // adding it leaves an integer in the lowest bits
  const few_t n_and_more = d * (-0x1.71547652b82fep+0 * k) + to_integer, n = n_and_more - to_integer;
  const few_t x = d * -k;
  const few_t r = (x - n * 0x1.62e42fefap-1) - n * 0x1.cf79abc9e3b3ap-40; // ln 2 in two parts
  const few_t scale = few_exp2_of_bits(n_and_more) * a;
  const few_t r2 = r * r, r4 = r2 * r2;
  const few_t q01 = 0x1.0000000000001p-1 + r * 0x1.5555555555556p-3,
              q23 = 0x1.5555555553d63p-5 + r * 0x1.11111111109b3p-7,
              q45 = 0x1.6c16c1788bd90p-10 + r * 0x1.a01a01a7c41d5p-13,
              q67 = 0x1.a019b90d2ae7ap-16 + r * 0x1.71de0dae63bb3p-19,
              q89 = 0x1.289185613a3d6p-22 + r * 0x1.af38a9b0ec855p-26;
  const few_t q = (q01 + r2 * q23) + r4 * ((q45 + r2 * q67) + r4 * q89);
  const few_t result = (scale + scale * r) + scale * r2 * q;
  return few_where(x > few_all(-DECAY_FAR), result, few_all(0.0));
}

#endif
