// limits.h - the thresholds that a finding must exceed to be reported, with a name or without.
#ifndef SIM_GAP_5_INFER_LIMITS_H
#define SIM_GAP_5_INFER_LIMITS_H

#include "base/lsq_blocks.h"
#include <math.h>

// Thresholds for a candidate to enter the selection (select.h).
//
// Chance of a false finding, over all candidates, windows, ranges or lags tried: one in a hundred.
#define SELECT_ALPHA 0.01
// Least gain, as a share of the remaining sum of squares: the rest of the model is known no better.
#define SELECT_GAIN 0.004
// Least gain over the root of the sum of its squares by half-flight: one alone gives 1, four equal ones 2.
#define SELECT_SURE 0.9
// Least size over the typical one: six times what a right form with other numbers leaves (CANDIDATES_MISFIT).
#define SELECT_LEAST 0.12

// Standard errors, on either side, that surely hold a value: 95 in a hundred.
#define SCORE_ERRORS 2.0
// Share of a name's contribution that an effect must give in its place; with less it is something else.
#define SCORE_MOST 0.5
// Factor on standard errors from whitened sums, because rows are not quite independent.
#define SCORE_CLUSTER 1.5

// Nominal flights of the model along each track: with ten the bound of a name is 3.2 times their rms, with
// three 5.8, and more flights hardly lower it.
#define NOMINAL_FLIGHTS 10

// Returns the multiple of its rms on so few nominal flights that a size must exceed: a share SELECT_ALPHA of
// normal errors does. Several numbers get the bound of one, because they err together in a flight. 0 flights:
// as NOMINAL_FLIGHTS.
static inline double limits_nominal(int flights) {
  return sqrt(lsq_f_quantile(SELECT_ALPHA, 1, flights ? flights : NOMINAL_FLIGHTS));
}

// Returns how far, in standard deviations of `others` (2 or more) normal numbers, one more may lie from their
// mean; a share SELECT_ALPHA lies farther.
static inline double limits_another(int others) {
  return sqrt((1.0 + 1.0 / others) * lsq_f_quantile(SELECT_ALPHA, 1, others - 1));
}

// Returns the bound, in standard errors, that noise exceeds either way in any of so many tries with chance
// SELECT_ALPHA.
static inline double limits_noise(int tries) {
  return lsq_t_quantile(SELECT_ALPHA / 2.0 / tries, HUGE_VAL);
}

#endif
