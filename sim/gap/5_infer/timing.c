// timing.c - lags and delays that are too long for a straight line, by trying them.
#include "gap/2_predict/increments.h"
#include "gap/5_infer/state.h"
#include <math.h>
#include <stdlib.h>

#define LONG_S 0.045 // shorter ones the straight line finds
#define BETTER 50.0  // twice the logarithm of the likelihood

static const double TRY_S[] = {0.005, 0.01, 0.015, 0.025, 0.035, 0.05, 0.065, 0.08, 0.1, 0.13, 0.16};
#define TRIES ((int)(sizeof TRY_S / sizeof *TRY_S))

typedef struct {
  double *r[CHANNELS], *measured[CHANNELS], *room;
} lines_t;

static done_t lines_make(lines_t *l, const set_t *s, why_t *why) {
  const size_t n = (size_t)(s->smooth.n > s->range.n ? s->smooth.n : s->range.n) + 1;
  l->room = calloc(2 * CHANNELS * n, sizeof(double));
  if (!l->room) return error_failed(why, "out of memory");
  for (size_t ch = 0; ch < CHANNELS; ch++) {
    l->r[ch] = l->room + ch * n;
    l->measured[ch] = l->room + (CHANNELS + ch) * n;
  }
  return residual_measured(s, l->measured, why);
}

// n log(1 - c^2), c: correlation from row to row of what was measured and what was predicted. A scale that is
// wrong does not change it, nor does what is slow.
static double unlike(const rows_t *r, const double *measured, const double *residual) {
  const increments_t s = increments_of(r, measured, residual);
  return s.yy > 0.0 && s.pp > 0.0 ? s.n * log(fmax(1.0 - s.yp * s.yp / s.yy / s.pp, 1e-9)) : 0.0;
}

static done_t judge(select_t *t, const model_t *m, lines_t *l, double *sum, why_t *why) {
  *sum = 0.0;
  TRY(residual_of(t->s, m, l->r, why));
  for (int ch = CH_FORCES - 1; ch < CH_SMOOTH; ch++) // thrust and moments
    if (residual_has(t->s, ch)) *sum += unlike(&t->s->smooth, l->measured[ch], l->r[ch]);
  return DONE;
}

static done_t scan(select_t *t, lines_t *l, int *which, double *value, why_t *why) {
  double none, best;
  TRY(judge(t, t->base, l, &none, why));
  best = none - BETTER;
  *which = -1;
  for (int i = 0; i < t->c->n; i++)
    for (int k = 0; select_fx(t, i)->class == FX_TIMING && k < TRIES; k++) {
      model_t m = *t->base;
      fx_use_t use = t->c->candidate[i].use;
      double now;
      use.p[use.fx->size[0].param] = TRY_S[k];
      TRY(model_add_fx(&m, &use, why));
      TRY(judge(t, &m, l, &now, why));
      if (!(now < best)) continue;
      best = now;
      *which = i;
      *value = TRY_S[k];
    }
  return DONE;
}

done_t select_timing(select_t *t, why_t *why) {
  bool known;
  TRY(select_speeds(t, &known, why));
  if (known) return DONE;
  lines_t l = {.room = NULL};
  int which = -1;
  double value = 0.0;
  done_t status = lines_make(&l, t->s, why);
  if (status == DONE) status = scan(t, &l, &which, &value, why);
  free(l.room);
  if (status != DONE || which < 0 || value <= LONG_S) return status;
  t->choice = choice_with(&t->choice, which);
  t->c->candidate[which].named = true;
  *candidate_value(&t->c->candidate[which], 0) = value;
  for (int i = 0; i < t->c->n; i++)
    if (i != which && select_fx(t, i)->class == FX_TIMING) t->never[i] = true;
  return DONE;
}
