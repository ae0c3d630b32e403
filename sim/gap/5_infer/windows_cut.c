// windows_cut.c - the bins that a coordinate is cut into.
#include "gap/5_infer/windows_cut.h"

#include "base/nth.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- bins -------------------------------------------------------------------------------------------------

// Sets the bin of every row, and the edges (bins + 1). False: the coordinate is not there or does not vary.
static bool cut_bins(const double *value, int n, int bins, cut_t cut, double *parted, int *bin,
                     double *edge) {
  for (int i = 0; i < n; i++) {
    if (isnan(value[i])) return false;
    parted[i] = value[i];
  }
  for (int k = 0, from = 0; k <= bins; k++) {
    if (cut == BY_WIDTH && k > 1 && k < bins - 1) continue; // these follow from the others
    const int at = (int)((double)k * (n - 1) / bins);
    edge[k] = nth_smallest(parted + from, n - from, at - from);
    from = at;
  }
  if (!(edge[bins] - edge[0] > 1e-9)) return false;
  // Bins of equal width between edges 1 and bins - 1: a row far out gets no bin of its own.
  const double low = edge[1], high = edge[bins - 1];
  for (int k = 1; cut == BY_WIDTH && k < bins; k++) edge[k] = low + (k - 1) * (high - low) / (bins - 2);
  for (int i = 0; i < n; i++) {
    int k = 0;
    while (k < bins - 1 && value[i] >= edge[k + 1]) k++;
    bin[i] = k;
  }
  return true;
}

static bool find_bins(const set_t *s, const model_t *m, int coordinate, int list, int bins, cut_t cut,
                      double *room, int *bin, double *edge) {
  const rows_t *r = windows_rows(s, list);
  if (r->n < WINDOW_ROWS * bins) return false;
  for (int i = 0; i < r->n; i++) room[i] = coordinate_of(coordinate, &s->grid[r->flight[i]], m, r->point[i]);
  return cut_bins(room, r->n, bins, cut, room + r->n, bin, edge);
}

// --- kept -------------------------------------------------------------------------------------------------

const int windows_cut_in[CUTS] = {[BY_ROWS] = WINDOW_BINS, [BY_WIDTH] = WINDOW_FINE};

typedef struct {
  bool there;
  double edge[WINDOW_FINE + 1];
  unsigned char *bin;
} kept_t;

struct cuts {
  kept_t of[COORDINATES][2][CUTS];
  unsigned char room[];
};

done_t windows_keep(set_t *s, const model_t *m, why_t *why) {
  const lag_t lag = model_lag(m, 0.0); // the thrust is a coordinate, as in the model's first replay
  for (int i = 0; i < s->n_grid; i++)
    if (!grid_motors(&s->grid[i], &lag, m->frame.motor_delay_s)) return error_failed(why, "out of memory");
  const size_t rows = (size_t)s->smooth.n + (size_t)s->range.n, most = set_most_rows(s);
  s->cuts = malloc(sizeof *s->cuts + COORDINATES * CUTS * rows);
  double *const room = malloc(2 * most * sizeof(double));
  int *const bin = malloc(most * sizeof(int));
  unsigned char *to = s->cuts ? s->cuts->room : NULL;
  for (int i = 0; s->cuts && room && bin && i < COORDINATES * 2 * CUTS; i++) {
    const int list = i / CUTS % 2, n = windows_rows(s, list)->n;
    kept_t *const k = &s->cuts->of[i / CUTS / 2][list][i % CUTS];
    k->there =
        find_bins(s, m, i / CUTS / 2, list, windows_cut_in[i % CUTS], (cut_t)(i % CUTS), room, bin, k->edge);
    k->bin = to;
    for (int r = 0; k->there && r < n; r++) to[r] = (unsigned char)bin[r];
    to += n;
  }
  const bool good = s->cuts && room && bin;
  free(room);
  free(bin);
  return good ? DONE : error_failed(why, "out of memory");
}

bool windows_cut(const set_t *s, const model_t *m, int coordinate, int list, int bins, cut_t cut,
                 double *room, int *bin, double *edge) {
  if (!s->cuts || bins != windows_cut_in[cut])
    return find_bins(s, m, coordinate, list, bins, cut, room, bin, edge);
  const kept_t *const k = &s->cuts->of[coordinate][list][cut];
  for (int i = 0; k->there && i < windows_rows(s, list)->n; i++) bin[i] = k->bin[i];
  memcpy(edge, k->edge, ((size_t)bins + 1) * sizeof(double));
  return k->there;
}

bool windows_bins(const set_t *s, const model_t *m, int coordinate, int list, double *room, int *bin) {
  double edge[WINDOW_BINS + 1];
  return windows_cut(s, m, coordinate, list, WINDOW_BINS, BY_ROWS, room, bin, edge);
}
