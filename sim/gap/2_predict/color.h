// color.h - coloured noise of a channel, and random constants of flights.
//
// A second-order autoregression: e_t = (y_t - a1 y_{t-1} - a2 y_{t-2}) / sd is white. Batteries and sensors
// that are fitted anew give each flight a constant of its own (times the lift, lift.h), of which white rows
// keep no more than their noise (Fuller and Battese 1974).
#ifndef SIM_GAP_2_PREDICT_COLOR_H
#define SIM_GAP_2_PREDICT_COLOR_H

#include "gap/2_predict/set.h"

typedef struct {
  double a1, a2, sd;
  double between; // sd of the flights' constants
  bool used;      // the channel has enough rows
} color_t;

// Returns the autoregression of a channel's residual v, by row; `between` is 0.
color_t color_fit(const rows_t *r, const double *v);

// Returns what a constant of 1 (times the lift) is in a white row.
double color_one(const color_t *color, const rows_t *r, int row);

// A flight's constant, estimated from its white rows: the flight that begins with row `from`.
typedef struct {
  int end;            // the next flight's first row
  double holds, mean; // information h (1 over the variance of the estimate), and the estimate
} color_constant_t;

color_constant_t color_constant(const color_t *color, const rows_t *r, int from, const double *white);

// The flights' constants about their mean. q: Cochran's Q, their sum of squares in standard errors;
// of noise alone, about the number of flights less one. holds, holds_squared: sums of h and of h^2.
typedef struct {
  int flights;
  double q, holds, holds_squared, mean;
} color_differ_t;

color_differ_t color_differ(const color_t *color, const rows_t *r, const double *white);
// Returns the sd of the flights' constants beyond noise (DerSimonian and Laird 1986). Two or three flights
// tell it badly, and it is 0 where they agree by chance. room: as many numbers as rows.
double color_between(const color_t *color, const rows_t *r, const double *v, double *room);

// Returns the autoregression of v without the flights' constants, with their sd. room: as many as rows.
color_t color_of_flights(const rows_t *r, const double *v, double *room);

// Whitens v into out (as many as rows; 0 where a row does not have two before it), less
// (1 - 1/sqrt(1 + between^2 h)) of each flight's constant.
void color_whiten(const color_t *color, const rows_t *r, const double *v, double *out);
static inline bool color_reaches(const rows_t *r, int row) { // the row has two before it
  return row >= 2 && r->follows[row] && r->follows[row - 1];
}
// Returns the rms of v alone, without an autoregression.
color_t color_plain(const rows_t *r, const double *v);

// Returns the sum of squares of a channel's residual v after whitening.
double color_left(const rows_t *r, const color_t *c, const double *v);

#endif
