// windows_along.c - in which part of a coordinate a residual is largest, of all channels side by side.
#include "gap/5_infer/windows.h"

#include "base/wide.h"
#include <math.h>

#define SUMS_NUMBER wide_t
#define SUMS_BINS   WINDOW_FINE
#include "gap/5_infer/windows_sums.h"

_Static_assert((int)LOOKED_SMOOTH <= WIDE, "all channels of a list lie side by side");

// Noughts for who is not looked at.
static void weigh(const look_t *l, int list, int n, weights_t *w) {
  double at[3][WIDE] = {{0.0}};
  for (int k = 0; k < n; k++) {
    const color_t *const c = &l->color[look_channel(list, k)];
    if (!c->used) continue;
    at[0][k] = 1.0 / c->sd;
    at[1][k] = -c->a1 / c->sd;
    at[2][k] = -c->a2 / c->sd;
  }
  for (int a = 0; a < 3; a++) WIDE_LOAD(w->of[a], at[a]);
  weights_multiply(w);
}

// v: the residual, WIDE numbers a row.
WIDE_COPIES static void add_products(products_t *p, int bins, const rows_t *r, const weights_t *w,
                                     const double *v, const int *bin) {
  sums_of(p, bins, r, w, v, bin);
}

// --- windows ----------------------------------------------------------------------------------------------

typedef struct {
  wide_t y, own, cross;
} sums_t;

// The channels of which a window may be better than their best one, as windows_below() has it.
WIDE_INLINE void may_be_better(const sums_t *all, const wide_t *per_all, const sums_t *w, const wide_t *best,
                               wide_bits_t *may) {
  const wide_t share = w->cross * *per_all, taken = share * all->y, left = w->y - taken;
  const wide_t own = w->own - share * w->cross;
  const wide_bits_t no_sign = (wide_bits_t){0} + INT64_MAX;
  const wide_t y = (wide_t)((wide_bits_t)left & no_sign) +
                   1e-12 * ((wide_t)((wide_bits_t)w->y & no_sign) + (wide_t)((wide_bits_t)taken & no_sign));
  *may = ~((own > 2e-3 * w->own) & (y * y < (1.0 - 1e-9) * *best * *best * own));
}

WIDE_INLINE bool any(const wide_bits_t *of) {
  int64_t all = 0;
  for (int k = 0; k < WIDE; k++) all |= (*of)[k];
  return all != 0;
}

// Those of which it is; it is better where its exact statistic is.
static void take_better(const sums_t *all, bool centred, const sums_t *w, const wide_bits_t *may, int from,
                        int to, wide_t *known, window_t best[WIDE]) {
  for (int k = 0; k < WIDE; k++) {
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
WIDE_COPIES static void best_windows(const products_t *p, bool centred, const wide_bits_t *looked,
                                     window_t best[WIDE]) {
  wide_t column[WINDOW_FINE + 1]; // of D: sums over the window's rows
  const int bins = p->bins;
  const sums_t all = {p->y[bins], p->D[bins][bins], {0.0}};
  const wide_t per_all = (centred ? 1.0 : 0.0) / all.own;
  wide_t known = {0.0};
  for (int k = 0; k < WIDE; k++) known[k] = best[k].statistic;
  for (int from = 0; from < bins; from++) {
    sums_t w = {{0.0}, {0.0}, {0.0}};
    const int end = from + bins / 2 < bins ? from + bins / 2 : bins;
    for (int k = from; k < end; k++) column[k] = (wide_t){0.0};
    for (int to = from; to < end; to++) {
      wide_bits_t may;
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

// So many channels of a list, whose rows lie side by side in v.
static void try_windows(const look_t *l, int coordinate, cut_t cut, const weights_t *w, int list, int n,
                        const double *v, cell_t cell[LOOKED]) {
  products_t p;
  double edge[WINDOW_FINE + 1];
  window_t best[WIDE] = {{.statistic = 0.0}};
  wide_bits_t looked = {0};
  const int bins = windows_cut_in[cut];
  if (!windows_cut(l->s, l->m, coordinate, list, bins, cut, l->room, l->bin, edge)) return;
  for (int k = 0; k < n; k++) {
    looked[k] = l->color[look_channel(list, k)].used ? -1 : 0;
    best[k].statistic = cell[look_channel(list, k)].statistic;
  }
  add_products(&p, bins, windows_rows(l->s, list), w, v, l->bin);
  best_windows(&p, l->centred, &looked, best);
  for (int k = 0; k < n; k++) {
    const int ch = look_channel(list, k);
    if (best[k].statistic > cell[ch].statistic) cell[ch] = cell_of(&best[k], ch, coordinate, bins, edge);
  }
}

void windows_along(const look_t *l, int coordinate, cell_t cell[LOOKED]) {
  for (int list = 0; list < 2; list++) {
    const int n = list ? 1 : LOOKED_SMOOTH;
    double *const v = l->room + 2 * set_most_rows(l->s);
    weights_t w;
    weigh(l, list, n, &w);
    for (int i = 0; i < windows_rows(l->s, list)->n; i++)
      for (int k = 0; k < WIDE; k++) {
        const int ch = look_channel(list, k);
        v[WIDE * i + k] = k < n && l->color[ch].used ? l->residual[ch][i] : 0.0;
      }
    for (int cut = 0; cut < CUTS; cut++) try_windows(l, coordinate, (cut_t)cut, &w, list, n, v, cell);
  }
}
