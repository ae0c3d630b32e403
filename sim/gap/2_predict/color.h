// color.h - an autoregression of second order per channel: e_t = (y_t - a1 y_{t-1} - a2 y_{t-2}) / sd is
// white.
#ifndef SIM_GAP_2_PREDICT_COLOR_H
#define SIM_GAP_2_PREDICT_COLOR_H

#include "gap/2_predict/set.h"

typedef struct {
  double a1, a2, sd;
  bool used; // the channel has rows enough
} color_t;

// Colour of rows that v leaves of a channel.
color_t color_fit(const rows_t *r, const double *v);

// The white rows of v, in place of out (as many as rows; 0 where a row has no two before it).
void color_whiten(const color_t *color, const rows_t *r, const double *v, double *out);
static inline bool color_reaches(const rows_t *r, int row) { // it has two before it
  return row >= 2 && r->follows[row] && r->follows[row - 1];
}
// Spread alone, no colour.
color_t color_plain(const rows_t *r, const double *v);

// White sum of squares of a channel's residual v, by row.
double color_left(const rows_t *r, const color_t *c, const double *v);

#endif
