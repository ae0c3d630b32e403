// windows_along.c - in which part of a coordinate a residual is largest, of four channels side by side.
#include "gap/5_infer/windows.h"

#include "base/wide.h"
#include <math.h>

#define SUMS_NUMBER four_t
#define SUMS_BINS   WINDOW_FINE
#include "gap/5_infer/windows_sums.h"

_Static_assert((int)LOOKED_SMOOTH == WIDE, "the channels of a list are two times four");

// Channels of a list of rows, from `first` on: four of the smooth rows, or the range's one.
typedef struct {
  int list, first, n;
} four_of_t;

static int channel_of(const four_of_t *f, int k) {
  return look_channel(f->list, f->first + k);
}

// Sets the white weights of the channels; 0 for one that is left out.
static void weigh(const look_t *l, const four_of_t *f, weights_t *w) {
  double at[3][HALF] = {{0.0}};
  for (int k = 0; k < f->n; k++) {
    const color_t *const c = &l->color[channel_of(f, k)];
    if (!c->used) continue;
    at[0][k] = 1.0 / c->sd;
    at[1][k] = -c->a1 / c->sd;
    at[2][k] = -c->a2 / c->sd;
  }
  for (int a = 0; a < 3; a++) FOUR_LOAD(w->of[a], at[a]);
  weights_multiply(w);
}

// v: the residual, four numbers for each row.
WIDE_COPIES static void add_products(products_t *p, int bins, const rows_t *r, const weights_t *w,
                                     const double *v, const int *bin) {
  sums_of(p, bins, r, w, v, bin);
}

// --- windows ----------------------------------------------------------------------------------------------

typedef struct {
  four_t y, own, cross;
} sums_t;

// Marks the channels in which a window may be better than the best so far (not surely below it, as
// is_below() in windows.c).
WIDE_INLINE void may_be_better(const sums_t *all, const four_t *per_all, const sums_t *w, const four_t *best,
                               four_bits_t *may) {
  const four_t share = w->cross * *per_all, taken = share * all->y, left = w->y - taken;
  const four_t own = w->own - share * w->cross;
  const four_bits_t no_sign = (four_bits_t){0} + INT64_MAX;
  const four_t y = (four_t)((four_bits_t)left & no_sign) +
                   1e-12 * ((four_t)((four_bits_t)w->y & no_sign) + (four_t)((four_bits_t)taken & no_sign));
  *may = ~((own > 2e-3 * w->own) & (y * y < (1.0 - 1e-9) * *best * *best * own));
}

WIDE_INLINE bool any(const four_bits_t *of) {
  return ((*of)[0] | (*of)[1] | (*of)[2] | (*of)[3]) != 0;
}

// Takes the window for the marked channels in which its exact statistic is better.
static void take_better(const sums_t *all, bool centred, const sums_t *w, const four_bits_t *may, int from,
                        int to, four_t *known, window_t best[HALF]) {
  for (int k = 0; k < HALF; k++) {
    double size, statistic;
    const window_sums_t of_all = {all->y[k], all->own[k], 0.0}, in = {w->y[k], w->own[k], w->cross[k]};
    if (!(*may)[k] || !windows_judge(&of_all, centred, &in, &size, &statistic) ||
        statistic <= best[k].statistic)
      continue;
    best[k] = (window_t){from, to, size, statistic};
    (*known)[k] = statistic;
  }
}

// Finds the best window of up to half of the bins, by channel.
WIDE_COPIES static void best_windows(const products_t *p, bool centred, const four_bits_t *looked,
                                     window_t best[HALF]) {
  four_t column[WINDOW_FINE + 1]; // of D: sums over the window's rows
  const int bins = p->bins;
  const sums_t all = {p->y[bins], p->D[bins][bins], {0.0}};
  const four_t per_all = (centred ? 1.0 : 0.0) / all.own;
  four_t known = {0.0};
  for (int k = 0; k < HALF; k++) known[k] = best[k].statistic;
  for (int from = 0; from < bins; from++) {
    sums_t w = {{0.0}, {0.0}, {0.0}};
    const int end = from + bins / 2 < bins ? from + bins / 2 : bins;
    for (int k = from; k < end; k++) column[k] = (four_t){0.0};
    for (int to = from; to < end; to++) {
      four_bits_t may;
      w.y += p->y[to];
      w.cross += p->D[to][bins];
      w.own += 2.0 * column[to] + p->D[to][to];
      for (int k = to + 1; k < end; k++) column[k] += p->D[to][k];
      may_be_better(&all, &per_all, &w, &known, &may);
      may &= *looked;
      if (any(&may)) take_better(&all, centred, &w, &may, from, to, &known, best);
    }
  }
}

