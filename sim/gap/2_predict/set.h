// set.h - the rows of several flights for least squares, at about 25 Hz, and by fresh sample of the range.
#ifndef SIM_GAP_2_PREDICT_SET_H
#define SIM_GAP_2_PREDICT_SET_H

#include "gap/2_predict/grid.h"

#define RESIDUAL_HZ        25.0
#define RESIDUAL_SMOOTH_HZ 8   // cut-off of the rows' filter
#define BLOCK_S            2.0 // blocks of rows of this length are taken to be independent
#define RESIDUAL_SCRATCH   8   // numbers of a point in the filter (base/wide.h)

// Rows of all flights, in order: a list of the smooth channels, or one of the range.
typedef struct {
  int n;
  int *point;    // of its flight's grid
  int *flight;   // number of the grid
  int *block;    // counts over all flights
  bool *follows; // the row before is one step earlier: there is no gap between
  double *lift;  // over its mean: the factor of a flight's own constant (lift.h); null: 1
} rows_t;

static inline double rows_lift(const rows_t *r, int row) {
  return r->lift ? r->lift[row] : 1.0;
}

typedef struct {
  grid_t *grid; // one per flight
  int n_grid;
  rows_t smooth, range;
  int n_block, *half; // the half-flight of each block; the two of a flight interleave
  int n_half;
  bool excluded[CHANNELS];    // excluded.h
  bool spins_other;           // excluded.h
  double *measured[CHANNELS]; // by channel and row, once they were needed (residual.h); or null
  struct cuts *cuts;          // where the rows lie, kept (5_infer/windows.h); one block of memory, or null
} set_t;

// Returns the block of its flight in which a point lies.
static inline int set_block_of(const grid_t *g, int point) {
  return (int)((g->point[point].t_s - g->point[0].t_s) / BLOCK_S);
}

static inline const rows_t *set_rows(const set_t *s, int channel) {
  return channel == CH_RANGE ? &s->range : &s->smooth;
}

// Returns the number of rows in the longer list, and one more.
static inline size_t set_most_rows(const set_t *s) {
  return (size_t)(s->smooth.n > s->range.n ? s->smooth.n : s->range.n) + 1;
}

// Makes a set, which takes over the grids. BAD_INPUT: no row at all (says why); FAILED: no memory. *s can be
// freed then.
MUST_CHECK done_t set_make(set_t *s, grid_t *grid, int n, why_t *why);
void set_free(set_t *s);

// Lends the set to one of several threads: grids are lent (grid_lend), what was measured is shared. FAILED:
// no memory. Give it back, also on an error.
MUST_CHECK done_t set_lend(const set_t *s, set_t *lent, why_t *why);
void set_give_back(set_t *lent);

// Returns the first row of a flight, or of the next that has rows; rows are in the flights' order.
static inline int rows_from(const rows_t *r, int flight) {
  int low = 0, high = r->n;
  while (low < high) {
    const int middle = low + (high - low) / 2;
    if (r->flight[middle] < flight)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

// Returns the constant (times the lift) of a flight's rows, by ordinary least squares; 0: it has no rows.
double rows_constant(const rows_t *r, const double *v, int flight);
// Returns the mean of these constants over the flights that have rows, with equal weights.
double rows_usual(const rows_t *r, const double *v, int flights);
// Subtracts a constant (times the lift) from a flight's rows.
void rows_take(const rows_t *r, double *v, int flight, double constant);
// Subtracts each flight's own constant (rows_constant) from v.
void rows_center(const rows_t *r, double *v);
// Subtracts each flight's median from v, plain or times the lift, whichever leaves less: what is there for
// less than half of the time stays as it is. room: as many numbers as rows.
void rows_clear(const rows_t *r, double *v, double *room);
// Replaces each flight's own constant by that of all rows together.
void rows_level(const rows_t *r, double *v);

#endif
