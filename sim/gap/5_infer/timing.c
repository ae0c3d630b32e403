// timing.c - lags and delays that are too long for a straight line, or that measured rotor speeds show.
#include "gap/5_infer/timing.h"

#include "base/lsq_blocks.h"
#include "gap/2_predict/lines.h"
#include "gap/5_infer/limits.h"
#include <math.h>

// Returns n log(1 - c^2), where c is the correlation of measured and predicted steps from row to row: lower
// is more alike. Neither a wrong scale nor anything slow changes it.
static double unlike(const increments_t *s) {
  return s->yy > 0.0 && s->pp > 0.0 ? s->n * log(fmax(1.0 - s->yp * s->yp / s->yy / s->pp, 1e-9)) : 0.0;
}

// Returns by how much chance lowers the least unlike() of so many tries, where standard errors are `grow`
// times as large.
static double by_chance(double grow, int tries) {
  const double errors = grow * limits_noise(tries);
  return errors * errors;
}

// --- by trying them on force and turning ------------------------------------------------------------------

// The selection's straight lines find shorter lags and delays: half a period of the rows' filter is 62 ms.
#define STRAIGHT_S 0.045

// From three octaves below STRAIGHT_S to two above, by thirds: on a coarser grid a lag looks better than a
// true delay.
enum { KINDS = 2, TRIES_BELOW = 9, TRIES = 16 }; // KINDS: a lag, and a delay

static double tried_s(int k) {
  return STRAIGHT_S * pow(2.0, (k - TRIES_BELOW) / 3.0);
}

static done_t unlike_rows(set_t *s, const model_t *m, const lines_t *measured, const lines_t *left,
                          double *sum, why_t *why) {
  *sum = 0.0;
  TRY(residual_of(s, m, left->r, why));
  for (int ch = CH_FORCES - 1; ch < CH_SMOOTH; ch++) { // thrust and moments
    if (!residual_has(s, ch)) continue;
    const increments_t rows = increments_of(&s->smooth, measured->r[ch], left->r[ch]);
    *sum += unlike(&rows);
  }
  return DONE;
}

// Sets *sum for try number i of a candidate or, if i is below 0, for the model as it is.
static done_t try_one(const candidate_t *c, int i, set_t *s, const model_t *m, const lines_t *measured,
                      const lines_t *left, double *sum, why_t *why) {
  model_t with = *m;
  if (i >= 0) {
    fx_use_t use = c->use;
    fx_use_resize(&use, 0, tried_s(i));
    TRY(model_add_fx(&with, &use, why));
  }
  return unlike_rows(s, &with, measured, left, sum, why);
}

// What one of several threads needs for its tries.
typedef struct {
  set_t set;
  lines_t left;
  done_t status;
  why_t why;
} trying_t;

static void begin_trying(trying_t *t, const set_t *s) {
  t->left = (lines_t){.r = {NULL}};
  t->status = set_lend(s, &t->set, &t->why);
  if (t->status == DONE) t->status = lines_make(&t->left, s, &t->why);
}

static void end_trying(trying_t *t) {
  set_give_back(&t->set);
  lines_free(&t->left);
}

// Sets sum[] for every try of a candidate.
static done_t try_candidate(const candidate_t *c, const set_t *s, const model_t *m, const lines_t *measured,
                            double sum[TRIES], why_t *why) {
  done_t status = DONE;
#pragma omp parallel
  {
    trying_t t;
    begin_trying(&t, s);
#pragma omp for schedule(dynamic, 1)
    for (int k = 0; k < TRIES; k++)
      if (t.status == DONE) t.status = try_one(c, k, &t.set, m, measured, &t.left, &sum[k], &t.why);
#pragma omp critical(timing_failed)
    if (t.status != DONE) status = t.status, *why = t.why;
    end_trying(&t);
  }
  return status;
}

static done_t try_all(timing_t *found, const candidates_t *c, set_t *s, const model_t *m,
                      const lines_t *measured, const lines_t *left, why_t *why) {
  double none, best, sum[TRIES];
  TRY(residual_measured(s, measured->r, why));
  TRY(try_one(NULL, -1, s, m, measured, left, &none, why));
  best = none - by_chance(SCORE_CLUSTER, KINDS * TRIES);
  for (int i = 0; i < c->n; i++) {
    if (c->candidate[i].use.fx->group != FX_TIMING) continue;
    TRY(try_candidate(&c->candidate[i], s, m, measured, sum, why));
    for (int k = 0; k < TRIES; k++)
      if (sum[k] < best) best = sum[k], found->candidate = i, found->value_s = tried_s(k);
  }
  if (found->value_s <= STRAIGHT_S) found->candidate = -1;
  return DONE;
}

// --- by rotor speeds --------------------------------------------------------------------------------------

typedef struct {
  set_t *s;
  const model_t *m;
  bool lag;       // else a delay
  double extra_s; // delay that a lag has beside it: the way of a command through the vehicle
  double least_s; // smallest lag or delay that is named
  bool failed;
} speeds_t;

// unlike() of a rotor's thrust, by its measured speed and as commanded.
static double unlike_thrust(const grid_t *g, int rotor, const lagged_t *motors) {
  increments_t s = {.n = 0};
  for (int j = 1; j < g->n; j++) {
    const double y = g->measured_N[rotor][j] - g->measured_N[rotor][j - 1];
    const double p = motors->thrust_N[rotor][j] - motors->thrust_N[rotor][j - 1];
    if (!g->point[j].ok || !g->point[j - 1].ok || !isfinite(y)) continue;
    s.yy += y * y;
    s.pp += p * p;
    s.yp += y * p;
    s.n++;
  }
  return unlike(&s);
}

