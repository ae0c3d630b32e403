// confined.c - is a name needed in one part of the flights only?
//
// What truly acts, acts wherever its regressor is excited. With the effect's fitted contribution f and what
// the other names leave y, both white, the slope of y over f is 1 everywhere. Where it is near 0 outside of
// a range of place, height or time, or inside of it more than twice, the name stands for something that lies
// in that range.
//
// Nor is a name known that is excited at some time only, where a constant in every channel from then to then
// does as well: something may have begun there, or gone.
#include "gap/5_infer/state.h"
#include "gap/5_infer/unknown.h"
#include <math.h>
#include <stdlib.h>

#define ABSENT  0.55 // a slope that is below this, two standard errors included
#define STRONG  0.95 // a slope inside that is above this
#define TWICE   2.0  // or: a slope inside above this, where outside it is below 1
#define ENOUGH  0.05 // of the regressor's sum of squares must lie outside
#define CLEAR   40.0 // less sum of squares by two slopes in place of one
#define AS_WELL 0.9  // of what a name gives, that constants give
#define BESIDE  3    // bins of time, at least, in which the name is not excited
#define WIDER   1.5  // standard errors grow by this: white rows are not quite independent

typedef struct {
  double ff[UNKNOWN_BINS], fy[UNKNOWN_BINS];
} slopes_t;

typedef struct {
  double *f[CHANNELS], *y[CHANNELS], *room; // white
  color_t color[CHANNELS];                  // of what is left but for what lies at places, times and states
} parts_t;

// Raw contributions first: y is what all names leave, and f.
static done_t parts_make(parts_t *p, const select_t *t, int candidate, why_t *why) {
  int column[COLUMN_MAX];
  double b[COLUMN_MAX];
  const int n = choice_columns(t->c, &t->choice, column);
  const candidate_t *own = &t->c->candidate[candidate];
  const size_t rows = (size_t)(t->s->smooth.n > t->s->range.n ? t->s->smooth.n : t->s->range.n) + 1;
  p->room = calloc((3 * CHANNELS + 1) * rows, sizeof(double));
  if (!p->room) return error_failed(why, "out of memory");
  double *const scratch = p->room + 3 * CHANNELS * rows, *left[CHANNELS];
  judge_estimate(&t->judge, &t->choice, b, NULL);
  for (size_t ch = 0; ch < CHANNELS; ch++) {
    double *const f = p->f[ch] = p->room + 3 * ch * rows, *const y = p->y[ch] = f + rows;
    left[ch] = y + rows;
    const rows_t *r = set_rows(t->s, (int)ch);
    memcpy(y, t->table.x[ch][t->table.columns], (size_t)r->n * sizeof(double));
    for (int k = 0; k < n; k++) {
      const double *x = t->table.x[ch][column[k]];
      const bool is_own = column[k] >= own->first && column[k] < own->first + own->n;
      for (int i = 0; x && i < r->n; i++) *(is_own ? &f[i] : &y[i]) += (is_own ? 1.0 : -1.0) * b[k] * x[i];
    }
    for (int i = 0; i < r->n; i++) left[ch][i] = y[i] - f[i];
  }
  TRY(unknown_colors(t->s, t->base, left, p->color, why));
  for (size_t ch = 0; ch < CHANNELS; ch++) {
    const rows_t *r = set_rows(t->s, (int)ch);
    p->color[ch].used = p->color[ch].used && t->gram.color[ch].used;
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
  if (!(ff_out > ENOUGH * (ff_in + ff_out)) || !(ff_in > 0.0)) return false;
  const double inside = fy_in / ff_in, outside = fy_out / ff_out, apart = inside - outside;
  const bool none = outside + 2.0 * WIDER / sqrt(ff_out) < ABSENT && inside > STRONG;
  return (none || (inside > TWICE && outside < 1.0)) &&
         apart * apart * ff_in * ff_out / (ff_in + ff_out) > CLEAR * WIDER * WIDER;
}

static bool confined(const slopes_t *s) {
  double ff = 0.0, fy = 0.0;
  for (int i = 0; i < UNKNOWN_BINS; i++) {
    ff += s->ff[i];
    fy += s->fy[i];
  }
  for (int from = 0; from < UNKNOWN_BINS; from++) {
    double own_ff = 0.0, own_fy = 0.0;
    for (int to = from; to < UNKNOWN_BINS; to++) {
      own_ff += s->ff[to];
      own_fy += s->fy[to];
      if (absent(own_ff, own_fy, ff - own_ff, fy - own_fy) ||
          absent(ff - own_ff, fy - own_fy, own_ff, own_fy))
        return true;
    }
  }
  return false;
}

static void add_up(const select_t *t, const parts_t *p, int list, const int *bin, slopes_t *s) {
  for (int ch = list ? CH_RANGE : 0; ch < (list ? CHANNELS : CH_SMOOTH); ch++)
    for (int i = 0; p->color[ch].used && i < set_rows(t->s, ch)->n; i++) {
      s->ff[bin[i]] += p->f[ch][i] * p->f[ch][i];
      s->fy[bin[i]] += p->f[ch][i] * p->y[ch][i];
    }
}

// Sums over bins of time: of the name's contribution, and of what constants in each channel would give.
typedef struct {
  double ff[UNKNOWN_BINS], fy, wy[CH_SMOOTH][UNKNOWN_BINS], ww[CH_SMOOTH][UNKNOWN_BINS];
} times_t;

static void add_times(const select_t *t, const parts_t *p, const int *bin, times_t *s) {
  for (int ch = 0; ch < CH_SMOOTH; ch++) {
    const rows_t *const r = &t->s->smooth;
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
  for (int i = 0; i < UNKNOWN_BINS; i++) ff += s->ff[i];
  for (int from = 0; ff > 0.0 && from < UNKNOWN_BINS; from++) {
    double inside = 0.0;
    for (int to = from; to < UNKNOWN_BINS && to - from < UNKNOWN_BINS - BESIDE; to++) {
      inside += s->ff[to];
      if (inside > (1.0 - ENOUGH) * ff && by_constants(s, from, to) > AS_WELL * s->fy * s->fy / ff)
        return true;
    }
  }
  return false;
}

done_t select_is_confined(const select_t *t, int candidate, bool *is, why_t *why) {
  parts_t p = {.room = NULL};
  const size_t rows = (size_t)(t->s->smooth.n > t->s->range.n ? t->s->smooth.n : t->s->range.n) + 1;
  double *const room = malloc(2 * rows * sizeof(double));
  int *const bin = malloc(rows * sizeof(int));
  done_t status = room && bin ? parts_make(&p, t, candidate, why) : error_failed(why, "out of memory");
  *is = false;
  const fx_t *const fx = select_fx(t, candidate);
  const bool curve =
      fx->surface || (fx->needs & FX_NEEDS_WALL); // of a distance: its shape is another question
  for (int i = curve ? coordinate_count : 0; status == DONE && i < coordinate_count && !*is; i++)
    for (int list = 0; coordinate_is_place(i) && list < 2; list++) {
      slopes_t s = {.ff = {0.0}};
      times_t at = {.fy = 0.0};
      if (!unknown_bins(t->s, t->base, i, list, room, bin)) continue;
      add_up(t, &p, list, bin, &s);
      if (list == 0 && strcmp(coordinate_name(i), "time") == 0) add_times(t, &p, bin, &at);
      *is = *is || confined(&s) || at_times(&at);
    }
  free(p.room);
  free(room);
  free(bin);
  return status;
}
