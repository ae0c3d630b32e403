// found.c - the result of the selection: names, and what could have been seen.
#include "gap/5_infer/found.h"

#include "base/lsq_blocks.h"
#include "gap/5_infer/bend.h"
#include "gap/5_infer/evidence.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

done_t found_make(found_t *f, const candidates_t *c, why_t *why) {
  *f = (found_t){.least = calloc((size_t)c->n + 1, sizeof(double)),
                 .alike = calloc((size_t)c->columns + 1, sizeof(int)),
                 .echo = calloc((size_t)c->n + 1, sizeof(bool))};
  return f->least && f->alike && f->echo ? DONE : error_failed(why, "out of memory");
}

void found_free(found_t *f) {
  free(f->least);
  free(f->alike);
  free(f->echo);
  f->least = NULL;
  f->alike = NULL;
  f->echo = NULL;
}

const fx_use_t *found_use(const found_t *f, const named_t *named) {
  return chosen_use(&f->chosen, named->candidate);
}

void found_withdraw(found_t *f, int i) {
  chosen_drop(&f->chosen, f->named[i].candidate);
  for (f->n--; i < f->n; i++) f->named[i] = f->named[i + 1];
}

void found_join_rivals(found_t *f) {
  for (int i = 0; i < f->n; i++)
    for (int k = 0; k < FX_SIZE_MAX; k++) {
      named_t *const named = &f->named[i];
      if (named->stderr_[k] > 0.0) named->stderr_[k] = hypot(named->stderr_[k], named->by_rivals[k]);
    }
}

// --- names ------------------------------------------------------------------------------------------------

// Adds to a name's errors what feedback alone makes of its numbers, and for a lag or delay as much lateness
// of the instruments as is never named.
static void add_errors(const round_t *r, const choice_t *last, named_t *named) {
  double rms[FX_SIZE_MAX];
  bend_t bend;
  const fx_t *const fx = round_fx(r, named->candidate);
  score_nominal_error(&r->score, last, rms);
  if (bend_nominal(&r->score, last, named->value, &bend)) memcpy(rms, bend.size, sizeof rms);
  named->shape_beside = bend.shape;
  for (int k = 0; k < fx->n_size; k++) {
    if (!(named->stderr_[k] > 0.0)) continue; // not shown
    named->beside[k] = hypot(rms[k], candidates_least(fx, r->s) / SCORE_ERRORS);
    named->stderr_[k] = hypot(named->stderr_[k], named->beside[k]);
  }
}

static void find_named(found_t *found, const round_t *r) {
  const choice_t none = {.n = 0};
  found->left_before = score_left(&r->score, &none, NULL);
  found->left = score_left(&r->score, &r->choice, NULL);
  for (int i = 0; i < r->choice.n; i++) {
    const int candidate = r->choice.of[i];
    const choice_t rest = choice_without(&r->choice, candidate), last = choice_with(&rest, candidate);
    const verdict_t v = score_last(&r->score, &last);
    const fx_t *fx = round_fx(r, candidate);
    if (fabs(v.value[0]) < candidates_least(fx, r->s)) {
      if (fx->group != FX_TIMING) continue; // a sensor is late, not the commands
      found->aligned = fx;
      found->aligned_s = v.value[0];
      continue;
    }
    named_t *const named = &found->named[found->n++];
    *named = (named_t){.candidate = candidate, .p = v.p, .held_share = (double)NAN};
    memcpy(named->value, v.value, sizeof named->value);
    memcpy(named->stderr_, v.stderr_, sizeof named->stderr_);
    add_errors(r, &last, named);
    named->share = (score_left(&r->score, &rest, NULL) - found->left) / found->left_before;
  }
}

// Adds the lag or delay that measured rotor speeds gave. The other names' shares become shares of what was
// left without it.
static void find_timing(found_t *found, const round_t *r, const timing_t *timing) {
  why_t why;
  double without = 1.0, with = 1.0;
  if (whiten_left(r->s, r->given, r->gram.color, &without, &why) != DONE ||
      whiten_left(r->s, r->base, r->gram.color, &with, &why) != DONE)
    without = with = 1.0;
  for (int i = 0; i < found->n; i++) found->named[i].share *= with / without;
  found->left_before *= without / with;
  named_t *const named = &found->named[found->n++];
  *named = (named_t){.candidate = timing->candidate,
                     .p = timing->p,
                     .share = 1.0 - with / without,
                     .held_share = (double)NAN};
  named->value[0] = timing->value_s;
  named->stderr_[0] = timing->stderr_s;
  fx_use_resize(chosen_take(&found->chosen, r->c, timing->candidate), 0, timing->value_s);
}

// Order of names: effects on the vehicle before errors of its instruments, then by falling share.
static bool comes_before(const round_t *r, const named_t *a, const named_t *b) {
  const bool sensed_a = round_fx(r, a->candidate)->sense, sensed_b = round_fx(r, b->candidate)->sense;
  return sensed_a != sensed_b ? sensed_b : a->share > b->share;
}

static void sort_names(found_t *found, const round_t *r) {
  for (int i = 1; i < found->n; i++)
    for (int k = i; k > 0 && comes_before(r, &found->named[k], &found->named[k - 1]); k--) {
      const named_t swap = found->named[k];
      found->named[k] = found->named[k - 1];
      found->named[k - 1] = swap;
    }
}

// --- the smallest size of every effect that these flights would have shown --------------------------------
//
// Each condition of select.h asks for a size. All but a few flights in a hundred meet it if the true size is
// larger by two errors of the estimate: its standard error, or its rms on nominal flights. Where an effect
// multiplies what is mostly noise of the log (velocities in a hover), only a part of it is found.

