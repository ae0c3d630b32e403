// verify.h - flights that were not fitted to, before and after.
#ifndef SIM_GAP_7_VERIFY_VERIFY_H
#define SIM_GAP_7_VERIFY_VERIFY_H

#include "gap/diagnose.h"

// FAILED: no memory.
MUST_CHECK done_t verify_held(set_t *s, const model_t *before, const model_t *after, const nominal_t *nominal,
                              held_t *held, why_t *why);

// What a name may grow the held-out rms of any channel by, beside the other names, where it does not shrink
// the others by twice that (in logarithms). Not counted is what the errors of what multiplies the name, as
// velocities, make of a right one where the vehicle hardly moves: flights of the model along the held-out
// tracks tell it.
#define VERIFY_GROWS 1.05

// Withdraws the names that grow one by more, the worst first: they are no longer marked, nor found. The
// others keep their values: what these flights alone had would else go into them. FAILED: no memory.
MUST_CHECK done_t verify_names(diagnosis_t *d, const model_t *base, why_t *why);

// White sum of squares that a model leaves, in the colours of another one's residual.
MUST_CHECK done_t verify_left(set_t *s, const model_t *m, const color_t color[CHANNELS], double *left,
                              why_t *why);

#endif
