// round.c - a round of the selection.
#include "gap/5_infer/round.h"

#include <math.h>
#include <stdlib.h>

void round_close(round_t *r) {
  score_free(&r->score);
  gram_free(&r->gram);
  design_free(&r->table);
}

// Returns the columns of the choice with their chosen numbers; 0 where a candidate has none yet.
static explained_t known_of(const round_t *r, int column[COLUMN_MAX], double b[COLUMN_MAX]) {
  int n = 0;
  for (int i = 0; i < r->choice.n; i++) {
    const fx_use_t *const use = chosen_use(&r->chosen, r->choice.of[i]);
    for (int k = 0; k < r->c->candidate[r->choice.of[i]].n; k++) b[n++] = use ? fx_use_size(use, k) : 0.0;
  }
  return (explained_t){choice_columns(r->c, &r->choice, column), column, b, false, NULL};
}

static done_t closed_on_error(round_t *r, done_t status) {
  if (status != DONE) round_close(r);
  return status;
}

static done_t make_products(round_t *r, why_t *why) {
  int column[COLUMN_MAX];
  double b[COLUMN_MAX];
  const explained_t known = known_of(r, column, b);
  r->rounds++;
  return gram_make(&r->gram, r->s, &r->table, &known, r->strict ? NULL : r->score.color_ridge, why);
}

done_t round_open(round_t *r, why_t *why) {
  done_t status = design_make(&r->table, r->s, r->base, r->c, &r->chosen, why);
  if (status == DONE) status = score_make(&r->score, r->c, &r->gram, r->nominal, why);
  if (status == DONE) status = make_products(r, why);
  return closed_on_error(r, status);
}

done_t round_complete(round_t *r, why_t *why) {
  gram_free(&r->gram);
  done_t status = design_renew(&r->table, r->s, r->base, r->c, &r->chosen, true, why);
  if (status == DONE) status = make_products(r, why);
  return closed_on_error(r, status);
}

done_t round_renew(round_t *r, why_t *why) {
  int column[COLUMN_MAX];
  double b[COLUMN_MAX];
  const explained_t known = known_of(r, column, b);
  bool *const some = calloc((size_t)r->c->columns + 1, sizeof(bool));
  for (int i = 0; some && i < known.n; i++) some[column[i]] = true;
  done_t status = some ? design_renew(&r->table, r->s, r->base, r->c, &r->chosen, false, why)
                       : error_failed(why, "out of memory");
  if (status == DONE) status = gram_renew(&r->gram, r->s, &r->table, r->strict ? &known : NULL, some, why);
  free(some);
  return closed_on_error(r, status);
}

double round_take(round_t *r, double share) {
  double b[COLUMN_MAX], most = 0.0;
  int n = 0;
  score_estimate(&r->score, &r->choice, b, NULL);
  for (int i = r->chosen.n - 1; i >= 0; i--)
    if (!choice_has(&r->choice, r->chosen.of[i])) chosen_drop(&r->chosen, r->chosen.of[i]);
  for (int i = 0; i < r->choice.n; i++) {
    const candidate_t *const c = &r->c->candidate[r->choice.of[i]];
    fx_use_t *const use = chosen_take(&r->chosen, r->c, r->choice.of[i]);
    for (int k = 0; k < c->n; k++) {
      const double value = fx_use_size(use, k), way = candidate_possible(c, k, b[n++]) - value;
      most = fmax(most, fabs(way) / c->typical[k]);
      fx_use_resize(use, k, candidate_possible(c, k, value + share * way)); // rounding may end an ulp beyond
    }
  }
  return most;
}

choice_t round_reshaped(const round_t *r, const choice_t *choice) {
  choice_t best = *choice;
  double least = score_left(&r->score, choice, NULL);
  for (int k = 0; k < choice->n; k++) {
    const candidate_t *const all = r->c->candidate;
    for (int i = 0; i < r->c->n; i++) {
      if (!candidates_exclude(&all[i], &all[choice->of[k]]) || i == choice->of[k]) continue;
      choice_t other = best;
      other.of[k] = i;
      const double left = score_left(&r->score, &other, NULL);
      if (!(left < least)) continue;
      least = left;
      best = other;
    }
  }
  return best;
}

const fx_t *round_fx(const round_t *r, int candidate) {
  return r->c->candidate[candidate].use.fx;
}

double round_left(const round_t *r, const choice_t *choice) {
  double left = score_left(&r->score, choice, NULL);
  for (int i = 0; i < choice->n; i++) left += 2.0 * log(candidates_of(r->c, choice->of[i]));
  return left;
}

bool round_tells_turning(const round_t *r) {
  const choice_t nothing = {.n = 0};
  bool told = false;
  if (!r->nominal || r->nominal->n == 0 || candidates_slow(r->s)) return false;
  for (int i = 0; i < r->c->n; i++) {
    const candidate_t *const c = &r->c->candidate[i];
    if (c->use.fx->scales != FX_SCALES_INERTIA) continue;
    const choice_t with = choice_with(&nothing, i);
    double rms[FX_SIZE_MAX];
    score_nominal_rms(&r->score, &with, rms);
    for (int k = 0; k < 2; k++) // about x and y: thrust makes no moment about z but through torque
      if (!gram_shows(&r->gram, c->first + k) || !(limits_nominal(r->nominal->n) * rms[k] < c->typical[k]))
        return false;
    told = true;
  }
  return told;
}

static bool excludes(const round_t *r, const fx_t *a, const fx_t *b) {
  return a->group != FX_ALONE && a->group == b->group && !(a->group == FX_WEIGHT && r->turning_told);
}

bool round_fits(const round_t *r, const choice_t *choice, int candidate) {
  const fx_t *fx = round_fx(r, candidate);
  for (int i = 0; i < choice->n; i++) {
    const candidate_t *const all = r->c->candidate;
    if (candidates_exclude(&all[candidate], &all[choice->of[i]])) return false;
    if (excludes(r, fx, round_fx(r, choice->of[i]))) return false;
  }
  return choice->n < NAMED_MAX;
}

// Effects that exclude each other within their group do not count: of lag and delay, or of mass and thrust
// scale, either is right.
bool round_may_stand_for(const round_t *r, const choice_t *rest, int own, int other) {
  const fx_t *const a = round_fx(r, own), *const b = round_fx(r, other);
  return a != b && !excludes(r, a, b) && !r->never[other] && round_fits(r, rest, other);
}
