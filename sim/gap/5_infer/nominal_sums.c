// nominal_sums.c - sums of products and residuals of nominal flights.
#include "gap/5_infer/nominal_sums.h"

#include "body/side_by_side.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Sets kept[] to the share of a size that least squares find although its column x has errors: x x' / x x,
// both white, where x' has none.
static done_t find_kept(double *kept, const set_t *s, const design_t *seen, const design_t *is,
                        const color_t color[CHANNELS], why_t *why) {
  const size_t rows = set_most_rows(s);
  double *const x = malloc(2 * rows * sizeof(double));
  if (!x) return error_failed(why, "out of memory");
  double *const y = x + rows;
  for (int k = 0; k < seen->columns; k++) {
    double xx = 0.0, xy = 0.0;
    for (int ch = 0; ch < CHANNELS; ch++) {
      if (!color[ch].used || !seen->x[ch][k]) continue;
      const rows_t *r = set_rows(s, ch);
      color_whiten(&color[ch], r, seen->x[ch][k], x);
      if (is->x[ch][k]) color_whiten(&color[ch], r, is->x[ch][k], y);
      for (int i = 0; i < r->n; i++) xx += x[i] * x[i];
      for (int i = 0; is->x[ch][k] && i < r->n; i++) xy += x[i] * y[i];
    }
    if (xx > 0.0) kept[k] = fmin(fmax(xy / xx, 0.0), 1.0);
  }
  free(x);
  return DONE;
}

// Finds kept[] by the same flights without errors. It stays 1, not known, where errors move a few rows out
// of sight.
static done_t find_errors(double *kept, const set_t *seen, const design_t *t, const color_t color[CHANNELS],
                          const gap_flights_t *truth, const nominal_job_t *job, why_t *why) {
  set_t own = {.n_grid = 0};
  design_t is = {.columns = 0};
  done_t status = nominal_set(&own, truth, job->set->n_grid > 1, job->base, why);
  memcpy(own.excluded, seen->excluded, sizeof own.excluded);
  if (status == DONE && own.smooth.n == seen->smooth.n && own.range.n == seen->range.n) {
    status = design_make(&is, &own, job->base, job->c, job->chosen, why);
    if (status == DONE) status = find_kept(kept, seen, t, &is, color, why);
    if (status == DONE) design_free(&is);
  }
  set_free(&own);
  return status;
}

static void find_misfit(double misfit[CHANNELS], const set_t *s, const design_t *t, const candidates_t *c) {
  for (int i = 0; i < c->n; i++)
    for (int q = 0; q < c->candidate[i].n * CHANNELS; q++) {
      const int ch = q % CHANNELS, k = q / CHANNELS, rows = set_rows(s, ch)->n;
      const double *const x = t->x[ch][c->candidate[i].first + k];
      double sum = 0.0;
      for (int r = 0; x && r < rows; r++) sum += x[r] * x[r];
      if (sum > 0.0)
        misfit[ch] = fmax(misfit[ch], CANDIDATES_MISFIT * c->candidate[i].typical[k] * sqrt(sum / rows));
    }
}

// One nominal flight: number i of NOMINAL_FLIGHTS along each of the set's tracks.
typedef struct {
  const nominal_job_t *job;
  const double *between; // by channel: what the log's flights differ by
  int i;
  done_t status;
  why_t why;
  nominal_left_t left;
  gap_flights_t is; // without errors, of the first one only; room for all tracks
  int flown, lost;
  double *total; // this flight's matrix in nominal_t.total
  double floor[CHANNELS];
  bool first; // only the first one sets kept and misfit
  double *kept, misfit[CHANNELS];
} part_t;

static done_t take_sums(part_t *p, set_t *s, const gap_flights_t *truth, const nominal_job_t *job,
                        why_t *why) {
  design_t t;
  gram_t g;
  double *residual[CHANNELS];
  TRY(design_make(&t, s, job->base, job->c, job->chosen, why));
  design_add_chosen(&t, s, job->c, job->chosen, -1.0); // the flown model has these effects
  for (int ch = 0; ch < CHANNELS; ch++) {
    residual[ch] = t.x[ch][t.columns];
    const int rows = set_rows(s, ch)->n;
    double sum = 0.0;
    for (int r = 0; r < rows; r++) sum += residual[ch][r] * residual[ch][r];
    p->floor[ch] = rows ? sqrt(sum / rows) : 0.0;
  }
  if (p->first) find_misfit(p->misfit, s, &t, job->c);
  done_t status = gram_make_total(&g, s, &t, job->ridge, p->between, why);
  if (status == DONE) {
    memcpy(p->total, g.total, (size_t)(g.size * g.size) * sizeof(double));
    if (p->first) status = find_errors(p->kept, s, &t, g.color, truth, job, why);
    gram_free(&g);
  }
  for (int ch = 0; ch < CHANNELS && status == DONE; ch++) {
    p->left.residual[ch] = residual[ch];
    t.x[ch][t.columns] = NULL;
  }
  design_free(&t);
  return status;
}

static void fly(void *parts, int k) {
  part_t *const p = (part_t *)parts + k;
  const nominal_job_t *const job = p->job;
  const closed_loop_t loop = closed_loop_varied(job->loop, p->i);
  const size_t flights = (size_t)job->set->n_grid;
  gap_flights_t *const seen = &p->left.flights;
  *seen = (gap_flights_t){.flight = calloc(flights, sizeof(gap_flight_t))};
  p->is = (gap_flights_t){.flight = calloc(flights, sizeof(gap_flight_t))};
  p->status = seen->flight && p->is.flight
                  ? nominal_flights(seen, p->first ? &p->is : NULL, job->set, &job->flown, &loop, NOMINAL_S,
                                    job->seed + (unsigned long)p->i, &p->why)
                  : error_failed(&p->why, "out of memory");
  p->flown = seen->n;
  p->lost = job->set->n_grid - seen->n;
}

