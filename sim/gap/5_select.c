// 5_select.c - forward selection of effects.
#include "gap/5_select.h"

#include "gap/score.h"
#include "gap/unknown.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define ROUNDS 16
#define ECHO   1.3 // so much more than a name a cell must explain
#define TAKES  2   // what was taken out as often as this does not come back

typedef struct {
  candidates_t *c;
  set_t *s;
  const model_t *base;
  const nominal_t *nominal;
  choice_t choice;
  table_t table;
  gram_t gram;
  judge_t judge;
  bool strict; // colours of what is named alone, not of all candidates
  int *taken;  // by candidate: how often it was taken in
} select_t;

static const fx_t *fx_of(const select_t *t, int candidate) {
  return t->c->candidate[candidate].use.fx;
}

// Not together: another shape of the same effect, or another one of its class.
static bool fits(const select_t *t, const choice_t *choice, int candidate) {
  const fx_t *fx = fx_of(t, candidate);
  for (int i = 0; i < choice->n; i++) {
    const fx_t *other = fx_of(t, choice->of[i]);
    if (other == fx || (fx->class != FX_ALONE && other->class == fx->class)) return false;
  }
  return choice->n < NAMED_MAX;
}

// --- estimates
// ----------------------------------------------------------------------------------------------

static void close_round(select_t *t) {
  judge_free(&t->judge);
  gram_free(&t->gram);
  table_free(&t->table);
}

// Columns, colours and products about the present values.
static status_t open_round(select_t *t, why_t *why) {
  const candidates_t *c = t->c;
  int column[COLUMN_MAX], n = 0;
  double b[COLUMN_MAX];
  for (int i = 0; i < t->choice.n; i++)
    for (int k = 0; k < c->candidate[t->choice.of[i]].n; k++)
      b[n++] = *candidate_value(&c->candidate[t->choice.of[i]], k);
  const explained_t known = {choice_columns(c, &t->choice, column), column, b, false};
  TRY(table_make(&t->table, t->s, t->base, c, why));
  status_t status = judge_make(&t->judge, c, &t->gram, t->nominal, why);
  if (status == ST_OK)
    status = gram_make(&t->gram, t->s, &t->table, &known, t->strict ? NULL : t->judge.color_ridge, why);
  if (status != ST_OK) close_round(t);
  return status;
}

static double within(const candidate_t *c, int k, double value) {
  int n;
  const fx_size_t *size = &c->use.fx->size[k];
  const fx_param_t *param = &fx_use_params(&c->use, &n)[size->param];
  return fmin(fmax(value, size->sign > 0 ? 0.0 : param->min), param->max);
}

// Names what is chosen, with its values. Returns the largest change, in parts of what is typical.
static double take_values(select_t *t) {
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
      const double value = within(c, k, b[n++]);
      most = fmax(most, fabs(value - *candidate_value(c, k)) / candidate_typical(c, k));
      *candidate_value(c, k) = value;
    }
  }
  return most;
}

// --- steps
// --------------------------------------------------------------------------------------------------

