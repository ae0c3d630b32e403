// select.c - forward selection of effects.
#include "gap/5_infer/select.h"

#include "gap/5_infer/bend.h"
#include "gap/5_infer/beyond_control.h"
#include "gap/5_infer/family.h"
#include "gap/5_infer/evidence.h"
#include "gap/5_infer/local.h"
#include "gap/5_infer/pairs.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct selection {
  round_t round;
  const timing_t *timing;
  candidate_t *candidates; // the round's; a first look changes their shapes
  bool *room;
  double *left;  // by candidate: room
  bool *been;    // by candidate: it may not come in again: it was in, or is too unlikely
  bool *never;   // by candidate: it is ruled out
  bool *echo;    // by candidate: something like it is there, at one place or time only
  bool *broken;  // by candidate: in another's place it did not keep what it promised (try_swap)
  bool *alike;   // by candidate: room
  model_t timed; // the model with the timing that measured rotor speeds show
} select_t;

// Returns what the choice leaves with the candidate as its last one; HUGE_VAL: it is not allowed there.
static double try_with(const select_t *t, const choice_t *rest, int candidate) {
  const score_t *const score = &t->round.score;
  if (t->never[candidate] || t->been[candidate] || !round_fits(&t->round, rest, candidate)) return HUGE_VAL;
  const choice_t with = choice_with(rest, candidate);
  const verdict_t v = score_last(score, &with);
  if (!beyond_control(&t->round, &with, &v, false) || !score_allows(score, &with, &v) ||
      !score_is_sure(score, rest, &with) || score_harms(score, rest, &with))
    return HUGE_VAL;
  return round_left(&t->round, &with);
}

// Returns try_with() of every candidate that is not in the choice, by candidate; else HUGE_VAL.
static const double *try_each(const select_t *t, const choice_t *rest) {
#pragma omp parallel for schedule(dynamic, 4)
  for (int i = 0; i < t->round.c->n; i++) t->left[i] = choice_has(rest, i) ? HUGE_VAL : try_with(t, rest, i);
  return t->left;
}

static bool add_best(select_t *t) {
  choice_t *const choice = &t->round.choice;
  double best = round_left(&t->round, choice) * (1.0 - SELECT_GAIN);
  const double *const left = try_each(t, choice);
  int which = -1;
  for (int i = 0; i < t->round.c->n; i++) {
    if (!(left[i] < best)) continue;
    best = left[i];
    which = i;
  }
  if (which < 0) return false;
  *choice = choice_with(choice, which);
  t->been[which] = true;
  return true;
}

static bool pair_passes(const select_t *t, const hiding_t *pair) {
  const choice_t first = choice_with(&t->round.choice, pair->of[0]);
  const choice_t second = choice_with(&t->round.choice, pair->of[1]);
  return pairs_sure(&t->round, pair) && try_with(t, &first, pair->of[1]) < HUGE_VAL &&
         try_with(t, &second, pair->of[0]) < HUGE_VAL;
}

// Adds two that hide each other, as first names of a first look only: later, what a wrong shape leaves
// (users' set 63145) or a name that was taken out for a reason (231008) looks like two.
static done_t add_pair(select_t *t, bool *added, why_t *why) {
  choice_t *const choice = &t->round.choice;
  pairs_t pairs;
  *added = false;
  bool first = !t->round.nominal;
  for (int i = 0; i < choice->n; i++) first = first && round_fx(&t->round, choice->of[i])->group == FX_TIMING;
  if (!first) return DONE;
  const done_t status = pairs_find(&pairs, &t->round, t->been, why);
  for (int i = 0; i < pairs.n && !*added; i++) {
    const int *const of = pairs.pair[i].of;
    *added = pair_passes(t, &pairs.pair[i]);
    for (int k = 0; k < 2 && *added; k++) *choice = choice_with(choice, of[k]), t->been[of[k]] = true;
  }
  pairs_free(&pairs);
  return status;
}

// Replaces one of the choice by another candidate, where that leaves less by more than 2. Returns the new
// one; -1: none.
static int swap_one(select_t *t) {
  choice_t *const choice = &t->round.choice;
  double best = round_left(&t->round, choice) - 2.0; // a number takes as much by chance (Akaike): swaps end
  choice_t better = {.n = -1};
  for (int i = 0; i < choice->n; i++) {
    const choice_t rest = choice_without(choice, choice->of[i]);
    const double *const left = try_each(t, &rest);
    for (int k = 0; k < t->round.c->n; k++) {
      if (choice_has(choice, k) || t->broken[k] || !(left[k] < best)) continue;
      best = left[k];
      better = choice_with(&rest, k);
    }
  }
  if (better.n < 1) return -1;
  *choice = better;
  return better.of[better.n - 1];
}

