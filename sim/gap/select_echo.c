// select_echo.c - is a name only an echo of something at one place, time or state?
#include "gap/select_state.h"
#include "gap/unknown.h"
#include <stdlib.h>
#include <string.h>

#define ECHO 1.3 // so much more than a name a cell must explain

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

status_t select_is_echo(const select_t *t, int candidate, bool *echo, why_t *why) {
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