// --- a coordinate -----------------------------------------------------------------------------------------

// True if, for a window that reaches an end, the rest of the coordinate is what differs. Beside a constant
// the two cannot be told apart, and windows are no longer than half of the coordinate. The rest is told if
// it explains more of the residual without that constant, and has the other sign.
static bool lies_beside(const products_t *p, int k, const window_t *w) {
  const int bins = p->bins;
  double y = 0.0, own = 0.0, cross = 0.0;
  if (w->from > 0 && w->to + 1 < bins) return false;
  for (int a = w->from; a <= w->to; a++) {
    y += p->y[a][k];
    cross += p->D[a][bins][k];
    for (int b = w->from; b <= w->to; b++) own += p->D[a][b][k];
  }
  const double y_beside = p->y[bins][k] - y, own_beside = p->D[bins][bins][k] - 2.0 * cross + own;
  if (!(own > 0.0 && own_beside > 0.0 && y_beside * w->size < 0.0)) return false;
  return y_beside * y_beside * own > y * y * own_beside;
}

static window_t beside(const window_t *w, int bins) {
  const bool lowest = w->from == 0;
  return (window_t){lowest ? w->to + 1 : 0, lowest ? bins - 1 : w->from - 1, -w->size, w->statistic};
}

static cell_t cell_of(const window_t *w, int channel, int coordinate, int bins, const double *edge) {
  return (cell_t){.channel = channel,
                  .along = coordinate,
                  .coordinate = coordinate_name(coordinate),
                  .unit = coordinate_unit(coordinate),
                  .from = edge[w->from],
                  .to = edge[w->to + 1],
                  .size = w->size,
                  .statistic = w->statistic,
                  .explained = w->statistic * w->statistic,
                  .first = w->from == 0,
                  .last = w->to + 1 == bins};
}

// Four channels of a list: weights, and residuals, four numbers for each row.
typedef struct {
  four_of_t four;
  weights_t w;
  const double *v;
} fours_t;

static void try_windows(const look_t *l, int coordinate, int bins, const double *edge, const fours_t *f,
                        cell_t cell[LOOKED]) {
  products_t p;
  window_t best[HALF] = {{.statistic = 0.0}};
  four_bits_t looked = {0};
  for (int k = 0; k < f->four.n; k++) {
    looked[k] = l->color[channel_of(&f->four, k)].used ? -1 : 0;
    best[k].statistic = cell[channel_of(&f->four, k)].statistic;
  }
  add_products(&p, bins, windows_rows(l->s, f->four.list), &f->w, f->v, l->bin);
  best_windows(&p, l->centred, &looked, best);
  for (int k = 0; k < f->four.n; k++) {
    const int ch = channel_of(&f->four, k);
    if (!(best[k].statistic > cell[ch].statistic)) continue;
    const window_t at = l->centred && lies_beside(&p, k, &best[k]) ? beside(&best[k], bins) : best[k];
    cell[ch] = cell_of(&at, ch, coordinate, bins, edge);
  }
}

static void take_four(const look_t *l, fours_t *f, double *v) {
  const int n = windows_rows(l->s, f->four.list)->n;
  weigh(l, &f->four, &f->w);
  f->v = v;
  for (int k = 0; k < HALF; k++) {
    const int ch = channel_of(&f->four, k);
    const double *const from = k < f->four.n && l->color[ch].used ? l->residual[ch] : NULL;
    for (int i = 0; i < n; i++) v[HALF * i + k] = from ? from[i] : 0.0;
  }
}

void windows_along(const look_t *l, int coordinate, cell_t cell[LOOKED]) {
  for (int list = 0; list < 2; list++) {
    const int fours = list ? 1 : HALVES, rows = windows_rows(l->s, list)->n;
    double *const room = l->room + 2 * set_most_rows(l->s);
    fours_t f[HALVES];
    for (int i = 0; i < fours; i++) {
      f[i].four = (four_of_t){list, HALF * i, list ? 1 : HALF};
      take_four(l, &f[i], room + HALF * i * rows);
    }
    for (int cut = 0; cut < CUTS; cut++) {
      double edge[WINDOW_FINE + 1];
      const int bins = windows_cut_in[cut];
      if (!windows_cut(l->s, l->m, coordinate, list, bins, (cut_t)cut, l->room, l->bin, edge)) continue;
      for (int i = 0; i < fours; i++) try_windows(l, coordinate, bins, edge, &f[i], cell);
    }
  }
}
