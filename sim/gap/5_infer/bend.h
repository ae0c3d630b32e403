// bend.h - shape and size of an effect estimated together: their nominal errors, and the best shape.
//
// Errors of the logged height make a ground effect look smaller and flatter than it is. With a decay of 48
// 1/m, errors of 8 mm take a fifth of the size if the decay is known, and half of it if the decay is
// estimated, too. Whether there is a name at all (score_allows) is judged with the shape known.
#ifndef SIM_GAP_5_INFER_BEND_H
#define SIM_GAP_5_INFER_BEND_H

#include "gap/5_infer/score.h"

typedef struct {
  double size[FX_SIZE_MAX]; // rms, bias included, in the sizes' units
  double shape;             // rms over the shape, dimensionless
} bend_t;

// Sets *bend for the last candidate of a choice, whose sizes are `value`. The derivative by the logarithm of
// the shape is that of the parabola through its columns at the neighbouring shapes. False, and *bend 0: it
// has no such neighbours, or no nominal flight was flown.
bool bend_nominal(const score_t *j, const choice_t *choice, const double value[FX_SIZE_MAX], bend_t *bend);

// Returns the shape with which candidate `own` leaves least beside a choice, by columns interpolated between
// those of its neighbours (the same parabola), at most the share `reach` of the way to them. Returns its own
// shape if none leaves less by SELECT_GAIN. What a wrong shape leaves looks like another effect: of a sag
// about a wrong voltage, like a mass.
double bend_best(const score_t *j, const choice_t *beside, int own, double reach);

#endif
