// loop_fit.c - fits noise and disturbances with which nominal flights shake as the log does.
#include "gap/5_infer/loop_fit.h"

#include "gap/2_predict/lines.h"
#include "gap/3_feedback/gusts.h"
#include "gap/3_feedback/stirs.h"
#include "gap/5_infer/unknown.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
  double of[3], all[3]; // mean squares of rows, by axis: of what stirs (stirs.h), and of all
} squares_t;

static double mean_squares(const double *v, int n) {
  double squares = 0.0;
  for (int i = 0; i < n; i++) squares += v[i] * v[i];
  return n ? squares / n : 0.0;
}

// Finds what is left of the turning. Of several flights each one's constant is taken out: it is no
// disturbance, and one that they share has a name.
static done_t moments_left(squares_t *left, set_t *s, const model_t *m, lines_t *l, why_t *why) {
  TRY(residual_lines(s, m, l, why));
  for (int k = 0; k < 3; k++) {
    double *const v = l->r[CH_WX + k];
    stirs_t stirs = {.share = 0.0};
    if (s->n_grid > 1) rows_center(&s->smooth, v);
    TRY(stirs_add(&stirs, s, v, why));
    left->of[k] = stirs_all(&stirs);
    left->all[k] = mean_squares(v, s->smooth.n);
  }
  return DONE;
}

// Reads noise and disturbances off the log. Moments are read before unknown_clean(): on real vehicles they
// are large and slow, and control cancels them, which nominal flights are to show.
static done_t read_off(closed_loop_t *loop, squares_t *left, set_t *s, const model_t *m, const flown_by_t *by,
                       unsigned long seed, lines_t *l, why_t *why) {
  gusts_t gusts;
  TRY(moments_left(left, s, m, l, why));
  TRY(closed_loop_of(loop, s, m, by, l->r, why));
  const double *const white = s->grid[0].acceleration_made ? loop->vel_mps : loop->acc_mps2;
  TRY(gusts_of(s, l->r, white, seed, &gusts, why));
  TRY(unknown_clean(s, m, l->r, why));
  loop->range_m = closed_loop_range_m(s, m, l->r[CH_RANGE]);
  loop->force_tau_s = gusts.tau_s;
  memcpy(loop->force_mps2, gusts.force_mps2, sizeof gusts.force_mps2);
  memcpy(loop->quick_mps2, gusts.quick_mps2, sizeof gusts.quick_mps2);
  for (int k = 0; k < 3; k++) loop->vel_mps[k] = hypot(loop->vel_mps[k], gusts.velocity_mps[k]);
  return DONE;
}

static done_t left_of(const gap_flights_t *flown, const set_t *like, squares_t *left, const model_t *m,
                      why_t *why) {
  set_t own = {.n_grid = 0};
  lines_t l = {.r = {NULL}};
  done_t status = nominal_set(&own, flown, like->n_grid > 1, m, why);
  memcpy(own.excluded, like->excluded, sizeof own.excluded);
  if (status == DONE) status = windows_keep(&own, m, why);
  if (status == DONE) status = moments_left(left, &own, m, &l, why);
  lines_free(&l);
  set_free(&own);
  return status;
}

// Flies with this loop, and finds what is left of the turning.
static done_t trial(const closed_loop_t *loop, squares_t *left, const set_t *s, const model_t *m,
                    unsigned long seed, why_t *why) {
  gap_flights_t flown = {.flight = calloc((size_t)s->n_grid + 1, sizeof(gap_flight_t))};
  if (!flown.flight) return error_failed(why, "out of memory");
  done_t status = nominal_flights(&flown, NULL, s, m, loop, TRIAL_S, seed, why);
  if (status == DONE) status = left_of(&flown, s, left, m, why);
  for (int f = 0; f < flown.n; f++) gap_flight_free(&flown.flight[f]);
  free(flown.flight);
  return status;
}

// Returns the factor on a disturbance with which flights leave as much as the log. none, some, log: mean
// squares without it, with it, and in the log; squares of independent causes add. HUGE_VAL: it adds nothing.
static double times(double none, double some, double log) {
  if (log <= none) return 0.0;
  return some > none ? sqrt((log - none) / (some - none)) : HUGE_VAL;
}

// Scales the disturbing moments, because what is left of them depends on control. Forces stay as read.
static done_t scale(closed_loop_t *loop, const squares_t *log, const set_t *s, const model_t *m,
                    unsigned long seed, why_t *why) {
  TRY(closed_loop_match(loop, s, m, seed, why));
  closed_loop_t calm = *loop;
  squares_t none, some;
  for (int k = 0; k < 3; k++) {
    calm.turn_radps2[k] = 0.0;
    // Begin with all that stirs in the log; an axis that is not compared gets none.
    loop->turn_radps2[k] = residual_has(s, CH_WX + k) ? fmax(loop->turn_radps2[k], sqrt(log->of[k])) : 0.0;
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
  for (int k = 0; k < 3; k++) {
    const double by = times(none.of[k], some.of[k], log->of[k]);
    // At most all that the log leaves: that was before control cancelled it.
    if (isfinite(by)) loop->turn_radps2[k] = fmin(by * loop->turn_radps2[k], sqrt(log->all[k]));
  }
  // A disturbance about one axis shakes the others, too: scale all so that no axis shakes more than in the
  // log.
  double share = 1.0;
  TRY(trial(loop, &some, s, m, seed, why));
  for (int k = 0; k < 3; k++)
    if (residual_has(s, CH_WX + k) && none.of[k] < log->of[k])
      share = fmin(share, times(none.of[k], some.of[k], log->of[k]));
  for (int k = 0; k < 3; k++) loop->turn_radps2[k] *= share;
  return DONE;
}

done_t loop_fit(closed_loop_t *loop, set_t *s, const model_t *m, const flown_by_t *by, unsigned long seed,
                why_t *why) {
  squares_t log;
  lines_t l = {.r = {NULL}};
  done_t status = read_off(loop, &log, s, m, by, seed, &l, why);
  lines_free(&l);
  TRY(status);
  status = scale(loop, &log, s, m, seed, why);
  return status == FAILED ? FAILED : DONE;
}
