// color.h - an autoregression of second order per channel: e_t = (y_t - a1 y_{t-1} - a2 y_{t-2}) / sd is
// white; and a constant of each flight's own (times the lift, lift.h), as batteries and sensors have that are
// fitted anew, of which white rows have no more than their noise (Fuller and Battese 1974).
#ifndef SIM_GAP_2_PREDICT_COLOR_H
#define SIM_GAP_2_PREDICT_COLOR_H

#include "gap/2_predict/set.h"

typedef struct {
  double a1, a2, sd;
  double between; // sd of what flights differ by, each by a constant
  bool used;      // the channel has rows enough
} color_t;

// Colour of rows that v leaves of a channel.
color_t color_fit(const rows_t *r, const double *v);

// A constant (times the lift), white: what it is in a white row.
double color_one(const color_t *color, const rows_t *r, int row);

// What a flight's white rows, row `from` on, hold of a constant (its information h: 1 over the variance of
// its estimate), and that estimate.
typedef struct {
  int end; // the next flight's first row
  double holds, mean;
} color_constant_t;

color_constant_t color_constant(const color_t *color, const rows_t *r, int from, const double *white);

// The flights' constants about the mean of all. q: Cochran's, in standard errors, squared: as many as flights
// but one where there is noise alone.
typedef struct {
  int flights;
  double q, holds, holds_squared, mean;
} color_differ_t;

color_differ_t color_differ(const color_t *color, const rows_t *r, const double *white);
// What they differ by beyond noise, sd (DerSimonian and Laird 1986); of two or three flights it is known
// badly, and 0 where they agree by chance. room: as many as rows.
double color_between(const color_t *color, const rows_t *r, const double *v, double *room);

// Colour of what v is but for each flight's own constant, and the spread of these; room: as many as rows.
color_t color_of_flights(const rows_t *r, const double *v, double *room);

// The white rows of v, in place of out (as many as rows; 0 where a row has no two before it): less
// (1 - 1/sqrt(1 + between^2 h)) of each flight's constant.
void color_whiten(const color_t *color, const rows_t *r, const double *v, double *out);
static inline bool color_reaches(const rows_t *r, int row) { // it has two before it
  return row >= 2 && r->follows[row] && r->follows[row - 1];
}
// Spread alone, no colour.
color_t color_plain(const rows_t *r, const double *v);

// White sum of squares of a channel's residual v, by row.
double color_left(const rows_t *r, const color_t *c, const double *v);

#endif
