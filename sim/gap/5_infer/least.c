// least.c - the smallest size of every effect that these flights would have shown.
//
// Every condition of select.h asks for a size; it is met in all but a few flights in a hundred where the
// true size is larger by two of the estimate's errors: its standard error, or its rms on nominal flights.
// Where what an effect is multiplied by is mostly the log's own noise (velocities in a hover), only a part of
// it is found.
#include "base/lsq_blocks.h"
#include "gap/5_infer/state.h"
#include <math.h>

#define MISSED 2.0 // errors by which an estimate may be too small

// Another name stands for it so well that it stays open until it is larger: the part of its sum of squares
// that the other one cannot give must be JUDGE_RIVAL_LEFT.
static double gain_of_rivals(const select_t *t, int candidate, int k) {
  double alike = 0.0;
  for (int i = 0; i < t->c->n; i++)
    if (select_may_stand_for(t, &t->choice, candidate, i))
      alike = fmax(alike, judge_alike(&t->judge, t->c->candidate[candidate].first + k, i));
  return alike < SELECT_SAME ? 0.0 : alike < 1.0 ? JUDGE_RIVAL_LEFT / (1.0 - alike) : HUGE_VAL;
}

// In parts of what is typical.
static double least_of(const select_t *t, const choice_t *with, double left) {
  const int candidate = with->of[with->n - 1];
  const candidate_t *const c = &t->c->candidate[candidate];
  const verdict_t v = judge_last(&t->judge, with);
  int column[COLUMN_MAX];
  const double blocks = fmax(t->gram.n_block - choice_columns(t->c, with, column), 2.0);
  const double wald = sqrt(c->n * lsq_f_quantile(SELECT_ALPHA / t->c->n, c->n, blocks));
  const double nominal = SELECT_NOMINAL * sqrt(c->n);
  double rms[FX_SIZE_MAX], gain[FX_SIZE_MAX], unit[FX_SIZE_MAX], least = 0.0;
  if (!(v.stderr_[0] > 0.0)) return 0.0; // no residual depends on it
  judge_nominal_rms(&t->judge, with, rms);
  judge_least_gain(&t->judge, with, SELECT_GAIN * left, gain);
  judge_least_gain(&t->judge, with, 1.0, unit);
  for (int k = 0; k < c->n; k++) {
    const double typical = candidate_typical(c, k), error = fmax(v.stderr_[k], rms[k]);
    const double rival = unit[k] * sqrt(gain_of_rivals(t, candidate, k));
    double need = fmax(fmax(wald * v.stderr_[k], nominal * rms[k]), fmax(gain[k], rival));
    need = fmax(need, fmax(SELECT_LEAST * typical, c->use.fx->size[k].least));
    const double kept = t->nominal ? t->nominal->kept[c->first + k] : 1.0;
    least = fmax(least, (need + MISSED * error) / (kept * typical));
  }
  return least;
}

void select_find_least(const select_t *t, found_t *found) {
  for (int i = 0; i < t->c->n; i++) {
    const choice_t rest = choice_without(&t->choice, i);
    found->least[i] = 0.0;
    if (!select_fits(t, &rest, i)) continue;
    const choice_t with = choice_with(&rest, i);
    found->least[i] = least_of(t, &with, found->left);
    if (!(found->least[i] > 0.0) || choice_has(&t->choice, i)) continue;
    found->echo[i] = t->taken[i] >= TAKES;
    if (found->echo[i] || found_is_open(found, t->c, select_fx(t, i))) found->least[i] = HUGE_VAL;
  }
}

// How far from what is asked for: a name's own shape, else what is typical. A rotor may be any.
static double away(const candidate_t *c) {
  int n;
  const fx_param_t *const shape = &fx_use_params(&c->use, &n)[c->use.fx->shape_param];
  if (c->named) return -1.0;
  return !c->use.fx->n_shape || fx_is_number(shape)
             ? 0.0
             : fabs(log(c->use.p[c->use.fx->shape_param] / shape->nominal));
}

double found_least(const found_t *f, const candidates_t *c, const fx_t *fx, const candidate_t **which) {
  const candidate_t *best = NULL;
  double least = 0.0;
  for (int i = 0; i < c->n; i++) {
    const candidate_t *const one = &c->candidate[i];
    if (one->use.fx != fx || (best && away(one) > away(best))) continue;
    if (best && away(one) >= away(best) && f->least[i] < least) continue;
    best = one;
    least = f->least[i];
  }
  const bool shows = best && least > 0.0;
  if (which) *which = shows ? best : NULL;
  return shows ? least : HUGE_VAL;
}
