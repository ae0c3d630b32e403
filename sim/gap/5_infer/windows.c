// windows.c - in which part of a coordinate, or of the floor, a residual is largest.
#include "gap/5_infer/windows.h"

#include "base/wide.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Strips of the floor along x and along y, with equally many rows in each, to find a patch: all 26^2 patches
// are tried in every scan.
#define STRIPS 8
// Parts of a strip, to fit the ends of a patch: 20 s of flight hold four rows in a part.
#define PARTS 16

enum {
  MOST = STRIPS / 2,             // strips of a patch at most: half, as along a coordinate
  BINS_MAX = STRIPS * PARTS + 1, // of any cut, and one for what lies beside
};

#define SUMS_NUMBER double
#define SUMS_BINS   BINS_MAX
#include "gap/5_infer/windows_sums.h"

_Static_assert(STRIPS *STRIPS <= BINS_MAX && (int)WINDOW_FINE <= BINS_MAX, "every cut has room");

// --- sums -------------------------------------------------------------------------------------------------

static void add_products(products_t *p, int bins, const rows_t *r, const color_t *c, const double *v,
                         const int *bin) {
  weights_t w = {{1.0 / c->sd, -c->a1 / c->sd, -c->a2 / c->sd}, 0.0, {{0.0}}, {0.0}};
  weights_multiply(&w);
  sums_of(p, bins, r, &w, v, bin);
}

static void take_in(window_sums_t *w, const products_t *p, int k, const int *before, int n) {
  w->y += p->y[k];
  w->cross += p->D[k][p->bins];
  w->own += p->D[k][k];
  for (int i = 0; i < n; i++) w->own += 2.0 * p->D[before[i]][k];
}

static bool judge(const products_t *p, bool centred, const window_sums_t *w, double *size,
                  double *statistic) {
  const window_sums_t all = {p->y[p->bins], p->D[p->bins][p->bins], 0.0};
  return windows_judge(&all, centred, w, size, statistic);
}

// True if the statistic of a window is surely below `best`, found without a division or a root: this is so
// for nearly all windows. per_all: 1 over the sum of squares of the constant, 0 where none is taken out. The
// margins are a thousand times the rounding.
WIDE_INLINE bool is_below(const products_t *p, double per_all, const window_sums_t *w, double best) {
  const double share = w->cross * per_all, taken = share * p->y[p->bins];
  const double y = fabs(w->y - taken) + 1e-12 * (fabs(w->y) + fabs(taken)), own = w->own - share * w->cross;
  return own > 2e-3 * w->own && y * y < (1.0 - 1e-9) * best * best * own;
}

// --- windows ---------------------------------------------------------------------------------

// Finds the best window of shortest..longest bins among the first `bins`. False: none is better than *best.
WIDE_COPIES static bool best_window(const products_t *p, bool centred, int bins, int shortest, int longest,
                                    window_t *best) {
  double size, statistic;
  double column[BINS_MAX + 1]; // of D: sums over the window's rows
  bool better = false;
  const double per_all = centred ? 1.0 / p->D[p->bins][p->bins] : 0.0;
  for (int from = 0; from < bins; from++) {
    window_sums_t w = {0.0, 0.0, 0.0};
    const int end = from + longest < bins ? from + longest : bins;
    for (int k = from; k < end; k++) column[k] = 0.0;
    for (int to = from; to < end; to++) {
      w.y += p->y[to];
      w.cross += p->D[to][p->bins];
      w.own += 2.0 * column[to] + p->D[to][to];
      for (int k = to + 1; k < end; k++) column[k] += p->D[to][k];
      if (to - from + 1 < shortest || is_below(p, per_all, &w, best->statistic) ||
          !judge(p, centred, &w, &size, &statistic) || statistic <= best->statistic)
        continue;
      *best = (window_t){from, to, size, statistic};
      better = true;
    }
  }
  return better;
}

// --- on the floor -----------------------------------------------------------------------------------------

// In bins of equally many rows along x and along y; both ends are inside.
typedef struct {
  int x, x_to, y, y_to;
  double size, statistic;
} patch_t;

static void judge_patch(const products_t *p, bool centred, patch_t at, patch_t *best) {
  window_sums_t w = {0.0, 0.0, 0.0};
  int in[BINS_MAX], n = 0;
  for (int x = at.x; x <= at.x_to; x++)
    for (int y = at.y; y <= at.y_to; y++) {
      take_in(&w, p, x * STRIPS + y, in, n);
      in[n++] = x * STRIPS + y;
    }
  if (judge(p, centred, &w, &at.size, &at.statistic) && at.statistic > best->statistic) *best = at;
}

static patch_t best_of_strips(const products_t *p, bool centred) {
  patch_t best = {.statistic = 0.0};
  for (patch_t at = {.x = 0}; at.x < STRIPS; at.x++)
    for (at.y = 0; at.y < STRIPS; at.y++)
      for (at.x_to = at.x; at.x_to < STRIPS && at.x_to < at.x + MOST; at.x_to++)
        for (at.y_to = at.y; at.y_to < STRIPS && at.y_to < at.y + MOST; at.y_to++)
          judge_patch(p, centred, at, &best);
  return best;
}

