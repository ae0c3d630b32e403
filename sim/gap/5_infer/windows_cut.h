// windows_cut.h - the bins that a coordinate is cut into, and the estimate in a window of them (windows.h).
#ifndef SIM_GAP_5_INFER_WINDOWS_CUT_H
#define SIM_GAP_5_INFER_WINDOWS_CUT_H

#include "gap/2_predict/color.h"
#include "gap/5_infer/coordinates.h"
#include <math.h>

// Bins of equally many rows that a coordinate is cut into: of a minute five seconds each.
#define WINDOW_BINS 12

// A coordinate is cut twice, and all windows of up to half its bins are looked at: of equally many rows, and
// of equal width, for a layer may be thin.
enum {
  WINDOW_FINE = 3 * WINDOW_BINS,
  WINDOWS_TRIED = WINDOW_BINS * (3 * WINDOW_BINS + 2) / 8 + WINDOW_FINE * (3 * WINDOW_FINE + 2) / 8
};

// Rows of a bin, on the average, or nothing is said: as many make a white one.
enum { WINDOW_ROWS = 3 };

// Keeps the bins of all rows along all coordinates, the thrust that of this model, whatever model a look is
// given. Without it they are found anew each time. FAILED: no memory.
MUST_CHECK done_t windows_keep(set_t *s, const model_t *m, why_t *why);

// The bin of every row of a list (0: smooth, 1: range) along a coordinate. False: it is not there or does not
// move.
bool windows_bins(const set_t *s, const model_t *m, int coordinate, int list, double *room, int *bin);

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
