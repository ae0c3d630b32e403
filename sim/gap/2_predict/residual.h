// residual.h - measured less predicted, channel by channel, as rows at about 25 Hz for least squares.
//
// Force and turning go through the same zero-phase low-pass, second-order Butterworth at 8 Hz forwards and
// backwards; so must every regressor. Turning is measured as the gyro's central difference over two points,
// so a prediction is averaged over the same span (Simpson). The range has a row for every fresh sample.
#ifndef SIM_GAP_2_PREDICT_RESIDUAL_H
#define SIM_GAP_2_PREDICT_RESIDUAL_H

#include "gap/2_predict/lines.h"
#include "gap/2_predict/predict.h"
#include "gap/2_predict/set.h"

typedef enum { SERIES_PREDICTED, SERIES_RATE } series_t; // values, or a rate whose derivative is wanted

// Turns one flight's series, by channel and point, into that flight's rows. row: a null pointer where a
// channel is not wanted. scratch: RESIDUAL_SCRATCH numbers per point of the flight's grid, 0 or what an
// earlier call left. In smooth channels, numbers below 1e-140 become 0.
void residual_rows(const set_t *s, int flight, series_t kind, const double *const series[CHANNELS],
                   double *scratch, double *const row[CHANNELS]);

// Fills the measured rows of all flights, for channels that are not null in `row`. FAILED: no memory.
MUST_CHECK done_t residual_measured(set_t *s, double *const row[CHANNELS], why_t *why);

// True if the channel can be formed from these logs.
bool residual_has(const set_t *s, int channel);

// Fills the residual of a model: r[channel], a number for each of its rows. FAILED: no memory.
MUST_CHECK done_t residual_of(set_t *s, const model_t *m, double *const r[CHANNELS], why_t *why);

// The same, into lines that are made here. Free them, also on an error.
MUST_CHECK static inline done_t residual_lines(set_t *s, const model_t *m, lines_t *l, why_t *why) {
  TRY(lines_make(l, s, why));
  return residual_of(s, m, l->r, why);
}

// Returns the share of the increments' sum of squares in a residual that comes from jumps: what the largest
// hundredth of them holds beyond a Gaussian process. Behind the filter a jump spans four rows; one of 100
// times the noise is three quarters of the squares in 20 s, and half of them in a minute. Fewer than a
// hundred increments, or no memory: 0.
double residual_jumps(const rows_t *r, const double *v);

// Sums of squares and products of measured and predicted increments, over n rows that follow one another.
// They say how alike the two are: slow parts do not count, and a scale shows as one.
typedef struct {
  double yy, pp, yp; // measured, predicted, both
  int n;
} increments_t;

static inline increments_t increments_of(const rows_t *r, const double *measured, const double *residual) {
  increments_t s = {.n = 0};
  for (int i = 1; i < r->n; i++) {
    if (!r->follows[i]) continue;
    const double y = measured[i] - measured[i - 1], p = y - (residual[i] - residual[i - 1]);
    s.yy += y * y;
    s.pp += p * p;
    s.yp += y * p;
    s.n++;
  }
  return s;
}

#endif
