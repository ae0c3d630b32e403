// select.c - forward selection of effects.
#include "gap/5_infer/select.h"

#include "gap/5_infer/state.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define ROUNDS 16
#define SETTLE 6

const fx_t *select_fx(const select_t *t, int candidate) {
  return t->c->candidate[candidate].use.fx;
}

bool select_fits(const select_t *t, const choice_t *choice, int candidate) {
  const fx_t *fx = select_fx(t, candidate);
  for (int i = 0; i < choice->n; i++) {
    const fx_t *other = select_fx(t, choice->of[i]);
    if (other == fx || (fx->class != FX_ALONE && other->class == fx->class)) return false;
  }
  return choice->n < NAMED_MAX;
}

// --- estimates --------------------------------------------------------------------------------------------

static void close_round(select_t *t) {
  judge_free(&t->judge);
  gram_free(&t->gram);
  table_free(&t->table);
}

// Columns, colours and products about the present values.
static done_t open_round(select_t *t, why_t *why) {
  const candidates_t *c = t->c;
  int column[COLUMN_MAX], n = 0;
  double b[COLUMN_MAX];
  for (int i = 0; i < t->choice.n; i++)
    for (int k = 0; k < c->candidate[t->choice.of[i]].n; k++)
      b[n++] = *candidate_value(&c->candidate[t->choice.of[i]], k);
  const explained_t known = {choice_columns(c, &t->choice, column), column, b, false};
  t->rounds++;
  TRY(table_make(&t->table, t->s, t->base, c, why));
  done_t status = judge_make(&t->judge, c, &t->gram, t->nominal, why);
  if (status == DONE)
    status = gram_make(&t->gram, t->s, &t->table, &known, t->strict ? NULL : t->judge.color_ridge, why);
  if (status != DONE) close_round(t);
  return status;
}

static double within(const candidate_t *c, int k, double value) {
  int n;
  const fx_size_t *size = &c->use.fx->size[k];
  const fx_param_t *param = &fx_use_params(&c->use, &n)[size->param];
  return fmin(fmax(value, c->least[k]), param->max);
}

// Names what is chosen, and brings its values by this share of the way to what is estimated now. Returns the
// largest way, in parts of what is typical.
static double take_values(select_t *t, double share) {
  double b[COLUMN_MAX], most = 0.0;
  int n = 0;
  judge_estimate(&t->judge, &t->choice, b, NULL);
  for (int i = 0; i < t->c->n; i++) {
    candidate_t *c = &t->c->candidate[i];
    c->named = choice_has(&t->choice, i);
    for (int k = 0; !c->named && k < c->n; k++) *candidate_value(c, k) = 0.0;
  }
  for (int i = 0; i < t->choice.n; i++) {
    candidate_t *c = &t->c->candidate[t->choice.of[i]];
    for (int k = 0; k < c->n; k++) {
      double *const value = candidate_value(c, k), way = within(c, k, b[n++]) - *value;
      most = fmax(most, fabs(way) / candidate_typical(c, k));
      *value += share * way;
    }
  }
  return most;
}

// --- steps ------------------------------------------------------------------------------------------------

// The choice with the candidate as its last one, if it is allowed there; its score, else HUGE_VAL.
static double try_with(const select_t *t, const choice_t *rest, int candidate) {
  if (t->never[candidate] || t->taken[candidate] >= TAKES || !select_fits(t, rest, candidate))
    return HUGE_VAL;
  const choice_t with = choice_with(rest, candidate);
  const verdict_t v = judge_last(&t->judge, &with);
  if (!judge_allows(&t->judge, &with, &v) || !judge_is_sure(&t->judge, rest, &with) ||
      judge_harms(&t->judge, rest, &with))
    return HUGE_VAL;
  return judge_left(&t->judge, &with, NULL);
}

static bool add_best(select_t *t) {
  const double now = judge_left(&t->judge, &t->choice, NULL);
  double best = now * (1.0 - SELECT_GAIN);
  int which = -1;
  for (int i = 0; i < t->c->n; i++) {
    const double left = try_with(t, &t->choice, i);
    if (!(left < best)) continue;
    best = left;
    which = i;
  }
  if (which < 0) return false;
  t->choice = choice_with(&t->choice, which);
  t->taken[which]++;
  return true;
}

// One for another, where that explains more.
static bool swap_one(select_t *t) {
  double best = judge_left(&t->judge, &t->choice, NULL) - 2.0;
  choice_t better = {.n = -1};
  for (int i = 0; i < t->choice.n; i++) {
    const choice_t rest = choice_without(&t->choice, t->choice.of[i]);
    for (int k = 0; k < t->c->n; k++) {
      if (choice_has(&t->choice, k)) continue;
      const double left = try_with(t, &rest, k);
      if (!(left < best)) continue;
      best = left;
      better = choice_with(&rest, k);
    }
  }
  if (better.n < 1) return false;
  t->choice = better;
  t->taken[better.of[better.n - 1]]++;
  return true;
}

