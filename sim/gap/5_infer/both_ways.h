// both_ways.h - whether a scale of the turning is there, or commands that the log misses look like it.
//
// J (1 + k) turns by 1 / (1 + k) of what is predicted with J. A log with fewer rows than attitude control
// gives commands predicts the turning with an error, and least squares of measured by predicted then give too
// small a slope: 1 + k too large. Of predicted by measured they give 1 + k itself, or too little where what
// is measured has an error, too. The truth lies between the two (Frisch 1934, bounds of a line with errors in
// both). What a moment that control cancels adds to the predicted is such an error, and predicted by measured
// does not see it.
//
// Rows are white in the colour of what predicted by measured leaves: a manoeuvre is slow, and where nothing
// slow is left beside it all of it counts.
#ifndef SIM_GAP_5_INFER_BOTH_WAYS_H
#define SIM_GAP_5_INFER_BOTH_WAYS_H

#include "gap/5_infer/found.h"

// Sums of squares and products of rows about their mean: measured, predicted, both.
typedef struct {
  double yy, pp, yp;
} slope_t;

// Of white rows; slow: of the same as they are, in which slow turning counts most.
typedef struct {
  double yy, pp, yp;
  int n;
  slope_t slow;
  bool apart; // slow and fast turning say different numbers
} both_t;

// residual: measured less predicted, by row of one axis; typical: of a scale. left, room: as many numbers,
// overwritten. n 0: there is no colour to be found.
//
// Slow and fast turning are scaled by one number where their intervals meet, within their errors and the
// least part of what is typical that is named; else they are apart. A log that goes in step with an outer
// loop misses the same commands in each of its rows: what it has of them is no error beside the right ones,
// but another multiple of them at each frequency.
both_t both_ways_of(const rows_t *r, const double *measured, const double *residual, double typical,
                    double *left, double *room);

// Where in that interval the truth lies nobody knows: half of its length is an error like the standard one.
// Returns its lower end where that is beyond two of both errors above 0; else 0.
double both_ways_least(const both_t *b);

// The same of a k that is named, with its standard error; 0 also where k is nearer to 0 than that end. Of a k
// below 0 it is the upper end, and all that does not go with each other counts for an error: so much may come
// of a gyro's noise v that is fed back against it, which seems to turn the vehicle more than commands do. Of
// y = s + v and p = s - c v, c >= 0, predicted by measured says k = -(1 + c) v / (s + v), in squares, and
// that part is never less; measured by predicted says no k below 0. Of noise that comes back with its own
// sign nothing here is proof: nominal flights show how much of that there is.
double both_ways_agree(const both_t *b, double k, double stderr_);

// What is told of an axis, as an inertia.
typedef struct {
  double k, stderr_;
} scaled_t;

// About one axis at least both ways say what is told, and about none for which something is surely told slow
// turning says another number than fast.
bool both_ways_stand(const both_t about[3], const scaled_t told[3]);

// named: chosen, of this effect, which scales the turning (fx->scales). stands: both_ways_stand. FAILED: no
// memory. BAD_INPUT: too many effects.
MUST_CHECK done_t both_ways(set_t *s, const model_t *base, const chosen_t *chosen, const fx_t *fx,
                            const named_t *named, bool *stands, why_t *why);

// Takes into a choice that has none an inertia that is larger, by what both ways say about each axis of what
// the choice leaves, if they say it of one. FAILED, BAD_INPUT: as above.
MUST_CHECK done_t both_ways_take(chosen_t *chosen, const candidates_t *c, set_t *s, const model_t *base,
                                 why_t *why);

#endif
