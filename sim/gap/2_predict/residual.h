// residual.h - measured less predicted, channel by channel, as rows at about 25 Hz for least squares.
//
// Force and turning go through the same zero-phase low-pass, second-order Butterworth at 8 Hz forwards and
// backwards; so must every regressor. Turning is measured as the gyro's central difference over two points; a
// prediction gets the mean over the same span (Simpson). The range has a row for every fresh sample.
#ifndef SIM_GAP_2_PREDICT_RESIDUAL_H
#define SIM_GAP_2_PREDICT_RESIDUAL_H

#include "gap/2_predict/grid.h"

#define RESIDUAL_HZ 25.0
#define BLOCK_S     2.0 // what is taken to be independent

// Rows of all flights, in order. Two lists: of the smooth channels, and of the range.
typedef struct {
  int n;
  int *point;    // of its flight's grid
  int *flight;   // number of the grid
  int *block;    // counts over all flights
  bool *follows; // the row before is one step earlier: there is no gap between
} rows_t;

typedef struct {
  grid_t *grid; // one per flight
  int n_grid;
  rows_t smooth, range;
  int n_block, *half; // of each block: which half-flight it belongs to
  int n_half;
  bool muted[CHANNELS]; // muted.h
} set_t;

static inline const rows_t *set_rows(const set_t *s, int channel) {
  return channel == CH_RANGE ? &s->range : &s->smooth;
}

// Takes the grids over. BAD_INPUT: no row at all (says why); FAILED: no memory. *s can be freed then.
MUST_CHECK done_t set_make(set_t *s, grid_t *grid, int n, why_t *why);
void set_free(set_t *s);

typedef enum { SERIES_PREDICTED, SERIES_RATE } series_t; // values, or a rate whose derivative is wanted

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

// One flight, channel by channel by point, to that flight's rows. row: a null pointer where a channel is not
// wanted. scratch: CH_SMOOTH numbers per point of the flight's grid. Of a smooth channel's numbers, those
// below 1e-140 become 0.
void residual_rows(const set_t *s, int flight, series_t kind, const double *const series[CHANNELS],
                   double *scratch, double *const row[CHANNELS]);

// What was measured, rows over all flights of the channels for which there is room. FAILED: no memory.
MUST_CHECK done_t residual_measured(const set_t *s, double *const row[CHANNELS], why_t *why);

// The channel can be formed from these logs.
bool residual_has(const set_t *s, int channel);

#endif
