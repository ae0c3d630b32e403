// local.c - does a name act everywhere, or does it stand for what lies at one place or time?
#include "gap/5_infer/local.h"

#include "gap/5_infer/limits.h"
#include "gap/5_infer/unknown.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- what a choice leaves ---------------------------------------------------------------------------------

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

// --- what would look the same -----------------------------------------------------------------------------

// A bias hardly shows in white rows, yet wind looks like one where the vehicle does not turn: plain rows
// tell.
done_t local_alike(const round_t *round, int candidate, bool *alike, why_t *why) {
  const double zero[COLUMN_MAX] = {0.0};
  int column[COLUMN_MAX];
  const explained_t known = {choice_columns(round->c, &round->choice, column), column, zero, true, NULL};
  gram_t plain;
  score_t score = round->score;
  TRY(gram_make(&plain, round->s, &round->table, &known, NULL, why));
  score.g = &plain;
  for (int k = 0; k < round->c->n; k++) {
    const choice_t nothing = {.n = 0}, alone = choice_with(&nothing, k);
    alike[k] = score_likeness(&round->score, &round->choice, candidate, &alone) > SCORE_MOST ||
               score_likeness(&score, &round->choice, candidate, &alone) > SCORE_MOST;
  }
  gram_free(&plain);
  return DONE;
}

// --- the same, but only there -----------------------------------------------------------------------------
//
// A real effect acts wherever its regressor is excited. Let f be the effect's fitted contribution and y what
// the other names leave, both white. One slope of y over f takes (f'y)^2 / f'f from the sum of squares. A
// slope only inside a range of a place, of height or of time, or only outside it, takes the same expression
// of that part's sums. Where that is more, by more than chance among so many parts, something lies there, and
// the name only looks like it.

typedef struct {
  double ff[WINDOW_BINS], fy[WINDOW_BINS];
} by_bin_t;

typedef struct {
  double *f[CHANNELS], *y[CHANNELS], *room; // white
  color_t color[CHANNELS]; // of what is left once what lies at places, times and states is taken out
} parts_t;

// First without colour: f, and y, which is what all names leave plus f.
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
      rows_level(r, part[k]); // what flights differ by is another question
      memcpy(scratch, part[k], (size_t)r->n * sizeof(double));
      color_whiten(&p->color[ch], r, scratch, part[k]);
    }
  }
  return DONE;
}

// Parts of a coordinate that are tried: its ranges of bins, and what lies beside each.
enum { RANGES = WINDOW_BINS * (WINDOW_BINS + 1) };

// True if the effect acts in the part with the sums ff and fy alone. The rest must hold more excitation than
// an average bin: a right form with other numbers is wrong where it is hardly excited.
static bool only_in(double ff, double fy, double all_ff, double all_fy, double chance) {
  return ff > 0.0 && all_ff - ff > all_ff / WINDOW_BINS && fy * fy / ff - all_fy * all_fy / all_ff > chance;
}

static bool in_a_part(const by_bin_t *s, double chance) {
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
      if (only_in(own_ff, own_fy, ff, fy, chance) || only_in(ff - own_ff, fy - own_fy, ff, fy, chance))
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

// Nor is a name accepted that shows only in a window of time, if constants in its own channels do as well
// there but for a fifth: something may have begun or ended in that window.

// Sums over bins of time: of the name's contribution, and of constants in each channel. acts: squares of f in
// a channel; 0: the name does not act in it.
typedef struct {
  double ff[WINDOW_BINS], fy[WINDOW_BINS], acts[CH_SMOOTH], wy[CH_SMOOTH][WINDOW_BINS],
      ww[CH_SMOOTH][WINDOW_BINS];
} times_t;

static void add_times(const round_t *round, const parts_t *p, const int *bin, times_t *s) {
  for (int ch = 0; ch < CH_SMOOTH; ch++) {
    const rows_t *const r = &round->s->smooth;
    const color_t *const c = &p->color[ch];
    for (int i = 0; c->used && i < r->n; i++) {
      if (!color_reaches(r, i)) continue;
      const double w = color_one(c, r, i);
      const double square = p->f[ch][i] * p->f[ch][i];
      s->acts[ch] += square;
      s->ff[bin[i]] += square;
      s->fy[bin[i]] += p->f[ch][i] * p->y[ch][i];
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
    if (ww > 0.0 && s->acts[ch] > 0.0) sum += wy * wy / ww;
  }
  return sum;
}

// True if there is a window of time such that the rest, a quarter or more, gives the name's own slope no more
// than chance does, and constants in the window do nearly as well as the name.
static bool at_times(const times_t *s, double chance) {
  double ff = 0.0, fy = 0.0;
  for (int i = 0; i < WINDOW_BINS; i++) {
    ff += s->ff[i];
    fy += s->fy[i];
  }
  for (int from = 0; ff > 0.0 && from < WINDOW_BINS; from++) {
    double rest_ff = ff, rest_fy = fy;
    for (int to = from; to < WINDOW_BINS && to - from < WINDOW_BINS - WINDOW_BINS / 4; to++) {
      rest_ff -= s->ff[to];
      rest_fy -= s->fy[to];
      const double slope = fy / ff, rest = slope * (2.0 * rest_fy - slope * rest_ff);
      if (rest < chance && by_constants(s, from, to) > UNKNOWN_TIE * slope * fy) return true;
    }
  }
  return false;
}

// Returns the squares that one more number takes of white rows by chance, in so many parts of all places.
static double by_chance(void) {
  int places = 0;
  for (int i = 0; i < COORDINATES; i++) places += coordinate_is_place(i);
  const double errors = SCORE_CLUSTER * limits_noise(places * RANGES);
  return errors * errors;
}

done_t local_is_confined(const round_t *round, int candidate, bool *is, why_t *why) {
  parts_t p = {.room = NULL};
  const size_t rows = set_most_rows(round->s);
  double *const room = malloc(2 * rows * sizeof(double));
  int *const bin = malloc(rows * sizeof(int));
  done_t status = room && bin ? parts_make(&p, round, candidate, why) : error_failed(why, "out of memory");
  const double chance = by_chance();
  *is = false;
  const fx_t *const fx = round_fx(round, candidate);
  const bool curve =
      fx->surface || (fx->needs & FX_NEEDS_WALL); // a curve over distance: its shape is another question
  for (int i = curve ? COORDINATES : 0; status == DONE && i < COORDINATES && !*is; i++)
    for (int list = 0; coordinate_is_place(i) && list < 2; list++) {
      by_bin_t s = {.ff = {0.0}};
      times_t at = {.ff = {0.0}};
      if (!windows_bins(round->s, round->base, i, list, room, bin)) continue;
      add_slopes(round, &p, list, bin, &s);
      if (list == 0 && i == COORDINATE_TIME) add_times(round, &p, bin, &at);
      *is = *is || in_a_part(&s, chance) || at_times(&at, chance);
    }
  free(p.room);
  free(room);
  free(bin);
  return status;
}
