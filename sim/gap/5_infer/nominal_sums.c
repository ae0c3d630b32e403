// nominal_sums.c - what the workflow sees in flights in which nothing is hidden.
#include "gap/5_infer/nominal_sums.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define KEPT_LEAST 0.02

// What least squares find of a size, whose column holds errors: x x' / x x, both white.
static done_t find_kept(nominal_t *n, const set_t *s, const design_t *seen, const design_t *is,
                        const color_t color[CHANNELS], why_t *why) {
  const size_t rows = set_most_rows(s);
  double *const x = malloc(2 * rows * sizeof(double));
  if (!x) return error_failed(why, "out of memory");
  double *const y = x + rows;
  for (int k = 0; k < n->size - 1; k++) {
    double xx = 0.0, xy = 0.0;
    for (int ch = 0; ch < CHANNELS; ch++) {
      if (!color[ch].used || !seen->x[ch][k]) continue;
      const rows_t *r = set_rows(s, ch);
      color_whiten(&color[ch], r, seen->x[ch][k], x);
      if (is->x[ch][k]) color_whiten(&color[ch], r, is->x[ch][k], y);
      for (int i = 0; i < r->n; i++) xx += x[i] * x[i];
      for (int i = 0; is->x[ch][k] && i < r->n; i++) xy += x[i] * y[i];
    }
    if (xx > 0.0) n->kept[k] = fmin(fmax(xy / xx, KEPT_LEAST), 1.0);
  }
  free(x);
  return DONE;
}

// The same flights without errors have the same rows, but for a few that errors move out of sight: then
// nothing is known.
static done_t find_errors(nominal_t *n, const set_t *seen, const design_t *t, const color_t color[CHANNELS],
                          const gap_flights_t *truth, const nominal_job_t *job, why_t *why) {
  set_t own = {.n_grid = 0};
  design_t is = {.columns = 0};
  done_t status = nominal_set(&own, truth, job->base, why);
  memcpy(own.excluded, seen->excluded, sizeof own.excluded);
  if (status == DONE && own.smooth.n == seen->smooth.n && own.range.n == seen->range.n) {
    status = design_make(&is, &own, job->base, job->c, job->chosen, why);
    if (status == DONE) status = find_kept(n, seen, t, &is, color, why);
    if (status == DONE) design_free(&is);
  }
  set_free(&own);
  return status;
}

static void find_misfit(nominal_t *n, const set_t *s, const design_t *t, const candidates_t *c) {
  for (int i = 0; i < c->n; i++)
    for (int q = 0; q < c->candidate[i].n * CHANNELS; q++) {
      const int ch = q % CHANNELS, k = q / CHANNELS, rows = set_rows(s, ch)->n;
      const double *const x = t->x[ch][c->candidate[i].first + k];
      double sum = 0.0;
      for (int r = 0; x && r < rows; r++) sum += x[r] * x[r];
      if (sum > 0.0)
        n->misfit[ch] =
            fmax(n->misfit[ch], CANDIDATES_MISFIT * c->candidate[i].typical[k] * sqrt(sum / rows));
    }
}

static done_t take_sums(nominal_t *n, int i, set_t *s, const gap_flights_t *truth, const nominal_job_t *job,
                        why_t *why) {
  design_t t;
  gram_t g;
  double *residual[CHANNELS];
  const explained_t nothing = {.n = 0};
  TRY(design_make(&t, s, job->base, job->c, job->chosen, why));
  design_add_chosen(&t, s, job->c, job->chosen, -1.0); // the flown model has them
  for (int ch = 0; ch < CHANNELS; ch++) {
    residual[ch] = t.x[ch][t.columns];
    const int rows = set_rows(s, ch)->n;
    double sum = 0.0;
    for (int r = 0; r < rows; r++) sum += residual[ch][r] * residual[ch][r];
    n->floor[ch] += rows ? sqrt(sum / rows) : 0.0;
  }
  if (i == 0) find_misfit(n, s, &t, job->c);
  done_t status = gram_make(&g, s, &t, &nothing, NULL, why);
  if (status == DONE) {
    memcpy(n->total + (size_t)i * (size_t)(n->size * n->size), g.total,
           (size_t)(n->size * n->size) * sizeof(double));
    if (truth) status = find_errors(n, s, &t, g.color, truth, job, why);
    gram_free(&g);
  }
  if (status == DONE) status = unknown_scan(s, job->base, residual, &n->scan[i], why);
  design_free(&t);
  return status;
}

// Flight number i of NOMINAL_FLIGHTS along each of the set's tracks.
static done_t one(nominal_t *n, int i, const nominal_job_t *job, why_t *why) {
  const set_t *s = job->set;
  const closed_loop_t loop = closed_loop_varied(job->loop, i);
  const size_t flights = (size_t)s->n_grid;
  gap_flights_t flown = {.flight = calloc(2 * flights, sizeof(gap_flight_t))}, truth = {.n = 0};
  gap_flights_t *const is = n->n == 0 ? &truth : NULL;
  set_t own = {.n_grid = 0};
  if (!flown.flight) return error_failed(why, "out of memory");
  truth.flight = flown.flight + flights;
  done_t status = nominal_flights(&flown, is, s, &job->flown, &loop, job->seed + (unsigned long)i, why);
  n->flown += flown.n;
  n->lost += s->n_grid - flown.n;
  if (status == DONE) status = nominal_set(&own, &flown, job->base, why);
  memcpy(own.excluded, s->excluded, sizeof own.excluded);
  if (status == DONE) status = take_sums(n, n->n, &own, is, job, why);
  n->n += status == DONE;
  set_free(&own);
  for (size_t f = 0; f < 2 * flights; f++) gap_flight_free(&flown.flight[f]);
  free(flown.flight);
  return status;
}

done_t nominal_make(nominal_t *n, const nominal_job_t *job, why_t *why) {
  *n = (nominal_t){.size = job->c->columns + 1};
  n->total = calloc((size_t)(NOMINAL_FLIGHTS * n->size * n->size), sizeof(double));
  n->scan = calloc(NOMINAL_FLIGHTS, sizeof *n->scan);
  n->kept = malloc((size_t)n->size * sizeof(double));
  for (int k = 0; n->kept && k < n->size; k++) n->kept[k] = 1.0;
  done_t status = n->total && n->scan && n->kept ? DONE : error_failed(why, "out of memory");
  for (int i = 0; i < NOMINAL_FLIGHTS && status != FAILED; i++) status = one(n, i, job, why);
  for (int ch = 0; ch < CHANNELS && n->n; ch++) n->floor[ch] /= n->n;
  if (status == FAILED) nominal_free(n);
  return status == FAILED ? FAILED : DONE;
}

void nominal_free(nominal_t *n) {
  free(n->total);
  free(n->scan);
  free(n->kept);
  *n = (nominal_t){.n = 0};
}
