// gap_rows.h - synthetic rows: a round of the selection whose regressors, noise and nominal flights the test
// writes itself.
#ifndef TEST_RIG_GAP_ROWS_H
#define TEST_RIG_GAP_ROWS_H

#include "gap/5_infer/round.h"

#define GAP_COLUMNS 24
#define GAP_ROWS    1200 // blocks of 50, four half-flights; the vehicle rises from 0 to 1 m while x swings

typedef struct {
  round_t round;
  candidates_t candidates;
  candidate_t candidate[12];
  grid_t grid;
  gap_flight_t flight;
  set_t set;
  model_t model;
  nominal_t nominal;
  bool never[12];
  random_t *random;
  double *column[CHANNELS][GAP_COLUMNS], *residual[CHANNELS];
} gap_rows_t;

// White noise of sd 1 in every channel, no candidate.
void gap_rows_make(gap_rows_t *g, unsigned long seed);
void gap_rows_free(gap_rows_t *g);

// Adds a candidate: this effect, with regressors of 0. Returns its number.
int gap_rows_candidate(gap_rows_t *g, const char *effect);
// Returns the regressor of a candidate's size k in a channel, for one typical size; the caller fills it.
double *gap_rows_column(gap_rows_t *g, int candidate, int k, int channel);
// Adds a candidate whose size k is white noise in channel `channel` + k, so strong that a typical size has
// `sure` standard errors. Returns its number.
int gap_rows_along(gap_rows_t *g, const char *effect, int channel, double sure);
// Fills v with white noise of sd 1.
void gap_rows_white(gap_rows_t *g, double *v);
// Adds `times` times a candidate's typical size k to the measured residual.
void gap_rows_add(gap_rows_t *g, int candidate, int k, double times);

// Sets up nominal flights. Each has this information on every size, and estimates it as b[flight * columns +
// column]; both in units of the typical size.
void gap_rows_nominal(gap_rows_t *g, int flights, double information, const double *b);

// Builds the round's table and whitened products, with n chosen candidates. May be called again.
void gap_rows_open(gap_rows_t *g, int n, const int *chosen);

#endif
