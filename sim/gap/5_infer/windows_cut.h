// windows_cut.h - the bins of windows.h, and a window's estimate. Within sim/gap/5_infer only.
#ifndef SIM_GAP_5_INFER_WINDOWS_CUT_H
#define SIM_GAP_5_INFER_WINDOWS_CUT_H

#include "gap/5_infer/windows.h"

// Bins of equally many rows each, or of equal width; so many along a coordinate.
typedef enum { BY_ROWS, BY_WIDTH, CUTS } cut_t;
extern const int windows_cut_in[CUTS];

// A list's rows: 0: smooth, 1: range.
static inline const rows_t *windows_rows(const set_t *s, int list) {
  return list ? &s->range : &s->smooth;
}

// As windows_bins(), of any number of bins, and their edges (bins + 1).
bool windows_cut(const set_t *s, const model_t *m, int coordinate, int list, int bins, cut_t cut,
                 double *room, int *bin, double *edge);

// Sums over the bins of a window: of the residual, of the window's own indicator, and of that and a constant.
typedef struct {
  double y, own, cross;
} window_sums_t;

// The estimate and its distance from zero. all: of the constant, y and own. False: no row tells it from a
// constant.
static inline bool windows_judge(const window_sums_t *all, bool centred, const window_sums_t *w, double *size,
                                 double *statistic) {
  if (!(all->own > 0.0)) return false;
  const double share = centred ? w->cross / all->own : 0.0;
  const double y = w->y - share * all->y, own = w->own - share * w->cross;
  if (!(own > 1e-3 * w->own)) return false;
  *size = y / own;
  *statistic = fabs(y) / sqrt(own);
  return true;
}

typedef struct {
  int from, to; // bins, both ends inside
  double size, statistic;
} window_t;

#endif
