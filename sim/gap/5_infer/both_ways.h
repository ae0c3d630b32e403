// both_ways.h - whether the turning has another scale, or commands that the log misses only look like it.
//
// A vehicle of inertia J (1 + k) turns by 1 / (1 + k) of what is predicted with J. A log with fewer rows than
// attitude control gives commands predicts the turning with an error. A regression of measured on predicted
// then gives too small a slope, so 1 + k comes out too large. Predicted on measured gives 1 + k itself, or
// too little where the measurement has an error, too. The truth lies between the two (Frisch 1934, bounds of
// a line with errors in both variables). A moment that control cancels adds such an error to the prediction;
// it does not bias predicted on measured.
//
// Rows are whitened by the colour of the residual of predicted on measured. A manoeuvre is slow, and counts
// in full where no slow residual is left beside it.
#ifndef SIM_GAP_5_INFER_BOTH_WAYS_H
#define SIM_GAP_5_INFER_BOTH_WAYS_H

#include "gap/5_infer/found.h"

// Sums over rows, about their mean: squares of measured and of predicted, and products of both.
typedef struct {
  double yy, pp, yp;
} slope_t;

// The sums of whitened rows. slow: those of the same rows not whitened, in which slow turning counts most.
typedef struct {
  double yy, pp, yp;
  int n;
  slope_t slow;
  bool apart; // slow and fast turning have different scales
} both_t;

// Returns the sums of one axis; n is 0 where no colour can be fitted. residual: measured less predicted, by
// row. typical: size of a scale. left, room: as many numbers, overwritten.
//
// Slow and fast turning have one scale if their intervals overlap, within their errors and the least size
// that is named; else they are apart. A log in step with an outer loop misses the same commands in each row:
// what it has is not the right commands with an error, but another multiple of them at each frequency.
both_t both_ways_of(const rows_t *r, const double *measured, const double *residual, double typical,
                    double *left, double *room);

// Returns the lower end of the interval if that is more than two errors above 0 and slow and fast turning are
// not apart; else 0. Nobody knows where in the interval the truth lies, so half of its length is an error
// beside the standard error.
double both_ways_least(const both_t *b);

// The same for a named k, with its standard error; 0 also where k is nearer to 0 than that end by more than
// two errors, of which the misfit of linear columns is one. For k below 0 it is the upper end, and the whole
// uncorrelated part of the two counts as an error: gyro noise v that control feeds back against itself can
// make that much, and seems to turn the vehicle more than commands do. With y = s + v and p = s - c v, where
// c is not negative, predicted on measured gives
//   k = -(1 + c) v^2 / (s^2 + v^2),
// and that part is never less than |k|; measured on predicted gives no k below 0.
// Noise fed back with its own sign is not excluded here: nominal flights show how much there is.
double both_ways_agree(const both_t *b, double k, double stderr_);

// What is named for an axis, as an inertia J (1 + k).
typedef struct {
  double k, stderr_;
} scaled_t;

// True if both regressions agree with the named k about at least one axis, and slow and fast turning are
// apart about none whose k is surely not 0.
bool both_ways_stand(const both_t about[3], const scaled_t told[3]);

// Sets *stands (both_ways_stand) for a chosen name of the effect fx, which scales the turning (fx->scales).
// FAILED: no memory. BAD_INPUT: too many effects.
MUST_CHECK done_t both_ways(set_t *s, const model_t *base, const chosen_t *chosen, const fx_t *fx,
                            const named_t *named, bool *stands, why_t *why);

// Adds a larger inertia to a choice that has none, if both regressions of what the choice leaves show it
// about at least one axis; sizes are those of both_ways_least(). FAILED, BAD_INPUT: as above.
MUST_CHECK done_t both_ways_take(chosen_t *chosen, const candidates_t *c, set_t *s, const model_t *base,
                                 why_t *why);

#endif