static double unlike_speeds(speeds_t *s, double value) {
  const lag_t lag = model_lag(s->m, s->lag ? value : 0.0);
  const double delay_s = s->m->frame.motor_delay_s + (s->lag ? s->extra_s : value);
  double sum = 0.0;
  for (int f = 0; f < s->s->n_grid; f++) {
    const lagged_t *motors = grid_motors(&s->s->grid[f], &lag, delay_s);
    if (!motors) s->failed = true;
    for (int k = 0; motors && k < ROTORS; k++) sum += unlike_thrust(&s->s->grid[f], k, motors);
  }
  return sum;
}

// Returns the minimum of a curve with one valley, to CANDIDATES_MISFIT of the least that is named: no right
// form is known more exactly.
static double least_in(speeds_t *s, double from, double to) {
  const double share = 0.381966;
  double a = from + share * (to - from), b = to - share * (to - from);
  double at_a = unlike_speeds(s, a), at_b = unlike_speeds(s, b);
  while (to - from > CANDIDATES_MISFIT * s->least_s)
    if (at_a < at_b) {
      to = b;
      b = a;
      at_b = at_a;
      at_a = unlike_speeds(s, a = from + share * (to - from));
    } else {
      from = a;
      a = b;
      at_a = at_b;
      at_b = unlike_speeds(s, b = to - share * (to - from));
    }
  return 0.5 * (from + to);
}

static double best_delay(speeds_t *s, double *left) {
  s->lag = false;
  s->extra_s = 0.0;
  const double value = least_in(s, 0.0, 0.06);
  *left = unlike_speeds(s, value);
  return value;
}

// Finds the best lag, with a delay beside it of 0, half of or all of least_s: that much is never named.
static double best_lag(speeds_t *s, double *left) {
  double best = 0.0, extra_s = 0.0;
  s->lag = true;
  *left = HUGE_VAL;
  for (int half = 0; half <= 2; half++) {
    s->extra_s = 0.5 * half * s->least_s;
    const double value = least_in(s, -0.9 * s->m->motor_tau_s, 0.25), there = unlike_speeds(s, value);
    if (!(there < *left)) continue;
    *left = there;
    best = value;
    extra_s = s->extra_s;
  }
  s->extra_s = extra_s;
  return best;
}

// True if every flight has rotor speeds and all commands that they follow: where a log misses commands, a
// lag takes their noise out of the prediction, and fits better even if none is there.
static bool speeds_tell(const set_t *s) {
  for (int f = 0; f < s->n_grid; f++)
    if (!s->grid[f].measured_N[ROTORS - 1] || grid_misses_commands(&s->grid[f])) return false;
  return s->n_grid > 0;
}

// Returns by how much standard errors grow, because points follow each other far closer than rows.
static double grown(const set_t *s) {
  return SCORE_CLUSTER / sqrt(fmin(RESIDUAL_HZ * s->grid[0].period_s, 1.0));
}

static timing_t measured_as(speeds_t *s, int candidate, double value, double none, double now) {
  const double grow = grown(s->s);
  const double h = 0.1 * fabs(value);
  const double bend = (unlike_speeds(s, value + h) - 2.0 * now + unlike_speeds(s, value - h)) / (h * h);
  const double p = lsq_f_above((none - now) / (grow * grow), 1.0, fmax(s->s->n_block - 1, 2.0));
  return (timing_t){true, candidate, value, bend > 0.0 ? grow * sqrt(2.0 / bend) : fabs(value), p};
}

static done_t read_speeds(timing_t *found, const candidates_t *c, set_t *set, const model_t *m, why_t *why) {
  speeds_t s = {.s = set, .m = m};
  const double none = unlike_speeds(&s, 0.0);
  double least = none - by_chance(grown(set), KINDS);
  found->measured = true;
  for (int i = 0; i < c->n; i++) {
    const fx_t *fx = c->candidate[i].use.fx;
    if (fx->group != FX_TIMING) continue;
    s.least_s = candidates_least(fx, set);
    double now, value = fx->lags ? best_lag(&s, &now) : best_delay(&s, &now);
    if (!(now < least)) continue;
    *found = measured_as(&s, i, value, none, now);
    least = now;
  }
  // A delay of 3 ms is not named; nor is the lag that would do instead.
  if (found->candidate >= 0 &&
      fabs(found->value_s) < candidates_least(c->candidate[found->candidate].use.fx, set))
    found->candidate = -1;
  return s.failed ? error_failed(why, "out of memory") : DONE;
}

done_t timing_find(timing_t *found, const candidates_t *c, set_t *s, const model_t *m, why_t *why) {
  *found = (timing_t){.candidate = -1};
  if (speeds_tell(s)) return read_speeds(found, c, s, m, why);
  lines_t measured, left = {.r = {NULL}};
  done_t status = lines_make(&measured, s, why);
  if (status == DONE) status = lines_make(&left, s, why);
  if (status == DONE) status = try_all(found, c, s, m, &measured, &left, why);
  lines_free(&measured);
  lines_free(&left);
  return status;
}