// Returns the sum of squares that number k must explain so that no other name stands for it: the part that
// the other one cannot give must reach SCORE_RIVAL_LEFT. 0: every other one leaves more of it than a right
// form would; HUGE_VAL: another one gives all of it.
static double gain_of_rivals(const round_t *r, int candidate, int k) {
  double alike = 0.0;
  for (int i = 0; i < r->c->n; i++)
    if (round_may_stand_for(r, &r->choice, candidate, i))
      alike = fmax(alike, score_alike(&r->score, r->c->candidate[candidate].first + k, i));
  const double apart = 1.0 - alike;
  return apart > CANDIDATES_MISFIT * CANDIDATES_MISFIT ? 0.0
         : apart > 0.0                                 ? SCORE_RIVAL_LEFT / apart
                                                       : HUGE_VAL;
}

// Returns the smallest size that would have been seen, over typical; 0: no compared channel depends on it.
// speaks: by column, the size from which on the rows speak for it, over typical.
static double least_of(const round_t *r, const choice_t *with, double left, const double *speaks) {
  const int candidate = with->of[with->n - 1];
  const candidate_t *const c = &r->c->candidate[candidate];
  const verdict_t v = score_last(&r->score, with);
  int column[COLUMN_MAX];
  const double blocks = fmax(r->gram.n_block - choice_columns(r->c, with, column), 2.0);
  int shown = 0;
  for (int k = 0; k < c->n; k++) shown += v.stderr_[k] > 0.0;
  if (!shown) return 0.0;
  const double wald = sqrt(shown * lsq_f_quantile(SELECT_ALPHA / r->c->n, shown, blocks));
  const double nominal = limits_nominal(r->nominal ? r->nominal->n : 0) * sqrt(shown);
  double rms[FX_SIZE_MAX], gain[FX_SIZE_MAX], unit[FX_SIZE_MAX], least = 0.0;
  score_nominal_rms(&r->score, with, rms);
  score_least_gain(&r->score, with, SELECT_GAIN * left, gain);
  score_least_gain(&r->score, with, 1.0, unit);
  for (int k = 0; k < c->n && k < FX_SIZE_MAX; k++) {
    if (!(v.stderr_[k] > 0.0)) continue;
    const double typical = c->typical[k], error = fmax(v.stderr_[k], rms[k]);
    const double rival = unit[k] * sqrt(gain_of_rivals(r, candidate, k));
    double need = fmax(fmax(wald * v.stderr_[k], nominal * rms[k]), fmax(gain[k], rival));
    need = fmax(need, fmax(SELECT_LEAST * typical, c->use.fx->size[k].least));
    need = fmax(need, speaks[c->first + k] * typical);
    const double kept = r->nominal ? r->nominal->kept[c->first + k] : 1.0;
    least = kept > 0.0 ? fmax(least, (need + SCORE_ERRORS * error) / (kept * typical)) : HUGE_VAL;
  }
  return least;
}

static done_t find_least(found_t *found, const round_t *r, why_t *why) {
  double *const speaks = calloc((size_t)r->c->columns + 1, sizeof *speaks);
  if (!speaks) return error_failed(why, "out of memory");
  const done_t status = r->nominal ? evidence_least(r, speaks, why) : DONE; // a first look does not ask
  for (int i = 0; i < r->c->n && status == DONE; i++) {
    const choice_t rest = choice_without(&r->choice, i);
    if (!round_fits(r, &rest, i)) continue;
    const choice_t with = choice_with(&rest, i);
    found->least[i] = least_of(r, &with, found->left, speaks);
    if (!(found->least[i] > 0.0) || choice_has(&r->choice, i)) continue;
    if (found->echo[i]) found->least[i] = HUGE_VAL;
  }
  free(speaks);
  return status;
}

// How far a shape is from the one asked for, in the logarithm: a name's own shape comes first (-1), else the
// typical one counts. Any rotor may be (0).
static double away(const found_t *f, const candidates_t *all, int candidate) {
  const candidate_t *const c = &all->candidate[candidate];
  int n;
  const fx_param_t *const shape = &fx_use_params(&c->use, &n)[c->use.fx->shape_param];
  if (chosen_use(&f->chosen, candidate)) return -1.0;
  return !fx_use_has_shape(&c->use) || fx_is_number(shape)
             ? 0.0
             : fabs(log(c->use.p[c->use.fx->shape_param] / shape->nominal));
}

double found_least(const found_t *f, const candidates_t *c, const fx_t *fx, const candidate_t **which) {
  int best = -1;
  for (int i = 0; i < c->n; i++) {
    if (c->candidate[i].use.fx != fx) continue;
    const double farther = best < 0 ? -1.0 : away(f, c, i) - away(f, c, best);
    if (farther < 0.0 || (farther <= 0.0 && f->least[i] >= f->least[best])) best = i;
  }
  const bool shows = best >= 0 && f->least[best] > 0.0;
  if (which) *which = shows ? &c->candidate[best] : NULL;
  return shows ? f->least[best] : HUGE_VAL;
}

// --- the whole --------------------------------------------------------------------------------------------

done_t found_describe(found_t *f, const round_t *r, const timing_t *timing, why_t *why) {
  f->chosen = r->chosen;
  f->rounds = r->rounds;
  find_named(f, r);
  if (timing->measured && timing->candidate >= 0 && f->n < NAMED_MAX) find_timing(f, r, timing);
  sort_names(f, r);
  return find_least(f, r, why);
}
