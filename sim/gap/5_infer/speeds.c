// speeds.c - lag or delay where rotor speeds were measured: they show it without a way round over the
// body.
#include "gap/5_infer/state.h"

#include "base/lsq_blocks.h"
#include <math.h>

#define BETTER      50.0 // twice the logarithm of the likelihood, at least
#define PART        0.03 // of it, at least
#define CLUSTER     3.0  // standard errors grow by this: points follow each other closely
#define STEPS       16
#define EXTRA_S     2e-3
#define EXTRA_MAX_S 9e-3

typedef struct {
  select_t *t;
  int candidate;  // below 0: none
  double extra_s; // delay that a lag may have beside it: the way of a command through the vehicle
  why_t *why;
  done_t status;
} speeds_t;

// n log(1 - c^2), c: correlation from point to point of a rotor's thrust, by its measured speed and as
// commanded.
static double unlike(const grid_t *g, int rotor, const lagged_t *motors) {
  double yy = 0.0, pp = 0.0, yp = 0.0;
  int n = 0;
  for (int j = 1; j < g->n; j++) {
    const double y = g->measured_N[rotor][j] - g->measured_N[rotor][j - 1];
    const double p = motors->thrust_N[rotor][j] - motors->thrust_N[rotor][j - 1];
    if (!g->point[j].ok || !g->point[j - 1].ok || !isfinite(y)) continue;
    yy += y * y;
    pp += p * p;
    yp += y * p;
    n++;
  }
  return yy > 0.0 && pp > 0.0 ? n * log(fmax(1.0 - yp * yp / yy / pp, 1e-9)) : 0.0;
}

static double judge(speeds_t *s, double value) {
  const model_t *m = s->t->base;
  const bool lag = s->candidate >= 0 && select_fx(s->t, s->candidate)->lags;
  const double tau_s = m->motor_tau_s + (lag ? value : 0.0),
               delay_s = m->frame.motor_delay_s + (lag ? s->extra_s : value);
  double sum = 0.0;
  for (int f = 0; f < s->t->s->n_grid; f++) {
    const lagged_t *motors = grid_motors(&s->t->s->grid[f], tau_s, delay_s);
    if (!motors) s->status = error_failed(s->why, "out of memory");
    for (int k = 0; motors && k < ROTORS; k++) sum += unlike(&s->t->s->grid[f], k, motors);
  }
  return sum;
}

// The least of a curve with one valley.
static double best_in(speeds_t *s, double from, double to) {
  const double share = 0.381966;
  double a = from + share * (to - from), b = to - share * (to - from), at_a = judge(s, a), at_b = judge(s, b);
  for (int i = 0; i < STEPS; i++)
    if (at_a < at_b) {
      to = b;
      b = a;
      at_b = at_a;
      at_a = judge(s, a = from + share * (to - from));
    } else {
      from = a;
      a = b;
      at_a = at_b;
      at_b = judge(s, b = to - share * (to - from));
    }
  return 0.5 * (from + to);
}

static bool all_measured(const set_t *s) {
  for (int f = 0; f < s->n_grid; f++)
    if (!s->grid[f].measured_N[ROTORS - 1]) return false;
  return s->n_grid > 0;
}

static void take(speeds_t *s, double value, double none, double now) {
  select_t *const t = s->t;
  const double h = 0.1 * fabs(value),
               bend = (judge(s, value + h) - 2.0 * now + judge(s, value - h)) / (h * h);
  t->timing = s->candidate;
  t->timing_s = value;
  t->timing_stderr_s = bend > 0.0 ? CLUSTER * sqrt(2.0 / bend) : fabs(value);
  t->timing_p = lsq_f_above((none - now) / (CLUSTER * CLUSTER), 1.0, fmax(t->s->n_block - 1, 2.0));
}

done_t select_speeds(select_t *t, bool *known, why_t *why) {
  speeds_t s = {.t = t, .candidate = -1, .why = why, .status = DONE};
  *known = all_measured(t->s);
  if (!*known) return DONE;
  const double none = judge(&s, 0.0);
  double least = none - fmax(BETTER, PART * fabs(none));
  for (int i = 0; i < t->c->n; i++) {
    const fx_t *fx = select_fx(t, i);
    if (fx->class != FX_TIMING) continue;
    t->never[i] = true;
    s.candidate = i;
    const bool lag = fx->lags;
    s.extra_s = 0.0;
    double value = best_in(&s, lag ? -0.9 * t->base->motor_tau_s : 0.0, lag ? 0.25 : 0.06);
    double now = judge(&s, value);
    for (double extra_s = EXTRA_S; lag && extra_s < EXTRA_MAX_S; extra_s += EXTRA_S) {
      s.extra_s = extra_s;
      const double other = best_in(&s, -0.9 * t->base->motor_tau_s, 0.25), there = judge(&s, other);
      if (there < now) {
        now = there;
        value = other;
      }
    }
    if (now < least) {
      take(&s, value, none, now);
      least = now;
    }
  }
  // A delay of 3 ms is not named; nor is the lag that would do instead.
  if (t->timing >= 0 && fabs(t->timing_s) < candidates_least(select_fx(t, t->timing), t->s)) t->timing = -1;
  return s.status;
}