// Takes out what no longer passes beside the others.
static bool prune_one(select_t *t) {
  const double now = judge_left(&t->judge, &t->choice, NULL);
  for (int i = 0; i < t->choice.n; i++) {
    const choice_t rest = choice_without(&t->choice, t->choice.of[i]);
    const choice_t last = choice_with(&rest, t->choice.of[i]);
    const verdict_t v = judge_last(&t->judge, &last);
    const double without = judge_left(&t->judge, &rest, NULL);
    if (judge_allows(&t->judge, &last, &v) && now < without * (1.0 - SELECT_GAIN) &&
        judge_is_sure(&t->judge, &rest, &last) && !judge_harms(&t->judge, &rest, &last))
      continue;
    t->choice = rest;
    return true;
  }
  return false;
}

// Straight lines about the last values, until these stay; by half where they only go to and fro.
static done_t settle(select_t *t, why_t *why) {
  double last = HUGE_VAL, share = 1.0;
  for (int i = 0; i < SETTLE; i++) {
    const double change = take_values(t, share);
    if (change < 1e-3) break;
    if (change > 0.7 * last) share = 0.5;
    last = change;
    close_round(t);
    TRY(open_round(t, why));
  }
  return DONE;
}

static done_t drop_echo(select_t *t, bool *dropped, why_t *why) {
  *dropped = false;
  for (int i = 0; i < t->choice.n && !*dropped; i++) {
    const int candidate = t->choice.of[i];
    TRY(select_is_echo(t, candidate, dropped, why));
    if (!*dropped && t->strict) TRY(select_is_confined(t, candidate, dropped, why));
    if (!*dropped) continue;
    t->taken[candidate] = TAKES;
    TRY(select_forbid_alike(t, candidate, why));
    t->choice = choice_without(&t->choice, candidate);
  }
  return DONE;
}

static done_t look(select_t *t, why_t *why) {
  for (int round = 0; round < ROUNDS; round++) {
    bool changed = prune_one(t) || swap_one(t) || add_best(t);
    if (!changed) TRY(drop_echo(t, &changed, why));
    if (!changed) return DONE;
    TRY(settle(t, why));
  }
  return DONE;
}

// First in the colours that would be left if everything that can be named were there: they show what is slow.
// Then in those of what the named effects really leave: what a vehicle has of slow disturbance is noise
// there.
static done_t search(select_t *t, why_t *why) {
  TRY(look(t, why));
  t->strict = true;
  memset(t->taken, 0, (size_t)t->c->n * sizeof(int));
  close_round(t);
  TRY(open_round(t, why));
  return look(t, why);
}

// What is left in the choice can be named.
static done_t set_open_apart(select_t *t, found_t *found, why_t *why) {
  while (select_drop_open(t, found)) TRY(settle(t, why));
  return DONE;
}

static done_t take_timing(select_t *t, why_t *why) {
  if (t->timing < 0) return DONE;
  fx_use_t use = t->c->candidate[t->timing].use;
  use.p[use.fx->size[0].param] = t->timing_s;
  t->own_base = *t->base;
  t->base = &t->own_base;
  return model_add_fx(&t->own_base, &use, why);
}

done_t select_effects(candidates_t *c, set_t *s, const model_t *base, const nominal_t *nominal,
                      found_t *found, why_t *why) {
  select_t t = {.c = c, .s = s, .given = base, .base = base, .nominal = nominal, .timing = -1};
  *found = (found_t){.least = calloc((size_t)c->n + 1, sizeof(double)),
                     .echo = calloc((size_t)c->n + 1, sizeof(bool))};
  t.taken = calloc((size_t)c->n + 1, sizeof(int));
  t.never = calloc((size_t)c->n + 1, sizeof(bool));
  done_t status =
      found->least && found->echo && t.taken && t.never ? DONE : error_failed(why, "out of memory");
  if (status == DONE) status = select_timing(&t, why);
  if (status == DONE) status = take_timing(&t, why);
  if (status == DONE) status = open_round(&t, why);
  if (status == DONE) status = search(&t, why);
  if (status == DONE) status = set_open_apart(&t, found, why);
  if (status == DONE) {
    select_describe(&t, found);
    found->rounds = t.rounds;
    close_round(&t);
  }
  free(t.taken);
  free(t.never);
  return status;
}

void found_free(found_t *f) {
  free(f->least);
  free(f->echo);
  f->least = NULL;
  f->echo = NULL;
}
