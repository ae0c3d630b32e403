// windows_cut.h - the bins that a coordinate is cut into, and the estimate in a window of them (windows.h).
#ifndef SIM_GAP_5_INFER_WINDOWS_CUT_H
#define SIM_GAP_5_INFER_WINDOWS_CUT_H

#include "gap/2_predict/color.h"
#include "gap/5_infer/coordinates.h"
#include <math.h>

// Bins of equally many rows that a coordinate is cut into: in a minute, five seconds each.
#define WINDOW_BINS 12

// A coordinate is cut twice: into bins of equally many rows and, because a layer may be thin, into bins of
// equal width. All windows of up to half of the bins are tried.
enum {
  WINDOW_FINE = 3 * WINDOW_BINS,
  WINDOWS_TRIED = WINDOW_BINS * (3 * WINDOW_BINS + 2) / 8 + WINDOW_FINE * (3 * WINDOW_FINE + 2) / 8
};

// Rows that a bin must have on average, else nothing is said: a white row is made of as many.
enum { WINDOW_ROWS = 3 };

// Keeps the bins of all rows along all coordinates; the thrust is that of this model, whatever model a look
// is given. Without this they are found anew each time. FAILED: no memory.
MUST_CHECK done_t windows_keep(set_t *s, const model_t *m, why_t *why);

// Sets the bin of every row of a list (0: smooth, 1: range) along a coordinate. room: two numbers for each
// row. False: it is not there or does not vary, or rows are too few.
bool windows_bins(const set_t *s, const model_t *m, int coordinate, int list, double *room, int *bin);

// Bins of equally many rows each, or of equal width; and how many of either kind.
typedef enum { BY_ROWS, BY_WIDTH, CUTS } cut_t;
extern const int windows_cut_in[CUTS];

// Returns the rows of a list (0: smooth, 1: range).
static inline const rows_t *windows_rows(const set_t *s, int list) {
  return list ? &s->range : &s->smooth;
}

// As windows_bins(), for any number of bins of either cut; also sets the edges (bins + 1).
bool windows_cut(const set_t *s, const model_t *m, int coordinate, int list, int bins, cut_t cut,
                 double *room, int *bin, double *edge);

// Sums of products over a window: of its indicator with the residual, with itself, and with a constant.
typedef struct {
  double y, own, cross;
} window_sums_t;

// Sets the estimate of a constant in the window, and its distance from zero in standard errors. all: y and
// own of the constant over all rows. False: no row tells the two apart.
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
