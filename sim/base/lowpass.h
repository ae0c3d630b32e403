// lowpass.h - second-order Butterworth low-pass in double precision.
//
// Bilinear transform, prewarped at the cut-off: with k = tan(pi f / fs), n = 1 + sqrt(2) k + k^2,
//   y = b (x + 2 x1 + x2) - a1 y1 - a2 y2,  b = k^2/n,  a1 = 2 (k^2 - 1)/n,  a2 = (1 - sqrt(2) k + k^2)/n.
#ifndef SIM_BASE_LOWPASS_H
#define SIM_BASE_LOWPASS_H

typedef struct {
  double b, a1, a2;      // no unit
  double x1, x2, y1, y2; // last two inputs and outputs
} lowpass_t;

// Sets the filter at rest at `value`. cutoff_Hz: > 0 and < rate_Hz / 2.
void lowpass_init(lowpass_t *s, double cutoff_Hz, double rate_Hz, double value);

// The same with another damping, for sections of filters of higher order: two_zeta, > 0, replaces sqrt(2).
void lowpass_init_q(lowpass_t *s, double cutoff_Hz, double rate_Hz, double two_zeta, double value);

// Takes one input sample and returns the output.
double lowpass_step(lowpass_t *s, double x);

#endif
