// open.c - names that these flights cannot tell from others.
#include "gap/5_infer/state.h"

// Another class: of lag and delay, or of mass and thrust scale, either is right.
bool select_may_stand_for(const select_t *t, const choice_t *rest, int own, int other) {
  const fx_t *const a = select_fx(t, own), *const b = select_fx(t, other);
  return a != b && (a->class == FX_ALONE || a->class != b->class) && !t->never[other] &&
         select_fits(t, rest, other);
}

static named_t open_one(const select_t *t, int candidate) {
  const choice_t rest = choice_without(&t->choice, candidate);
  named_t open = {.candidate = candidate};
  for (int i = 0; i < t->c->n && open.n_rival < RIVAL_MAX; i++) {
    if (!select_may_stand_for(t, &rest, candidate, i)) continue;
    if (open.n_rival && open.rival[open.n_rival - 1] == select_fx(t, i)) continue;
    const choice_t with = choice_with(&rest, i);
    if (!judge_is_rival(&t->judge, &t->choice, &with) || !judge_is_possible(&t->judge, &with)) continue;
    if (judge_likeness(&t->judge, &t->choice, candidate, i) < SELECT_SAME) continue;
    open.rival[open.n_rival++] = select_fx(t, i);
  }
  return open;
}

bool select_drop_open(select_t *t, found_t *found) {
  for (int i = t->choice.n - 1; i >= 0 && found->n_open < NAMED_MAX; i--) {
    const int candidate = t->choice.of[i];
    const named_t open = open_one(t, candidate);
    if (open.n_rival == 0) continue;
    found->open[found->n_open++] = open;
    t->choice = choice_without(&t->choice, candidate);
    return true;
  }
  return false;
}

bool found_is_open(const found_t *f, const candidates_t *c, const fx_t *fx) {
  for (int i = 0; i < f->n_open; i++) {
    if (c->candidate[f->open[i].candidate].use.fx == fx) return true;
    for (int k = 0; k < f->open[i].n_rival; k++)
      if (f->open[i].rival[k] == fx) return true;
  }
  return false;
}
