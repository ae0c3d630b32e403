// limits.h - by how much something has to stand out to be told, with a name or without.
#ifndef SIM_GAP_5_INFER_LIMITS_H
#define SIM_GAP_5_INFER_LIMITS_H

#include "base/lsq_blocks.h"
#include <math.h>

// What a candidate needs to enter (select.h).
//
// Chance, of whatever is told: one candidate, window, range or lag in a hundred, over all that are tried.
#define SELECT_ALPHA 0.01
// Of the sum of squares that is left: of less the rest of the model is not known well enough.
#define SELECT_GAIN 0.004
// Gain over the root of the sum of its squares: one half-flight alone gives 1, and four that are alike 2.
#define SELECT_SURE 0.9
// Of what is typical: six times what a right form with other numbers leaves (CANDIDATES_MISFIT).
#define SELECT_LEAST 0.12

// Standard errors that hold what is sure: 95 in a hundred.
#define SCORE_ERRORS 2.0
// Of what a name gives: what gives less in its place is something else.
#define SCORE_MOST 0.5
// Standard errors of white sums grow by this: rows are not quite independent.
#define SCORE_CLUSTER 1.5

// Of the model along each track: with ten the bound of a name is 3.2 times their rms, with three 5.8, and
// with more hardly less.
#define NOMINAL_FLIGHTS 10

// So many times its rms on nominal flights something must be: of so few flights' normal errors SELECT_ALPHA
// are larger. Of several numbers as of one: in a flight they err together. 0 flights: as of NOMINAL_FLIGHTS.
static inline double limits_nominal(int flights) {
  return sqrt(lsq_f_quantile(SELECT_ALPHA, 1, flights ? flights : NOMINAL_FLIGHTS));
}

// A normal number about the mean of so many others, 2 or more, over their spread: SELECT_ALPHA are larger.
static inline double limits_another(int others) {
  return sqrt((1.0 + 1.0 / others) * lsq_f_quantile(SELECT_ALPHA, 1, others - 1));
}

// Standard errors that noise alone exceeds, either way, in one of so many tries, with that chance.
static inline double limits_noise(int tries) {
  return lsq_t_quantile(SELECT_ALPHA / 2.0 / tries, HUGE_VAL);
}

#endif
