// 7_verify.h - flights that were not fitted to, before and after.
#ifndef SIM_GAP_VERIFY_H
#define SIM_GAP_VERIFY_H

#include "gap/diagnose.h"

// ST_FAILED: no memory.
MUST_CHECK status_t verify_held(set_t *s, const model_t *before, const model_t *after,
                                const nominal_t *nominal, held_t *held, why_t *why);

// White sum of squares that a model leaves, in the colours of another one's residual.
MUST_CHECK status_t verify_left(set_t *s, const model_t *m, const color_t color[CHANNELS], double *left,
                                why_t *why);

#endif