// The choice with the candidate as its last one, if it is allowed there; its score, else HUGE_VAL.
static double try_with(const select_t *t, const choice_t *rest, int candidate) {
  if (!fits(t, rest, candidate) || t->taken[candidate] >= TAKES) return HUGE_VAL;
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
  if (better.n < 0) return false;
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

static status_t settle(select_t *t, why_t *why) {
  for (int i = 0; i < 4; i++) {
    const double change = take_values(t);
    if (change < 1e-3) break;
    close_round(t);
    TRY(open_round(t, why));
  }
  return ST_OK;
}

// What a choice leaves, row by row, in the straight line's sense.
static status_t left_by(const select_t *t, const choice_t *choice, double *left[CHANNELS], why_t *why) {
  int column[COLUMN_MAX];
  double b[COLUMN_MAX];
  const int n = choice_columns(t->c, choice, column);
  judge_estimate(&t->judge, choice, b, NULL);
  for (int ch = 0; ch < CHANNELS; ch++) {
    const size_t rows = (size_t)set_rows(t->s, ch)->n;
    left[ch] = malloc((rows + 1) * sizeof(double));
    if (!left[ch]) return error_failed(why, "out of memory");
    memcpy(left[ch], t->table.x[ch][t->table.columns], rows * sizeof(double));
    for (int k = 0; k < n; k++) {
      const double *x = t->table.x[ch][column[k]];
      for (size_t i = 0; x && i < rows; i++) left[ch][i] -= b[k] * x[i];
    }
  }
  return ST_OK;
}

// Something at one place, time or state explains more than this name does: the name is an echo of it.
static status_t is_echo(const select_t *t, int candidate, bool *echo, why_t *why) {
  const choice_t rest = choice_without(&t->choice, candidate);
  double *left[CHANNELS] = {NULL};
  cell_t cell = {.statistic = 0.0};
  color_t color[CHANNELS]; // of the channels in which the name is seen
  for (int ch = 0; ch < CHANNELS; ch++) {
    color[ch] = t->gram.color[ch];
    color[ch].used = color[ch].used && t->table.x[ch][t->c->candidate[candidate].first];
  }
  status_t status = left_by(t, &rest, left, why);
  if (status == ST_OK) status = unknown_largest(t->s, t->base, left, color, false, &cell, why);
  for (int ch = 0; ch < CHANNELS; ch++) free(left[ch]);
  const double gain = judge_fitted(&t->judge, &rest) - judge_fitted(&t->judge, &t->choice);
  *echo = cell.statistic * cell.statistic > ECHO * gain + 20.0;
  return status;
}

static status_t drop_echo(select_t *t, bool *dropped, why_t *why) {
  *dropped = false;
  for (int i = 0; i < t->choice.n && !*dropped; i++) {
    const int candidate = t->choice.of[i];
    TRY(is_echo(t, candidate, dropped, why));
    if (!*dropped) continue;
    t->choice = choice_without(&t->choice, candidate);
    t->taken[candidate] = TAKES;
  }
  return ST_OK;
}

static status_t look(select_t *t, why_t *why) {
  for (int round = 0; round < ROUNDS; round++) {
    bool changed = prune_one(t) || swap_one(t) || add_best(t);
    if (!changed) TRY(drop_echo(t, &changed, why));
    if (!changed) return ST_OK;
    TRY(settle(t, why));
  }
  return ST_OK;
}

// First in the colours that would be left if everything that can be named were there: they show what is slow.
// Then in those of what the named effects really leave: what a vehicle has of slow disturbance is noise
// there.
static status_t search(select_t *t, why_t *why) {
  TRY(look(t, why));
  t->strict = true;
  memset(t->taken, 0, (size_t)t->c->n * sizeof(int));
  close_round(t);
  TRY(open_round(t, why));
  return look(t, why);
}

// --- what was found
// -----------------------------------------------------------------------------------------

// Another name in its place that is not worse by two standard errors of the difference.
static void find_rivals(const select_t *t, int candidate, named_t *named) {
  const choice_t rest = choice_without(&t->choice, candidate);
  for (int i = 0; i < t->c->n && named->n_rival < RIVAL_MAX; i++) {
    const fx_t *fx = fx_of(t, i);
    if (fx == fx_of(t, candidate) || !fits(t, &rest, i)) continue;
    if (named->n_rival && named->rival[named->n_rival - 1] == fx) continue;
    const choice_t with = choice_with(&rest, i);
    if (judge_is_rival(&t->judge, &t->choice, &with)) named->rival[named->n_rival++] = fx;
  }
}

static void describe(const select_t *t, found_t *found) {
  const choice_t none = {.n = 0};
  found->left_before = judge_left(&t->judge, &none, NULL);
  found->left = judge_left(&t->judge, &t->choice, NULL);
  for (int i = 0; i < t->choice.n; i++) {
    const int candidate = t->choice.of[i];
    const choice_t rest = choice_without(&t->choice, candidate), last = choice_with(&rest, candidate);
    const verdict_t v = judge_last(&t->judge, &last);
    const fx_t *fx = fx_of(t, candidate);
    if (fx->class == FX_TIMING && fabs(v.value[0]) < fx->size[0].least) {
      found->aligned_s = v.value[0];
      continue;
    }
    named_t *const named = &found->named[found->n++];
    *named = (named_t){.candidate = candidate, .p = v.p};
    memcpy(named->value, v.value, sizeof named->value);
    memcpy(named->stderr_, v.stderr_, sizeof named->stderr_);
    named->share = (judge_left(&t->judge, &rest, NULL) - found->left) / found->left_before;
    find_rivals(t, candidate, named);
  }
}

// Four standard errors, or three times what feedback alone makes, whichever is more; over what is typical.
static void find_least(const select_t *t, found_t *found) {
  for (int i = 0; i < t->c->n; i++) {
    found->least[i] = 0.0;
    if (!fits(t, &t->choice, i)) continue;
    const choice_t with = choice_with(&t->choice, i);
    const verdict_t v = judge_last(&t->judge, &with);
    double rms[FX_SIZE_MAX];
    judge_nominal_rms(&t->judge, &with, rms);
    for (int k = 0; k < t->c->candidate[i].n; k++) {
      const double least = fmax(4.0 * v.stderr_[k], SELECT_NOMINAL * rms[k]);
      found->least[i] = fmax(found->least[i], least / candidate_typical(&t->c->candidate[i], k));
    }
  }
}

status_t select_effects(candidates_t *c, set_t *s, const model_t *base, const nominal_t *nominal,
                        found_t *found, why_t *why) {
  select_t t = {.c = c, .s = s, .base = base, .nominal = nominal};
  *found = (found_t){.least = calloc((size_t)c->n + 1, sizeof(double))};
  t.taken = calloc((size_t)c->n + 1, sizeof(int));
  status_t status = found->least && t.taken ? open_round(&t, why) : error_failed(why, "out of memory");
  if (status == ST_OK) status = search(&t, why);
  if (status == ST_OK) {
    describe(&t, found);
    find_least(&t, found);
    close_round(&t);
  }
  free(t.taken);
  return status;
}

void found_free(found_t *f) {
  free(f->least);
  f->least = NULL;
}
