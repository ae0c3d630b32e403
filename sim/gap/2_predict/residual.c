// residual.c - measured less predicted, as rows for least squares.
#include "gap/2_predict/residual.h"

#include "base/nth.h"
#include "gap/2_predict/lines.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void measured(const grid_point_t *p, double at[CHANNELS]) {
  d3_put(at, p->acc_b_mps2);
  d3_put(at + CH_FORCES, p->rate_b_radps);
  at[CH_RANGE] = p->range_m;
}

static done_t keep_measured(set_t *s, why_t *why) {
  for (int ch = 0; ch < CHANNELS; ch++)
    if (!s->measured[ch] && !(s->measured[ch] = calloc((size_t)set_rows(s, ch)->n + 1, sizeof(double))))
      return error_failed(why, "out of memory");
  for (int f = 0; f < s->n_grid; f++) {
    const grid_t *g = &s->grid[f];
    const size_t n = (size_t)g->n + 1;
    double *const room = calloc((CHANNELS + RESIDUAL_SCRATCH) * n, sizeof(double)), *series[CHANNELS];
    if (!room) return error_failed(why, "out of memory");
    for (size_t ch = 0; ch < CHANNELS; ch++) series[ch] = room + ch * n;
    for (int j = 0; j < g->n; j++) {
      double at[CHANNELS];
      measured(&g->point[j], at);
      for (int ch = 0; ch < CHANNELS; ch++) series[ch][j] = at[ch];
    }
    residual_rows(s, f, SERIES_RATE, (const double *const *)series, room + CHANNELS * n, s->measured);
    free(room);
  }
  return DONE;
}

done_t residual_measured(set_t *s, double *const row[CHANNELS], why_t *why) {
  if (!s->measured[CHANNELS - 1]) TRY(keep_measured(s, why));
  for (int ch = 0; ch < CHANNELS; ch++)
    if (row[ch]) memcpy(row[ch], s->measured[ch], (size_t)set_rows(s, ch)->n * sizeof(double));
  return DONE;
}

bool residual_has(const set_t *s, int channel) {
  if (s->excluded[channel]) return false;
  if (channel == CH_RANGE) return s->range.n > 20 && s->grid[0].has_position;
  for (int i = 0; i < s->n_grid; i++) {
    const grid_t *g = &s->grid[i];
    if (channel < CH_FORCES ? !g->has_force : !(g->has_rates && g->has_moments)) return false;
  }
  return true;
}

// Fills r with the measured less the predicted rows.
static done_t residual_with(set_t *s, const model_t *m, const flight_lines_t *l, const lines_t *predicted,
                            double *const r[CHANNELS], why_t *why) {
  TRY(residual_measured(s, r, why));
  for (int f = 0; f < s->n_grid; f++) {
    TRY(replay(&s->grid[f], m, l->base, why));
    residual_rows(s, f, SERIES_PREDICTED, (const double *const *)l->base, l->scratch, predicted->r);
  }
  for (int c = 0; c < CHANNELS; c++)
    for (int i = 0; i < set_rows(s, c)->n; i++) r[c][i] -= predicted->r[c][i];
  return DONE;
}

done_t residual_of(set_t *s, const model_t *m, double *const r[CHANNELS], why_t *why) {
  lines_t predicted;
  flight_lines_t l = {.room = NULL};
  done_t status = lines_make(&predicted, s, why);
  if (status == DONE && !flight_lines_make(&l, s)) status = error_failed(why, "out of memory");
  if (status == DONE) status = residual_with(s, m, &l, &predicted, r, why);
  free(l.room);
  lines_free(&predicted);
  return status;
}

// Share of a Gaussian's variance that lies in its largest hundredth.
#define GAUSSIAN_BEYOND 0.0845
#define JUMPS_OF        100 // increments, of which a hundredth is one

double residual_jumps(const rows_t *r, const double *v) {
  double *const square = malloc(((size_t)r->n + 1) * sizeof(double)), all = 0.0, largest = 0.0;
  int n = 0;
  for (int i = 1; square && i < r->n; i++) {
    if (!r->follows[i]) continue;
    square[n] = (v[i] - v[i - 1]) * (v[i] - v[i - 1]);
    all += square[n++];
  }
  const int first = n - (n + 99) / 100;
  if (n > 0) (void)nth_smallest(square, n, first);
  for (int i = first; i < n; i++) largest += square[i];
  free(square);
  return all > 0.0 && n >= JUMPS_OF ? fmax(0.0, 1.0 - (1.0 - largest / all) / (1.0 - GAUSSIAN_BEYOND)) : 0.0;
}
