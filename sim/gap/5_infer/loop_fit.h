// loop_fit.h - noise and disturbance with which nominal flights shake as the log does.
#ifndef SIM_GAP_5_INFER_LOOP_FIT_H
#define SIM_GAP_5_INFER_LOOP_FIT_H

#include "gap/3_feedback/nominal.h"

// m: the model with what a first look has named, so that its residual is noise. What is read off the log
// (closed_loop_of, of a residual without what lies at a place, in a state or at a time) is read off flights
// in which it is known, too, and the disturbance scaled by what comes out of it there. Where the model
// cannot be flown nothing is scaled. Before, what turns it is matched (closed_loop_match). FAILED: no memory.
MUST_CHECK done_t loop_fit(closed_loop_t *loop, set_t *s, const model_t *m, const flown_by_t *by,
                           unsigned long seed, why_t *why);

#endif
