// windows_along.c - in which part of a coordinate a residual is largest, of four channels side by side.
#include "gap/5_infer/windows.h"

#include "base/wide.h"
#include <math.h>

#define SUMS_NUMBER four_t
#define SUMS_BINS   WINDOW_FINE
#include "gap/5_infer/windows_sums.h"

_Static_assert((int)LOOKED_SMOOTH == WIDE, "the channels of a list are two times four");

// Channels of a list, from `first` on: four of the smooth rows, one of the range's.
typedef struct {
  int list, first, n;
} four_of_t;

static int channel_of(const four_of_t *f, int k) {
  return look_channel(f->list, f->first + k);
}

// Noughts for who is not looked at.
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

// v: the residual, four numbers a row.
WIDE_COPIES static void add_products(products_t *p, int bins, const rows_t *r, const weights_t *w,
                                     const double *v, const int *bin) {
  sums_of(p, bins, r, w, v, bin);
}

// --- windows ----------------------------------------------------------------------------------------------

typedef struct {
  four_t y, own, cross;
} sums_t;

// The channels of which a window may be better than their best one, as windows_below() has it.
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

// Those of which it is; it is better where its exact statistic is.
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

// Windows of up to half the bins.
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
                  .last = w->to + 1 == bins};
}

// v: the rows of the four.
static void try_windows(const look_t *l, int coordinate, cut_t cut, const weights_t *w, const four_of_t *f,
                        const double *v, cell_t cell[LOOKED]) {
  products_t p;
  double edge[WINDOW_FINE + 1];
  window_t best[HALF] = {{.statistic = 0.0}};
  four_bits_t looked = {0};
  const int bins = windows_cut_in[cut];
  if (!windows_cut(l->s, l->m, coordinate, f->list, bins, cut, l->room, l->bin, edge)) return;
  for (int k = 0; k < f->n; k++) {
    looked[k] = l->color[channel_of(f, k)].used ? -1 : 0;
    best[k].statistic = cell[channel_of(f, k)].statistic;
  }
  add_products(&p, bins, windows_rows(l->s, f->list), w, v, l->bin);
  best_windows(&p, l->centred, &looked, best);
  for (int k = 0; k < f->n; k++) {
    const int ch = channel_of(f, k);
    if (best[k].statistic > cell[ch].statistic) cell[ch] = cell_of(&best[k], ch, coordinate, bins, edge);
  }
}

void windows_along(const look_t *l, int coordinate, cell_t cell[LOOKED]) {
  static const four_of_t all[] = {{0, 0, HALF}, {0, HALF, HALF}, {1, 0, 1}};
  for (int i = 0; i < (int)(sizeof all / sizeof *all); i++) {
    const four_of_t *const f = &all[i];
    double *const v = l->room + 2 * set_most_rows(l->s);
    weights_t w;
    weigh(l, f, &w);
    for (int row = 0; row < windows_rows(l->s, f->list)->n; row++)
      for (int k = 0; k < HALF; k++)
        v[HALF * row + k] =
            k < f->n && l->color[channel_of(f, k)].used ? l->residual[channel_of(f, k)][row] : 0.0;
    for (int cut = 0; cut < CUTS; cut++) try_windows(l, coordinate, (cut_t)cut, &w, f, v, cell);
  }
}
