// lift.h - what a flight's own constant is multiplied by, row by row.
//
// Another weight, another place of it, rotors that give less, an accelerometer that stands askew: most of
// what flights differ by goes with the lift. Were it constant, what is left of it where the lift varies would
// be taken by a bend in the curve of the thrust.
#ifndef SIM_GAP_2_PREDICT_LIFT_H
#define SIM_GAP_2_PREDICT_LIFT_H

#include "gap/2_predict/set.h"

// Of the smooth rows of flights that are several, or that are held against several: the lift that the model
// predicts, over its mean (rows_t.lift). FAILED: no memory.
MUST_CHECK done_t lift_find(set_t *s, const model_t *m, why_t *why);

#endif