// Takes out a candidate that no longer passes beside the others. False: all pass.
static bool prune_one(select_t *t) {
  const score_t *const score = &t->round.score;
  choice_t *const choice = &t->round.choice;
  const double now = score_left(score, choice, NULL);
  for (int i = 0; i < choice->n; i++) {
    const choice_t rest = choice_without(choice, choice->of[i]);
    const choice_t last = choice_with(&rest, choice->of[i]);
    const verdict_t v = score_last(score, &last);
    const double without = score_left(score, &rest, NULL);
    if (beyond_control(&t->round, &last, &v, true) && score_allows(score, &last, &v) &&
        now < without * (1.0 - SELECT_GAIN) && score_is_sure(score, &rest, &last) &&
        !score_harms(score, &rest, &last))
      continue;
    *choice = rest;
    return true;
  }
  return false;
}

// Estimates the numbers by straight lines about the last values, again and again, until they stay. Steps are
// halved where the numbers only go to and fro, and the loop ends where that brings them no nearer. On the
// way only the columns of the choice are formed anew. Forming all at the end may change the colours a
// little: then the loop goes on, as long as that converges, too.
typedef enum { SETTLE_ALL, SETTLE_OWN } settle_t; // OWN: the other candidates' columns stay as they were

static done_t settle(select_t *t, settle_t which, why_t *why) {
  const double stays = 1e-3; // of what is typical
  const bool own = which == SETTLE_OWN;
  double last = HUGE_VAL, last_of_all = HUGE_VAL, share = 1.0;
  bool all = !own; // all columns were formed last, not the choice's alone
  for (;;) {
    const double change = round_take(&t->round, share);
    const bool nearer = change < 0.7 * (all ? last_of_all : last);
    if (change < stays && (all || own)) return DONE;
    if (!nearer && share < 1.0) return own ? DONE : round_complete(&t->round, why);
    if (!nearer) share = 0.5;
    if (all) last_of_all = change;
    last = all ? HUGE_VAL : change;
    all = !own && change < stays;
    if (all)
      TRY(round_complete(&t->round, why));
    else
      TRY(round_renew(&t->round, why));
  }
}

// Returns the shape between those that are tried that fits best beside the others. A chosen candidate may go
// all the way to a neighbour; any other goes halfway at most, because the other half is the neighbour's.
static double bent(const select_t *t, int candidate) {
  const round_t *const r = &t->round;
  const choice_t beside = choice_without(&r->choice, candidate);
  return bend_best(&r->score, &beside, candidate, choice_has(&r->choice, candidate) ? 1.0 : 0.5);
}

// True if the candidate gets another shape than before.
static bool take_shape(select_t *t, int candidate, double shape) {
  fx_use_t *const use = &t->candidates[candidate].use;
  if (!t->candidates[candidate].n_shape) return false;
  double *const p = &use->p[use->fx->shape_param], was = *p;
  *p = shape;
  if (choice_has(&t->round.choice, candidate))
    chosen_take(&t->round.chosen, t->round.c, candidate)->p[use->fx->shape_param] = shape;
  return shape != was;
}

// Gives the chosen their best shapes, in a first look only: nominal flights have the columns of the shapes
// with which they were flown.
static done_t bend_chosen(select_t *t, why_t *why) {
  bool other = false;
  for (int i = 0; !t->round.nominal && i < t->round.choice.n; i++) {
    const int candidate = t->round.choice.of[i];
    if (t->candidates[candidate].n_shape) other = take_shape(t, candidate, bent(t, candidate)) || other;
  }
  if (!other) return DONE;
  TRY(round_complete(&t->round, why));
  return settle(t, SETTLE_ALL, why);
}

// Gives every candidate its best shape, because the misfit of the shapes that are tried is no effect. All
// shapes are found before any is changed: each is found by the columns of its neighbours.
static done_t bend_all(select_t *t, why_t *why) {
  const int n = t->round.nominal ? 0 : t->round.c->n;
  double *const shape = calloc((size_t)n + 1, sizeof *shape);
  bool other = false;
  if (!shape) return error_failed(why, "out of memory");
  for (int i = 0; i < n; i++)
    if (t->candidates[i].n_shape) shape[i] = bent(t, i);
  for (int i = 0; i < n; i++) other = take_shape(t, i, shape[i]) || other;
  free(shape);
  if (!other) return DONE;
  round_close(&t->round);
  return round_open(&t->round, why);
}