// The floor cut finely along x and along y: the bin of every row, and the edges.
typedef struct {
  const look_t *l;
  int *x, *y, *bin; // bin: room
  int parts;        // of a strip
  products_t p;     // room
  double x_edge[BINS_MAX + 1], y_edge[BINS_MAX + 1];
} floor_t;

// Fits the ends of a patch along x (else y), by the rows that are inside it along the other axis: whole
// strips take in much that lies beside what is there. The patch stays at least as wide as a strip, because a
// hover's half millimetre is no place. False: the ends stay.
static bool fit_ends(floor_t *f, int ch, bool along_x, patch_t *at) {
  const rows_t *const r = &f->l->s->smooth;
  const int *const own = along_x ? f->x : f->y, *const other = along_x ? f->y : f->x;
  const int low = along_x ? at->y : at->x, high = along_x ? at->y_to : at->x_to, bins = STRIPS * f->parts;
  window_t best = {.statistic = at->statistic};
  for (int i = 0; i < r->n; i++) f->bin[i] = other[i] >= low && other[i] <= high ? own[i] : bins;
  add_products(&f->p, bins + 1, r, &f->l->color[ch], f->l->residual[ch], f->bin);
  if (!best_window(&f->p, f->l->centred, bins, f->parts, MOST * f->parts, &best)) return false;
  *(along_x ? &at->x : &at->y) = best.from;
  *(along_x ? &at->x_to : &at->y_to) = best.to;
  at->size = best.size;
  at->statistic = best.statistic;
  return true;
}

static cell_t cell_of(const floor_t *f, int ch, const patch_t *at) {
  return (cell_t){.channel = ch,
                  .along = COORDINATE_X,
                  .coordinate = coordinate_name(COORDINATE_X),
                  .unit = coordinate_unit(COORDINATE_X),
                  .from = f->x_edge[at->x],
                  .to = f->x_edge[at->x_to + 1],
                  .size = at->size,
                  .statistic = at->statistic,
                  .explained = at->statistic * at->statistic,
                  .last = at->x_to + 1 == STRIPS * f->parts,
                  .is_patch = true,
                  .y_from_m = f->y_edge[at->y],
                  .y_to_m = f->y_edge[at->y_to + 1]};
}

static void look_at_floor(floor_t *f, int ch, cell_t *cell) {
  const rows_t *const r = &f->l->s->smooth;
  for (int i = 0; i < r->n; i++) f->bin[i] = f->x[i] / f->parts * STRIPS + f->y[i] / f->parts;
  add_products(&f->p, STRIPS * STRIPS, r, &f->l->color[ch], f->l->residual[ch], f->bin);
  patch_t at = best_of_strips(&f->p, f->l->centred);
  if (!(at.statistic > 0.0)) return;
  at.x *= f->parts, at.x_to = (at.x_to + 1) * f->parts - 1;
  at.y *= f->parts, at.y_to = (at.y_to + 1) * f->parts - 1;
  for (bool moved = true; moved;) { // each time the statistic grows
    const bool along_x = fit_ends(f, ch, true, &at);
    moved = fit_ends(f, ch, false, &at) || along_x;
  }
  if (at.statistic > cell->statistic) *cell = cell_of(f, ch, &at);
}

void windows_on_floor(const look_t *l, cell_t cell[LOOKED]) {
  const int n = l->s->smooth.n;
  const int enough = n / (WINDOW_ROWS * STRIPS);
  floor_t f;
  f.l = l;
  f.x = l->bin;
  f.y = f.x + n;
  f.bin = f.y + n;
  f.parts = enough < PARTS ? enough : PARTS;
  const int bins = STRIPS * f.parts;
  if (bins < 1 || !windows_cut(l->s, l->m, COORDINATE_X, 0, bins, BY_ROWS, l->room, f.x, f.x_edge) ||
      !windows_cut(l->s, l->m, COORDINATE_Y, 0, bins, BY_ROWS, l->room, f.y, f.y_edge))
    return;
  for (int k = 0; k < LOOKED_SMOOTH; k++) {
    const int ch = look_channel(0, k);
    if (l->color[ch].used) look_at_floor(&f, ch, &cell[ch]);
  }
}

// --- from flight to flight ---------------------------------------------------------------------------------

void windows_by_flight(const look_t *l, cell_t cell[LOOKED]) {
  for (int ch = 0; ch < CHANNELS; ch++) {
    const rows_t *const r = set_rows(l->s, ch);
    if (!l->color[ch].used) continue;
    color_whiten(&l->color[ch], r, l->residual[ch], l->room);
    const color_differ_t d = color_differ(&l->color[ch], r, l->room);
    const double beyond = fmax(d.q - (d.flights - 1), 0.0); // noise alone gives flights - 1
    if (d.flights < 2 || !(d.q > cell[ch].statistic * cell[ch].statistic)) continue;
    cell[ch] = (cell_t){.channel = ch,
                        .along = BY_FLIGHT,
                        .coordinate = "flight",
                        .unit = "",
                        .from = 1.0,
                        .to = l->s->n_grid,
                        .flights = d.flights,
                        .size = sqrt(beyond / (d.holds - d.holds_squared / d.holds)),
                        .statistic = sqrt(d.q),
                        .explained = beyond,
                        .first = true,
                        .last = true};
  }
}
