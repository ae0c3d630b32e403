// bend.h - a shape and its size, estimated together: what nominal flights make of both.
//
// Errors of the logged height make a ground effect look smaller and flatter than it is: of a decay of 48 1/m
// errors of 8 mm take a fifth where the decay is known, and a half where it is estimated, too. Whether there
// is a name at all (score_allows) is judged with the shape known.
#ifndef SIM_GAP_5_INFER_BEND_H
#define SIM_GAP_5_INFER_BEND_H

#include "gap/5_infer/score.h"

typedef struct {
  double size[FX_SIZE_MAX]; // rms, in the sizes' units, bias and all
  double shape;             // rms over the shape, 1
} bend_t;

// Of the last candidate of a choice, whose sizes are `value`; the slope over its shape is that of the
// parabola through its columns at the neighbouring shapes, in the logarithm. false: it has none, or nothing
// was flown.
bool bend_nominal(const score_t *j, const choice_t *choice, const double value[FX_SIZE_MAX], bend_t *bend);

// The shape between those that are tried, at most so much of the way to the neighbours, with which a
// candidate leaves least beside a choice, by columns between the neighbours' (the same parabola); its own
// where none leaves less by as much as a name has to give. What a shape beside the right one leaves looks
// like another effect: of a sag about a wrong voltage like a mass.
double bend_best(const score_t *j, const choice_t *beside, int own, double reach);

#endif
