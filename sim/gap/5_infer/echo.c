// echo.c - is a name only an echo of something at one place, time or state?
#include "gap/5_infer/state.h"
#include "gap/5_infer/unknown.h"
#include <stdlib.h>
#include <string.h>

#define ECHO   1.3  // so much more than a name a cell must explain
#define BEYOND 0.7  // or so much of it, though the name is there
#define CELL   8.0  // standard errors
#define ALIKE  0.25 // of a name's contribution, that another one could give

// What a choice leaves, row by row, in the straight line's sense.
static done_t left_by(const select_t *t, const choice_t *choice, double *left[CHANNELS], why_t *why) {
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
  return DONE;
}

static double white_squares(const rows_t *r, const color_t *c, const double *with, const double *without) {
  double sum = 0.0;
  for (int i = 2; i < r->n; i++) {
    if (!color_reaches(r, i)) continue;
    const double f = without[i] - with[i], f1 = without[i - 1] - with[i - 1],
                 f2 = without[i - 2] - with[i - 2];
    const double e = (f - c->a1 * f1 - c->a2 * f2) / c->sd;
    sum += e * e;
  }
  return sum;
}

typedef struct {
  double *without[CHANNELS], *with[CHANNELS]; // what is left
} left_t;

static done_t compare(const select_t *t, int candidate, const left_t *l, bool *echo, why_t *why) {
  const choice_t rest = choice_without(&t->choice, candidate);
  const double gain = judge_fitted(&t->judge, &rest) - judge_fitted(&t->judge, &t->choice);
  color_t color[CHANNELS], clean[CHANNELS]; // of the channels in which the name is seen
  cell_t before, beside;
  double own = 0.0;
  TRY(unknown_colors(t->s, t->base, l->with, clean, why));
  for (int ch = 0; ch < CHANNELS; ch++) {
    const candidate_t *c = &t->c->candidate[candidate];
    bool seen = false;
    for (int k = 0; t->gram.color[ch].used && k < c->n; k++) seen = seen || t->table.x[ch][c->first + k];
    color[ch] = t->gram.color[ch];
    color[ch].used = color[ch].used && seen;
    clean[ch].used = clean[ch].used && seen;
    if (clean[ch].used) own += white_squares(set_rows(t->s, ch), &clean[ch], l->with[ch], l->without[ch]);
  }
  TRY(unknown_largest(t->s, t->base, l->without, color, false, &before, why));
  TRY(unknown_largest(t->s, t->base, l->with, clean, true, &beside, why));
  const double first = before.statistic * before.statistic, left = beside.statistic * beside.statistic;
  *echo = first > ECHO * gain + 20.0 || (beside.statistic > CELL && left > BEYOND * own);
  return DONE;
}

done_t select_is_echo(const select_t *t, int candidate, bool *echo, why_t *why) {
  const choice_t rest = choice_without(&t->choice, candidate);
  left_t l = {.with = {NULL}};
  done_t status = left_by(t, &rest, l.without, why);
  if (status == DONE) status = left_by(t, &t->choice, l.with, why);
  if (status == DONE) status = compare(t, candidate, &l, echo, why);
  for (int ch = 0; ch < CHANNELS; ch++) {
    free(l.without[ch]);
    free(l.with[ch]);
  }
  return status;
}

// Nor is it what would look the same: white, or as a plain mean over rows. A bias has hardly a white row,
// yet it is what a wind becomes where nobody turns.
done_t select_forbid_alike(select_t *t, int candidate, why_t *why) {
  const double zero[COLUMN_MAX] = {0.0};
  int column[COLUMN_MAX];
  const explained_t known = {choice_columns(t->c, &t->choice, column), column, zero, true};
  gram_t plain;
  judge_t judge = t->judge;
  TRY(gram_make(&plain, t->s, &t->table, &known, NULL, why));
  judge.g = &plain;
  for (int k = 0; k < t->c->n; k++)
    if (judge_likeness(&t->judge, &t->choice, candidate, k) > ALIKE ||
        judge_likeness(&judge, &t->choice, candidate, k) > ALIKE)
      t->taken[k] = TAKES;
  gram_free(&plain);
  return DONE;
}
