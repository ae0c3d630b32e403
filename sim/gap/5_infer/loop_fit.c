// loop_fit.c - noise and disturbance with which nominal flights shake as the log does.
#include "gap/5_infer/loop_fit.h"

#include "gap/2_predict/lines.h"
#include "gap/5_infer/unknown.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
  double of[CH_SMOOTH]; // mean squares of rows
} squares_t;

static double mean_squares(const double *v, int n, bool about_mean) {
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < n; i++) {
    sum += v[i];
    squares += v[i] * v[i];
  }
  return n ? (squares - (about_mean ? sum * sum / n : 0.0)) / n : 0.0;
}

// Mean squares of what a model leaves. Disturbing moments are large and slow on real vehicles; control
// cancels them, which is what the nominal flights are to show: they are read before the cleaning, with their
// mean. loop: how the flights were flown, or null.
static done_t read_rows(closed_loop_t *loop, squares_t *left, const set_t *s, const model_t *m,
                        const flown_by_t *by, const lines_t *l, why_t *why) {
  for (int ch = CH_WX; ch < CH_SMOOTH; ch++) left->of[ch] = mean_squares(l->r[ch], s->smooth.n, false);
  if (loop) *loop = closed_loop_of(s, m, by, l->r);
  TRY(unknown_clean(s, m, l->r, why));
  for (int ch = 0; ch < CH_FORCES; ch++) left->of[ch] = mean_squares(l->r[ch], s->smooth.n, true);
  if (!loop) return DONE;
  const closed_loop_t raw = *loop;
  closed_loop_shaken(loop, s, m, l->r);
  memcpy(loop->turn_radps2, raw.turn_radps2, sizeof raw.turn_radps2);
  loop->turn_tau_s = raw.turn_tau_s;
  return DONE;
}

static done_t read_off(closed_loop_t *loop, squares_t *left, set_t *s, const model_t *m, const flown_by_t *by,
                       why_t *why) {
  lines_t l = {.r = {NULL}};
  done_t status = residual_lines(s, m, &l, why);
  if (status == DONE) status = read_rows(loop, left, s, m, by, &l, why);
  lines_free(&l);
  return status;
}

static done_t left_of(const gap_flights_t *flown, const set_t *like, const closed_loop_t *loop,
                      squares_t *left, const model_t *m, why_t *why) {
  set_t own = {.n_grid = 0};
  done_t status = nominal_set(&own, flown, m, why);
  memcpy(own.excluded, like->excluded, sizeof own.excluded);
  if (status == DONE) status = windows_keep(&own, m, why);
  if (status == DONE) status = read_off(NULL, left, &own, m, loop->flown_by, why);
  set_free(&own);
  return status;
}

// What is left of flights that are flown so.
static done_t trial(const closed_loop_t *loop, squares_t *left, const set_t *s, const model_t *m,
                    unsigned long seed, why_t *why) {
  gap_flights_t flown = {.flight = calloc((size_t)s->n_grid + 1, sizeof(gap_flight_t))};
  if (!flown.flight) return error_failed(why, "out of memory");
  done_t status = nominal_flights(&flown, NULL, s, m, loop, seed, why);
  if (status == DONE) status = left_of(&flown, s, loop, left, m, why);
  for (int f = 0; f < flown.n; f++) gap_flight_free(&flown.flight[f]);
  free(flown.flight);
  return status;
}

static double *disturbance(closed_loop_t *loop, int ch) {
  return ch < CH_FORCES ? &loop->force_mps2[ch] : &loop->turn_radps2[ch - CH_WX];
}

// Squares of independent causes add: without a disturbance (none) and with one (some) they tell by how much
// it is to be multiplied, so that what the log leaves is left.
static double times(double none, double some, double log) {
  if (log <= none) return 0.0;
  return some > none ? sqrt((log - none) / (some - none)) : HUGE_VAL;
}

static done_t scale(closed_loop_t *loop, const squares_t *log, const set_t *s, const model_t *m,
                    unsigned long seed, why_t *why) {
  TRY(closed_loop_match(loop, s, m, seed, why));
  closed_loop_t calm = *loop;
  squares_t none, some;
  for (int ch = 0; ch < CH_SMOOTH; ch++) {
    *disturbance(&calm, ch) = 0.0;
    *disturbance(loop, ch) = fmax(*disturbance(loop, ch), sqrt(log->of[ch])); // to begin with, all of it
  }
  const closed_loop_t *const flown[] = {&calm, loop};
  squares_t *const seen[] = {&none, &some};
  done_t status[2];
  why_t whys[2];
#pragma omp parallel for
  for (int i = 0; i < 2; i++) status[i] = trial(flown[i], seen[i], s, m, seed, &whys[i]);
  for (int i = 0; i < 2; i++) {
    if (status[i] == DONE) continue;
    *why = whys[i];
    return status[i];
  }
  for (int ch = 0; ch < CH_SMOOTH; ch++) {
    const double by = times(none.of[ch], some.of[ch], log->of[ch]);
    const double most = ch < CH_FORCES ? HUGE_VAL : 1.0; // what turns it was read before control cancelled it
    if (isfinite(by)) *disturbance(loop, ch) *= fmin(by, most);
    if (!residual_has(s, ch)) *disturbance(loop, ch) = 0.0;
  }
  // A disturbance of one channel shakes the others, too: none of them more than in the log.
  double share = 1.0;
  TRY(trial(loop, &some, s, m, seed, why));
  for (int ch = 0; ch < CH_SMOOTH; ch++)
    if (residual_has(s, ch) && none.of[ch] < log->of[ch])
      share = fmin(share, times(none.of[ch], some.of[ch], log->of[ch]));
  for (int ch = 0; ch < CH_SMOOTH; ch++) *disturbance(loop, ch) *= share;
  return DONE;
}

done_t loop_fit(closed_loop_t *loop, set_t *s, const model_t *m, const flown_by_t *by, unsigned long seed,
                why_t *why) {
  squares_t log;
  TRY(read_off(loop, &log, s, m, by, why));
  return scale(loop, &log, s, m, seed, why) == FAILED ? FAILED : DONE;
}
