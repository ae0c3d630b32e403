// describe.c - what a finished selection says: names, rivals, and what could have been seen.
#include "gap/5_infer/state.h"
#include <math.h>

// Mass and thrust scale differ in turning alone.
static bool only_turning_tells(const select_t *t, int a, int b) {
  return select_fx(t, a)->class == FX_WEIGHT && select_fx(t, b)->class == FX_WEIGHT && candidates_slow(t->s);
}

// Another name in its place that is not worse by two standard errors of the difference, at a size that it can
// have.
static void find_rivals(const select_t *t, int candidate, double left_before, named_t *named) {
  const choice_t rest = choice_without(&t->choice, candidate);
  const double without = judge_left(&t->judge, &rest, NULL);
  for (int i = 0; i < t->c->n && named->n_rival < RIVAL_MAX; i++) {
    const fx_t *fx = select_fx(t, i);
    if (fx == select_fx(t, candidate) || t->never[i] || !select_fits(t, &rest, i)) continue;
    if (named->n_rival && named->rival[named->n_rival - 1] == fx) continue;
    const choice_t with = choice_with(&rest, i);
    const bool rival = judge_is_rival(&t->judge, &t->choice, &with) && judge_is_possible(&t->judge, &with);
    if (!rival && !only_turning_tells(t, candidate, i)) continue;
    named->rival_share[named->n_rival] = (without - judge_left(&t->judge, &with, NULL)) / left_before;
    named->rival[named->n_rival++] = fx;
  }
}

// What feedback alone makes of a number is an error of it, too; and a lag or delay may hold as much lateness
// of the instruments themselves as is never named.
static void add_errors(const select_t *t, const choice_t *last, named_t *named) {
  double rms[FX_SIZE_MAX];
  const fx_t *const fx = select_fx(t, named->candidate);
  judge_nominal_rms(&t->judge, last, rms);
  for (int k = 0; k < fx->n_size; k++) {
    named->beside[k] = hypot(rms[k], candidates_least(fx, t->s) / SELECT_ERRORS);
    named->stderr_[k] = hypot(named->stderr_[k], named->beside[k]);
  }
}

static void find_named(const select_t *t, found_t *found) {
  const choice_t none = {.n = 0};
  found->left_before = judge_left(&t->judge, &none, NULL);
  found->left = judge_left(&t->judge, &t->choice, NULL);
  for (int i = 0; i < t->choice.n; i++) {
    const int candidate = t->choice.of[i];
    const choice_t rest = choice_without(&t->choice, candidate), last = choice_with(&rest, candidate);
    const verdict_t v = judge_last(&t->judge, &last);
    const fx_t *fx = select_fx(t, candidate);
    if (fx->class == FX_TIMING && fabs(v.value[0]) < candidates_least(fx, t->s)) {
      found->aligned_s = v.value[0];
      continue;
    }
    named_t *const named = &found->named[found->n++];
    *named = (named_t){.candidate = candidate, .p = v.p};
    memcpy(named->value, v.value, sizeof named->value);
    memcpy(named->stderr_, v.stderr_, sizeof named->stderr_);
    add_errors(t, &last, named);
    named->share = (judge_left(&t->judge, &rest, NULL) - found->left) / found->left_before;
    find_rivals(t, candidate, found->left_before, named);
  }
}

// The others' shares become shares of what was left without it.
static void find_timing(const select_t *t, found_t *found) {
  candidate_t *const c = &t->c->candidate[t->timing];
  why_t why;
  double without = 1.0, with = 1.0;
  if (whiten_left(t->s, t->given, t->gram.color, &without, &why) != DONE ||
      whiten_left(t->s, t->base, t->gram.color, &with, &why) != DONE)
    without = with = 1.0;
  for (int i = 0; i < found->n; i++) found->named[i].share *= with / without;
  found->left_before *= without / with;
  named_t *const named = &found->named[found->n++];
  *named = (named_t){.candidate = t->timing, .p = t->timing_p, .share = 1.0 - with / without};
  named->value[0] = t->timing_s;
  named->stderr_[0] = t->timing_stderr_s;
  c->named = true;
  *candidate_value(c, 0) = t->timing_s;
}

// What acts on the vehicle before what its instruments add; the largest share first.
static bool comes_before(const select_t *t, const named_t *a, const named_t *b) {
  const bool sensed_a = select_fx(t, a->candidate)->sense, sensed_b = select_fx(t, b->candidate)->sense;
  return sensed_a != sensed_b ? sensed_b : a->share > b->share;
}

static void sort(const select_t *t, found_t *found) {
  for (int i = 1; i < found->n; i++)
    for (int k = i; k > 0 && comes_before(t, &found->named[k], &found->named[k - 1]); k--) {
      const named_t swap = found->named[k];
      found->named[k] = found->named[k - 1];
      found->named[k - 1] = swap;
    }
}

void select_describe(const select_t *t, found_t *found) {
  find_named(t, found);
  if (t->timing >= 0 && found->n < NAMED_MAX) find_timing(t, found);
  sort(t, found);
  select_find_least(t, found);
}