static done_t drop_echo(select_t *t, bool *dropped, why_t *why) {
  *dropped = false;
  for (int i = 0; t->round.strict && i < t->round.choice.n && !*dropped; i++) {
    const int candidate = t->round.choice.of[i];
    TRY(local_is_confined(&t->round, candidate, dropped, why));
    if (!*dropped) continue;
    TRY(local_alike(&t->round, candidate, t->alike, why));
    for (int k = 0; k < t->round.c->n; k++)
      if (k == candidate || (t->alike[k] && !choice_has(&t->round.choice, k)))
        t->echo[k] = t->never[k] = true;
    t->round.choice = choice_without(&t->round.choice, candidate);
  }
  return DONE;
}

static done_t left_by(const select_t *t, const chosen_t *chosen, const color_t color[CHANNELS], double *left,
                      why_t *why) {
  model_t m;
  TRY(chosen_model(chosen, t->round.base, &m, why));
  return whiten_left(t->round.s, &m, color, left, why);
}

// Tries the best swap, and keeps it if the models before and after it, both replayed, confirm it. Straight
// lines about the candidate that goes out promise it, and may promise too much: a lag that is taken out
// along its line leaves what no vehicle does, and a delay may fit that better. A newcomer that is not
// confirmed is not tried again in any place, because the line that promised too much is its own. Most are
// not confirmed, so all other columns are formed only once one is kept.
static done_t try_swap(select_t *t, bool *swapped, why_t *why) {
  round_t *const r = &t->round;
  const choice_t choice = r->choice;
  const chosen_t chosen = r->chosen;
  color_t color[CHANNELS];
  double before, after;
  memcpy(color, r->gram.color, sizeof color);
  const int now = swap_one(t);
  *swapped = now >= 0;
  if (!*swapped) return DONE;
  TRY(left_by(t, &chosen, color, &before, why));
  TRY(settle(t, SETTLE_OWN, why));
  TRY(left_by(t, &r->chosen, color, &after, why));
  if (after < before) {
    t->been[now] = true;
    TRY(round_complete(r, why));
    return settle(t, SETTLE_ALL, why);
  }
  t->broken[now] = true;
  r->choice = choice;
  r->chosen = chosen;
  return round_complete(r, why);
}

// This ends, because each candidate comes in once, and one with which the look began at most once more.
static done_t step_until_still(select_t *t, why_t *why) {
  for (;;) {
    bool swapped = false, changed = prune_one(t);
    if (!changed) TRY(try_swap(t, &swapped, why));
    changed = changed || swapped || add_best(t);
    if (!changed) TRY(add_pair(t, &changed, why));
    if (!changed) TRY(drop_echo(t, &changed, why));
    if (!changed) return DONE;
    if (!swapped) TRY(settle(t, SETTLE_ALL, why)); // a swap that is kept has settled
    TRY(bend_chosen(t, why));
  }
}

// Takes out the name with the least evidence beside all others, if it is more likely absent than present.
static done_t drop_doubtful(select_t *t, bool *dropped, why_t *why) {
  round_t *const r = &t->round;
  double odds[NAMED_MAX], least = 0.0;
  int worst = -1;
  *dropped = false;
  if (!r->nominal || r->choice.n == 0) return DONE;
  TRY(evidence_odds(r, odds, why));
  for (int i = 0; i < r->choice.n; i++)
    if (odds[i] < least) least = odds[i], worst = r->choice.of[i];
  if (worst < 0) return DONE;
  for (int k = 0; k < r->c->n; k++)
    if (candidates_exclude(&r->c->candidate[k], &r->c->candidate[worst])) t->been[k] = true;
  r->choice = choice_without(&r->choice, worst);
  *dropped = true;
  return settle(t, SETTLE_ALL, why);
}

// Searches in the colours of what all candidates together would leave, which show slow effects.
static done_t search_first(select_t *t, why_t *why) {
  TRY(bend_all(t, why));
  TRY(step_until_still(t, why));
  t->round.strict = true;
  memset(t->been, 0, (size_t)t->round.c->n * sizeof *t->been);
  memset(t->echo, 0, (size_t)t->round.c->n * sizeof *t->echo);
  memset(t->broken, 0, (size_t)t->round.c->n * sizeof *t->broken);
  return round_complete(&t->round, why);
}

