// gap_rows.h - rows that no flight made: a round of the selection with columns, noise and nominal flights
// that a test writes itself.
#ifndef TEST_RIG_GAP_ROWS_H
#define TEST_RIG_GAP_ROWS_H

#include "gap/5_infer/round.h"

#define GAP_COLUMNS 24
#define GAP_ROWS    1200 // in blocks of 50, four half-flights; the vehicle rises from 0 to 1 m, x swings

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

// White noise of sd 1 in every channel, and no candidate.
void gap_rows_make(gap_rows_t *g, unsigned long seed);
void gap_rows_free(gap_rows_t *g);

// One more candidate: this effect, its columns 0. Returns its number.
int gap_rows_candidate(gap_rows_t *g, const char *effect);
// The column of size k of a candidate in a channel, over what is typical of it: the caller writes rows.
double *gap_rows_column(gap_rows_t *g, int candidate, int k, int channel);
// White rows of sd 1.
void gap_rows_white(gap_rows_t *g, double *v);
// What is measured gets so many times the typical size of a candidate's size k.
void gap_rows_add(gap_rows_t *g, int candidate, int k, double times);

// Nominal flights, each of which holds of every column so much information, and finds b[flight * columns +
// column] of it, over what is typical.
void gap_rows_nominal(gap_rows_t *g, int flights, double information, const double *b);

// The round's table, white and summed up, with what is chosen by number; may be called again.
void gap_rows_open(gap_rows_t *g, int n, const int *chosen);

#endif
