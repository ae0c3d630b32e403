// loop_fit.h - fits noise and disturbances with which nominal flights shake as the log does.
#ifndef SIM_GAP_5_INFER_LOOP_FIT_H
#define SIM_GAP_5_INFER_LOOP_FIT_H

#include "gap/3_feedback/nominal.h"

// Finds how nominal flights are flown and disturbed. Pilot and noise (closed_loop_of) and disturbing forces
// (gusts.h) are read off the log. What is left of disturbing moments depends on control: the pilot's gains
// are matched (closed_loop_match), flights with known moments are flown, and the moments are scaled so that
// these leave what the log leaves. Where the model cannot be flown nothing is scaled. m: the model with what
// a first look has named, so that its residual is noise. FAILED: no memory.
MUST_CHECK done_t loop_fit(closed_loop_t *loop, set_t *s, const model_t *m, const flown_by_t *by,
                           unsigned long seed, why_t *why);

#endif
