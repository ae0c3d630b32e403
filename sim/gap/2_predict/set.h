// set.h - the rows of several flights for least squares, at about 25 Hz, and by fresh sample of the range.
#ifndef SIM_GAP_2_PREDICT_SET_H
#define SIM_GAP_2_PREDICT_SET_H

#include "gap/2_predict/grid.h"

#define RESIDUAL_HZ        25.0
#define RESIDUAL_SMOOTH_HZ 8   // cut-off of the rows' filter
#define BLOCK_S            2.0 // what is taken to be independent
#define RESIDUAL_SCRATCH   8   // numbers of a point in the filter (base/wide.h)

// Rows of all flights, in order. Two lists: of the smooth channels, and of the range.
typedef struct {
  int n;
  int *point;    // of its flight's grid
  int *flight;   // number of the grid
  int *block;    // counts over all flights
  bool *follows; // the row before is one step earlier: there is no gap between
  double *lift;  // over its mean: what a flight's own constant is multiplied by (lift.h); null: by 1
} rows_t;

static inline double rows_lift(const rows_t *r, int row) {
  return r->lift ? r->lift[row] : 1.0;
}

typedef struct {
  grid_t *grid; // one per flight
  int n_grid;
  rows_t smooth, range;
  int n_block, *half; // of each block: which half-flight it belongs to; the two of a flight interleave
  int n_half;
  bool excluded[CHANNELS];    // excluded.h
  bool spins_other;           // excluded.h
  double *measured[CHANNELS]; // by channel and row, kept from the first time on (residual.h), or null
  struct cuts *cuts;          // where the rows lie, kept (5_infer/windows.h); one block, or null
} set_t;

// Which block of its flight a point lies in.
static inline int set_block_of(const grid_t *g, int point) {
  return (int)((g->point[point].t_s - g->point[0].t_s) / BLOCK_S);
}

static inline const rows_t *set_rows(const set_t *s, int channel) {
  return channel == CH_RANGE ? &s->range : &s->smooth;
}

// Room for the rows of any channel, and one more.
static inline size_t set_most_rows(const set_t *s) {
  return (size_t)(s->smooth.n > s->range.n ? s->smooth.n : s->range.n) + 1;
}

// Takes the grids over. BAD_INPUT: no row at all (says why); FAILED: no memory. *s can be freed then.
MUST_CHECK done_t set_make(set_t *s, grid_t *grid, int n, why_t *why);
void set_free(set_t *s);

// The same set for one thread beside others: its grids are lent (grid_lend), and what was measured is kept.
// FAILED: no memory. Give it back, also on an error.
MUST_CHECK done_t set_lend(const set_t *s, set_t *lent, why_t *why);
void set_give_back(set_t *lent);

// The first row of a flight or of the next ones; rows are in the flights' order.
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

// The constant (times the lift, least squares without colour) of a flight's rows, 0: it has none; and the
// mean of these over the flights that have rows, each as much as another.
double rows_constant(const rows_t *r, const double *v, int flight);
double rows_usual(const rows_t *r, const double *v, int flights);
// Takes a constant out of a flight's rows.
void rows_take(const rows_t *r, double *v, int flight, double constant);
// Takes each flight's own constant (times the lift, least squares without colour) out of a number by row.
void rows_center(const rows_t *r, double *v);
// Takes each flight's median out, plain or times the lift, whichever leaves less: what is there for less than
// half of the time stays as it is. room: as many numbers as rows.
void rows_clear(const rows_t *r, double *v, double *room);
// Makes each flight's own constant that of all rows.
void rows_level(const rows_t *r, double *v);

#endif
