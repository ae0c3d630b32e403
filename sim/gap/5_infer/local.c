// local.c - is a name only what something at one place, time or state looks like?
#include "gap/5_infer/local.h"

#include "gap/5_infer/unknown.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- an echo: something there explains more than the name does --------------------------------------------

#define ECHO   1.3 // so much more than a name a cell must explain
#define BEYOND 0.7 // or so much of it, though the name is there
#define CELL   8.0 // standard errors

done_t local_left(const round_t *round, const choice_t *choice, double *left[CHANNELS], why_t *why) {
  int column[COLUMN_MAX];
  double b[COLUMN_MAX];
  const int n = choice_columns(round->c, choice, column);
  score_estimate(&round->score, choice, b, NULL);
  for (int ch = 0; ch < CHANNELS; ch++) {
    const size_t rows = (size_t)set_rows(round->s, ch)->n;
    left[ch] = malloc((rows + 1) * sizeof(double));
    if (!left[ch]) return error_failed(why, "out of memory");
    memcpy(left[ch], round->table.x[ch][round->table.columns], rows * sizeof(double));
    for (int k = 0; k < n; k++) {
      const double *x = round->table.x[ch][column[k]];
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

static done_t compare_cells(const round_t *round, int candidate, const left_t *l, bool *echo, why_t *why) {
  const choice_t rest = choice_without(&round->choice, candidate);
  const double gain = score_fitted(&round->score, &rest) - score_fitted(&round->score, &round->choice);
  color_t color[CHANNELS], clean[CHANNELS]; // of the channels in which the name is seen
  cell_t before, beside;
  double own = 0.0;
  TRY(unknown_colors(round->s, round->base, l->with, clean, why));
  for (int ch = 0; ch < CHANNELS; ch++) {
    const candidate_t *c = &round->c->candidate[candidate];
    bool seen = false;
    for (int k = 0; round->gram.color[ch].used && k < c->n; k++)
      seen = seen || round->table.x[ch][c->first + k];
    color[ch] = round->gram.color[ch];
    color[ch].used = color[ch].used && seen;
    clean[ch].used = clean[ch].used && seen;
    if (clean[ch].used) own += white_squares(set_rows(round->s, ch), &clean[ch], l->with[ch], l->without[ch]);
  }
  TRY(unknown_largest(round->s, round->base, l->without, color, false, &before, why));
  TRY(unknown_largest(round->s, round->base, l->with, clean, true, &beside, why));
  const double first = before.statistic * before.statistic, left = beside.statistic * beside.statistic;
  *echo = first > ECHO * gain + 20.0 || (beside.statistic > CELL && left > BEYOND * own);
  return DONE;
}

done_t local_is_echo(const round_t *round, int candidate, bool *echo, why_t *why) {
  const choice_t rest = choice_without(&round->choice, candidate);
  left_t l = {.with = {NULL}};
  done_t status = local_left(round, &rest, l.without, why);
  if (status == DONE) status = local_left(round, &round->choice, l.with, why);
  if (status == DONE) status = compare_cells(round, candidate, &l, echo, why);
  for (int ch = 0; ch < CHANNELS; ch++) {
    free(l.without[ch]);
    free(l.with[ch]);
  }
  return status;
}

// --- what would look the same -----------------------------------------------------------------------------

#define ALIKE 0.25 // of a name's contribution, that another one could give

// A bias has hardly a white row, yet it is what a wind becomes where nobody turns: plain means tell.
done_t local_alike(const round_t *round, int candidate, bool *alike, why_t *why) {
  const double zero[COLUMN_MAX] = {0.0};
  int column[COLUMN_MAX];
  const explained_t known = {choice_columns(round->c, &round->choice, column), column, zero, true};
  gram_t plain;
  score_t score = round->score;
  TRY(gram_make(&plain, round->s, &round->table, &known, NULL, why));
  score.g = &plain;
  for (int k = 0; k < round->c->n; k++)
    alike[k] = score_likeness(&round->score, &round->choice, candidate, k) > ALIKE ||
               score_likeness(&score, &round->choice, candidate, k) > ALIKE;
  gram_free(&plain);
  return DONE;
}

// --- confined: it is needed in one part of the flights only ------------------------------------------------
//
// What truly acts, acts wherever its regressor is excited. With the effect's fitted contribution f and what
// the other names leave y, both white, the slope of y over f is 1 everywhere. Where it is near 0 outside of
// a range of place, height or time, or inside of it more than twice, the name stands for something that lies
// in that range.
//
// Nor is a name known that is excited at some time only, where a constant in every channel from then to then
// does as well: something may have begun there, or gone.

#define ABSENT       0.55 // a slope that is below this, two standard errors included
#define STRONG       0.95 // a slope inside that is above this
#define TWICE        2.0  // or: a slope inside above this, where outside it is below 1
#define LEFT_OUTSIDE 0.05 // of the regressor's sum of squares must lie outside
#define CLEAR        40.0 // less sum of squares by two slopes in place of one
#define AS_WELL      0.9  // of what a name gives, that constants give
#define BESIDE       3    // bins of time, at least, in which the name is not excited
#define WIDER        1.5  // standard errors grow by this: white rows are not quite independent

typedef struct {
  double ff[WINDOW_BINS], fy[WINDOW_BINS];
} by_bin_t;

typedef struct {
  double *f[CHANNELS], *y[CHANNELS], *room; // white
  color_t color[CHANNELS];                  // of what is left but for what lies at places, times and states
} parts_t;

// Raw contributions first: y is what all names leave, and f.
static done_t parts_make(parts_t *p, const round_t *round, int candidate, why_t *why) {
  int column[COLUMN_MAX];
  double b[COLUMN_MAX];
  const int n = choice_columns(round->c, &round->choice, column);
  const candidate_t *own = &round->c->candidate[candidate];
  const size_t rows = set_most_rows(round->s);
  p->room = calloc((3 * CHANNELS + 1) * rows, sizeof(double));
  if (!p->room) return error_failed(why, "out of memory");
  double *const scratch = p->room + 3 * CHANNELS * rows, *left[CHANNELS];
  score_estimate(&round->score, &round->choice, b, NULL);
  for (size_t ch = 0; ch < CHANNELS; ch++) {
    double *const f = p->f[ch] = p->room + 3 * ch * rows, *const y = p->y[ch] = f + rows;
    left[ch] = y + rows;
    const rows_t *r = set_rows(round->s, (int)ch);
    memcpy(y, round->table.x[ch][round->table.columns], (size_t)r->n * sizeof(double));
    for (int k = 0; k < n; k++) {
      const double *x = round->table.x[ch][column[k]];
      const bool is_own = column[k] >= own->first && column[k] < own->first + own->n;
      for (int i = 0; x && i < r->n; i++) *(is_own ? &f[i] : &y[i]) += (is_own ? 1.0 : -1.0) * b[k] * x[i];
    }
    for (int i = 0; i < r->n; i++) left[ch][i] = y[i] - f[i];
  }
  TRY(unknown_colors(round->s, round->base, left, p->color, why));
  for (size_t ch = 0; ch < CHANNELS; ch++) {
    const rows_t *r = set_rows(round->s, (int)ch);
    p->color[ch].used = p->color[ch].used && round->gram.color[ch].used;
    if (!p->color[ch].used) continue;
    double *const part[] = {p->f[ch], p->y[ch]};
    for (int k = 0; k < 2; k++) {
      memcpy(scratch, part[k], (size_t)r->n * sizeof(double));
      color_whiten(&p->color[ch], r, scratch, part[k]);
    }
  }
  return DONE;
}

// in: the part in which the name is needed. Sums of f f and of f y.
static bool absent(double ff_in, double fy_in, double ff_out, double fy_out) {
  if (!(ff_out > LEFT_OUTSIDE * (ff_in + ff_out)) || !(ff_in > 0.0)) return false;
  const double inside = fy_in / ff_in, outside = fy_out / ff_out, apart = inside - outside;
  const bool none = outside + 2.0 * WIDER / sqrt(ff_out) < ABSENT && inside > STRONG;
  return (none || (inside > TWICE && outside < 1.0)) &&
         apart * apart * ff_in * ff_out / (ff_in + ff_out) > CLEAR * WIDER * WIDER;
}

static bool needed_in_a_part(const by_bin_t *s) {
  double ff = 0.0, fy = 0.0;
  for (int i = 0; i < WINDOW_BINS; i++) {
    ff += s->ff[i];
    fy += s->fy[i];
  }
  for (int from = 0; from < WINDOW_BINS; from++) {
    double own_ff = 0.0, own_fy = 0.0;
    for (int to = from; to < WINDOW_BINS; to++) {
      own_ff += s->ff[to];
      own_fy += s->fy[to];
      if (absent(own_ff, own_fy, ff - own_ff, fy - own_fy) ||
          absent(ff - own_ff, fy - own_fy, own_ff, own_fy))
        return true;
    }
  }
  return false;
}

static void add_slopes(const round_t *round, const parts_t *p, int list, const int *bin, by_bin_t *s) {
  for (int ch = list ? CH_RANGE : 0; ch < (list ? CHANNELS : CH_SMOOTH); ch++)
    for (int i = 0; p->color[ch].used && i < set_rows(round->s, ch)->n; i++) {
      s->ff[bin[i]] += p->f[ch][i] * p->f[ch][i];
      s->fy[bin[i]] += p->f[ch][i] * p->y[ch][i];
    }
}

// Sums over bins of time: of the name's contribution, and of what constants in each channel would give.
typedef struct {
  double ff[WINDOW_BINS], fy, wy[CH_SMOOTH][WINDOW_BINS], ww[CH_SMOOTH][WINDOW_BINS];
} times_t;

static void add_times(const round_t *round, const parts_t *p, const int *bin, times_t *s) {
  for (int ch = 0; ch < CH_SMOOTH; ch++) {
    const rows_t *const r = &round->s->smooth;
    const color_t *const c = &p->color[ch];
    for (int i = 0; c->used && i < r->n; i++) {
      if (!color_reaches(r, i)) continue;
      const double w = (1.0 - c->a1 - c->a2) / c->sd; // a constant, white
      s->ff[bin[i]] += p->f[ch][i] * p->f[ch][i];
      s->fy += p->f[ch][i] * p->y[ch][i];
      s->wy[ch][bin[i]] += w * p->y[ch][i];
      s->ww[ch][bin[i]] += w * w;
    }
  }
}

static double by_constants(const times_t *s, int from, int to) {
  double sum = 0.0;
  for (int ch = 0; ch < CH_SMOOTH; ch++) {
    double wy = 0.0, ww = 0.0;
    for (int i = from; i <= to; i++) {
      wy += s->wy[ch][i];
      ww += s->ww[ch][i];
    }
    if (ww > 0.0) sum += wy * wy / ww;
  }
  return sum;
}

static bool at_times(const times_t *s) {
  double ff = 0.0;
  for (int i = 0; i < WINDOW_BINS; i++) ff += s->ff[i];
  for (int from = 0; ff > 0.0 && from < WINDOW_BINS; from++) {
    double inside = 0.0;
    for (int to = from; to < WINDOW_BINS && to - from < WINDOW_BINS - BESIDE; to++) {
      inside += s->ff[to];
      if (inside > (1.0 - LEFT_OUTSIDE) * ff && by_constants(s, from, to) > AS_WELL * s->fy * s->fy / ff)
        return true;
    }
  }
  return false;
}

done_t local_is_confined(const round_t *round, int candidate, bool *is, why_t *why) {
  parts_t p = {.room = NULL};
  const size_t rows = set_most_rows(round->s);
  double *const room = malloc(2 * rows * sizeof(double));
  int *const bin = malloc(rows * sizeof(int));
  done_t status = room && bin ? parts_make(&p, round, candidate, why) : error_failed(why, "out of memory");
  *is = false;
  const fx_t *const fx = round_fx(round, candidate);
  const bool curve =
      fx->surface || (fx->needs & FX_NEEDS_WALL); // of a distance: its shape is another question
  for (int i = curve ? COORDINATES : 0; status == DONE && i < COORDINATES && !*is; i++)
    for (int list = 0; coordinate_is_place(i) && list < 2; list++) {
      by_bin_t s = {.ff = {0.0}};
      times_t at = {.fy = 0.0};
      if (!windows_bins(round->s, round->base, i, list, room, bin)) continue;
      add_slopes(round, &p, list, bin, &s);
      if (list == 0 && i == COORDINATE_TIME) add_times(round, &p, bin, &at);
      *is = *is || needed_in_a_part(&s) || at_times(&at);
    }
  free(p.room);
  free(room);
  free(bin);
  return status;
}