static done_t sum_up(part_t *p, why_t *why) {
  set_t *const own = &p->left.set;
  TRY(nominal_set(own, &p->left.flights, p->job->set->n_grid > 1, p->job->base, why));
  memcpy(own->excluded, p->job->set->excluded, sizeof own->excluded);
  return take_sums(p, own, p->first ? &p->is : NULL, p->job, why);
}

static void flights_free(gap_flights_t *flights) {
  for (int f = 0; f < flights->n; f++) gap_flight_free(&flights->flight[f]);
  free(flights->flight);
}

static void left_free(nominal_left_t *left) {
  for (int ch = 0; ch < CHANNELS; ch++) free(left->residual[ch]);
  set_free(&left->set);
  flights_free(&left->flights);
  *left = (nominal_left_t){.flights = {.n = 0}};
}

static void end_part(part_t *p) {
  if (p->status == DONE) p->status = sum_up(p, &p->why);
  if (p->status != DONE) left_free(&p->left);
  flights_free(&p->is);
}

// Flies all side by side, then sums up each by itself. The first that could be flown sets kept and misfit;
// if it is not number 0, it is flown again for them.
static void fly_all(nominal_t *n, part_t part[NOMINAL_FLIGHTS], const nominal_job_t *job,
                    const double between[CHANNELS]) {
  const size_t room = (size_t)(n->size * n->size);
  for (int i = 0; i < NOMINAL_FLIGHTS; i++)
    part[i] = (part_t){.job = job,
                       .between = between,
                       .i = i,
                       .total = n->total + (size_t)i * room,
                       .kept = n->kept,
                       .first = i == 0};
  side_by_side_shared(NOMINAL_FLIGHTS, fly, part);
#pragma omp parallel for schedule(dynamic, 1)
  for (int i = 0; i < NOMINAL_FLIGHTS; i++) end_part(&part[i]);
  int first = 0;
  while (first < NOMINAL_FLIGHTS && part[first].status == BAD_INPUT) first++;
  if (first == 0 || first == NOMINAL_FLIGHTS) return;
  part[first].first = true;
  left_free(&part[first].left);
  fly(part, first);
  end_part(&part[first]);
}

// Takes the flights that could be flown, in their order.
static done_t take_parts(nominal_t *n, const part_t part[NOMINAL_FLIGHTS], why_t *why) {
  const size_t room = (size_t)(n->size * n->size);
  done_t status = DONE;
  for (int i = 0; i < NOMINAL_FLIGHTS; i++) {
    const part_t *const p = &part[i];
    n->flown += p->flown;
    n->lost += p->lost;
    if (p->status == FAILED) status = FAILED, *why = p->why;
    if (p->status != DONE) continue;
    memmove(n->total + (size_t)n->n * room, p->total, room * sizeof(double));
    n->left[n->n++] = p->left;
    for (int ch = 0; ch < CHANNELS; ch++) n->floor[ch] += p->floor[ch];
    if (p->first) memcpy(n->misfit, p->misfit, sizeof n->misfit);
  }
  for (int ch = 0; ch < CHANNELS && n->n; ch++) n->floor[ch] /= n->n;
  return status;
}

done_t nominal_make(nominal_t *n, const nominal_job_t *job, why_t *why) {
  *n = (nominal_t){.size = job->c->columns + 1};
  n->total = calloc((size_t)(NOMINAL_FLIGHTS * n->size * n->size), sizeof(double));
  n->scan = calloc(NOMINAL_FLIGHTS, sizeof *n->scan);
  n->left = calloc(NOMINAL_FLIGHTS, sizeof *n->left);
  n->kept = malloc((size_t)n->size * sizeof(double));
  part_t *const part = malloc(NOMINAL_FLIGHTS * sizeof *part);
  for (int k = 0; n->kept && k < n->size; k++) n->kept[k] = 1.0;
  const bool room = n->total && n->scan && n->left && n->kept && part;
  double between[CHANNELS];
  done_t status =
      room ? whiten_between(job->set, &job->flown, between, why) : error_failed(why, "out of memory");
  if (status == DONE) {
    fly_all(n, part, job, between);
    status = take_parts(n, part, why);
  }
  free(part);
  if (status != DONE) nominal_free(n);
  return status;
}

static void forget_left(nominal_t *n) {
  for (int i = 0; n->left && i < n->n; i++) left_free(&n->left[i]);
  free(n->left);
  n->left = NULL;
}

static done_t look_at(const nominal_t *n, int i, const model_t *base, why_t *why) {
  nominal_left_t *const left = &n->left[i];
  TRY(windows_keep(&left->set, base, why));
  return unknown_scan(&left->set, base, left->residual, &n->scan[i], why);
}

done_t nominal_look(nominal_t *n, const model_t *base, why_t *why) {
  done_t status = DONE;
#pragma omp parallel for schedule(dynamic, 1)
  for (int i = 0; i < (n->left ? n->n : 0); i++) {
    why_t own;
    if (look_at(n, i, base, &own) == DONE) continue;
#pragma omp critical(nominal_failed)
    status = FAILED, *why = own;
  }
  forget_left(n);
  return status;
}

void nominal_free(nominal_t *n) {
  forget_left(n);
  free(n->total);
  free(n->scan);
  free(n->kept);
  *n = (nominal_t){.n = 0};
}
