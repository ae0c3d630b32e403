// timing.c - lags and delays that are too long for a straight line, or that measured rotor speeds show.
#include "gap/5_infer/timing.h"

#include "base/lsq_blocks.h"
#include "gap/2_predict/lines.h"
#include <math.h>

#define BETTER 50.0 // twice the logarithm of the likelihood, at least

// n log(1 - c^2), c: correlation from row to row of what was measured and what was predicted. A scale that is
// wrong does not change it, nor does what is slow.
static double unlike(const increments_t *s) {
  return s->yy > 0.0 && s->pp > 0.0 ? s->n * log(fmax(1.0 - s->yp * s->yp / s->yy / s->pp, 1e-9)) : 0.0;
}

// --- by trying them on force and turning ------------------------------------------------------------------

#define STRAIGHT_S 0.045 // shorter ones the straight line finds

static const double TRY_S[] = {0.005, 0.01, 0.015, 0.025, 0.035, 0.05, 0.065, 0.08, 0.1, 0.13, 0.16};
#define N_TRY ((int)(sizeof TRY_S / sizeof *TRY_S))

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

static done_t try_all(timing_t *found, const candidates_t *c, set_t *s, const model_t *m,
                      const lines_t *measured, const lines_t *left, why_t *why) {
  double none, best;
  TRY(residual_measured(s, measured->r, why));
  TRY(unlike_rows(s, m, measured, left, &none, why));
  best = none - BETTER;
  for (int i = 0; i < c->n; i++)
    for (int k = 0; c->candidate[i].use.fx->group == FX_TIMING && k < N_TRY; k++) {
      model_t with = *m;
      fx_use_t use = c->candidate[i].use;
      double now;
      fx_use_resize(&use, 0, TRY_S[k]);
      TRY(model_add_fx(&with, &use, why));
      TRY(unlike_rows(s, &with, measured, left, &now, why));
      if (!(now < best)) continue;
      best = now;
      found->candidate = i;
      found->value_s = TRY_S[k];
    }
  if (found->value_s <= STRAIGHT_S) found->candidate = -1;
  return DONE;
}

// --- by rotor speeds --------------------------------------------------------------------------------------

#define PART        0.03 // of the likelihood's logarithm, at least
#define POINTS_GROW 3.0  // standard errors grow by this: points follow each other closely
#define HALVINGS    16
#define EXTRA_S     2e-3
#define EXTRA_MAX_S 9e-3

typedef struct {
  set_t *s;
  const model_t *m;
  bool lag;       // else a delay
  double extra_s; // delay that a lag may have beside it: the way of a command through the vehicle
  bool failed;
} speeds_t;

// A rotor's thrust, by its measured speed and as commanded.
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

// The least of a curve with one valley.
static double least_in(speeds_t *s, double from, double to) {
  const double share = 0.381966;
  double a = from + share * (to - from), b = to - share * (to - from);
  double at_a = unlike_speeds(s, a), at_b = unlike_speeds(s, b);
  for (int i = 0; i < HALVINGS; i++)
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

static bool all_measured(const set_t *s) {
  for (int f = 0; f < s->n_grid; f++)
    if (!s->grid[f].measured_N[ROTORS - 1]) return false;
  return s->n_grid > 0;
}

static timing_t measured_as(speeds_t *s, int candidate, double value, double none, double now) {
  const double h = 0.1 * fabs(value);
  const double bend = (unlike_speeds(s, value + h) - 2.0 * now + unlike_speeds(s, value - h)) / (h * h);
  const double p = lsq_f_above((none - now) / (POINTS_GROW * POINTS_GROW), 1.0, fmax(s->s->n_block - 1, 2.0));
  return (timing_t){true, candidate, value, bend > 0.0 ? POINTS_GROW * sqrt(2.0 / bend) : fabs(value), p};
}

static done_t read_speeds(timing_t *found, const candidates_t *c, set_t *set, const model_t *m, why_t *why) {
  speeds_t s = {.s = set, .m = m};
  const double none = unlike_speeds(&s, 0.0);
  double least = none - fmax(BETTER, PART * fabs(none));
  found->measured = true;
  for (int i = 0; i < c->n; i++) {
    const fx_t *fx = c->candidate[i].use.fx;
    if (fx->group != FX_TIMING) continue;
    s.lag = fx->lags;
    s.extra_s = 0.0;
    double value = least_in(&s, s.lag ? -0.9 * m->motor_tau_s : 0.0, s.lag ? 0.25 : 0.06);
    double now = unlike_speeds(&s, value);
    for (double extra_s = EXTRA_S; s.lag && extra_s < EXTRA_MAX_S; extra_s += EXTRA_S) {
      s.extra_s = extra_s;
      const double other = least_in(&s, -0.9 * m->motor_tau_s, 0.25), there = unlike_speeds(&s, other);
      if (there < now) {
        now = there;
        value = other;
      }
    }
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
  if (all_measured(s)) return read_speeds(found, c, s, m, why);
  lines_t measured, left = {.r = {NULL}};
  done_t status = lines_make(&measured, s, why);
  if (status == DONE) status = lines_make(&left, s, why);
  if (status == DONE) status = try_all(found, c, s, m, &measured, &left, why);
  lines_free(&measured);
  lines_free(&left);
  return status;
}