// Searches in the colours of what the names really leave, in which a vehicle's slow disturbance is noise.
static done_t search(select_t *t, why_t *why) {
  for (bool dropped = true; dropped;) {
    TRY(step_until_still(t, why));
    TRY(drop_doubtful(t, &dropped, why));
  }
  return DONE;
}

// Takes in the lag or delay that is there for sure, if any, and rules out the other one.
static done_t take_timing(select_t *t, const timing_t *timing, why_t *why) {
  round_t *const r = &t->round;
  const int candidate = timing->candidate;
  for (int i = 0; i < r->c->n; i++)
    if (round_fx(r, i)->group == FX_TIMING)
      t->never[i] = t->never[i] || timing->measured || (candidate >= 0 && i != candidate);
  if (candidate < 0) return DONE;
  if (!timing->measured) {
    r->choice = choice_with(&r->choice, candidate);
    fx_use_resize(chosen_take(&r->chosen, r->c, candidate), 0, timing->value_s);
    return DONE;
  }
  fx_use_t use = r->c->candidate[candidate].use;
  fx_use_resize(&use, 0, timing->value_s);
  t->timed = *r->given;
  r->base = &t->timed;
  return model_add_fx(&t->timed, &use, why);
}

// Begins with all that the look before found, beside the timing. Whether mass and thrust scale may both stay
// is known once the columns are (leave_out_excluded). False: the look begins with nothing, in the colours of
// a first look.
static bool begin_with(select_t *t, const chosen_t *before) {
  round_t *const r = &t->round;
  for (int i = 0; before && i < before->n; i++)
    if (r->c->candidate[before->of[i]].barred) return false;
  for (int i = 0; before && i < before->n; i++) {
    const int candidate = before->of[i];
    if (t->never[candidate] || choice_has(&r->choice, candidate)) continue;
    r->choice = choice_with(&r->choice, candidate);
    fx_use_t *const use = chosen_take(&r->chosen, r->c, candidate); // in the candidate's present shape
    for (int k = 0; k < r->c->candidate[candidate].n; k++)
      fx_use_resize(use, k, fx_use_size(&before->use[i], k));
  }
  return before != NULL;
}

static void leave_out_excluded(round_t *r) {
  choice_t fits = {.n = 0};
  for (int i = 0; i < r->choice.n; i++)
    if (round_fits(r, &fits, r->choice.of[i])) fits = choice_with(&fits, r->choice.of[i]);
  r->choice = fits;
}

static done_t find_choice(select_t *t, const chosen_t *before, found_t *found, why_t *why) {
  round_t *const r = &t->round;
  TRY(take_timing(t, t->timing, why));
  r->strict = begin_with(t, before);
  TRY(round_open(r, why));
  r->turning_told = round_tells_turning(r);
  leave_out_excluded(r);
  if (r->strict)
    TRY(settle(t, SETTLE_ALL, why));
  else
    TRY(search_first(t, why));
  TRY(search(t, why));
  memcpy(found->echo, t->echo, (size_t)r->c->n * sizeof *t->echo);
  return found_describe(found, r, t->timing, why);
}

done_t select_effects(selection_t **selection, const select_job_t *job, found_t *found, why_t *why) {
  candidates_t *const c = job->candidates;
  const size_t n = (size_t)c->n + 1;
  select_t *const t = *selection = calloc(1, sizeof *t);
  TRY(found_make(found, c, why));
  bool *const room = t ? t->room = calloc(5 * n, sizeof *room) : NULL;
  if (t) t->left = calloc(n, sizeof *t->left);
  if (!room || !t->left) return error_failed(why, "out of memory");
  t->never = room, t->echo = room + n, t->alike = room + 2 * n, t->broken = room + 3 * n,
  t->been = room + 4 * n;
  t->timing = job->timing;
  t->candidates = c->candidate;
  t->round = (round_t){.c = c,
                       .s = job->set,
                       .given = job->model,
                       .base = job->model,
                       .nominal = job->nominal,
                       .never = t->never};
  for (int i = 0; i < c->n; i++) t->never[i] = c->candidate[i].barred;
  return find_choice(t, job->before, found, why);
}

done_t select_rivals(const selection_t *t, found_t *found, why_t *why) {
  return family_find(&t->round, t->timing->measured, found, why);
}

void select_close(selection_t *t) {
  if (!t) return;
  round_close(&t->round);
  free(t->room);
  free(t->left);
  free(t);
}
