// loop_fit.h - noise and disturbance with which nominal flights shake as the log does.
#ifndef SIM_GAP_5_INFER_LOOP_FIT_H
#define SIM_GAP_5_INFER_LOOP_FIT_H

#include "gap/3_feedback/nominal.h"

// m: the model with what a first look has named, so that its residual is noise. How it was flown is read off
// the log (closed_loop_of), and so are disturbing forces (gusts.h). What is left of disturbing moments hangs
// on control: it is read off flights in which they are known, too, and they are scaled by what comes out
// there. Where the model cannot be flown nothing is scaled. Before, what turns it is matched
// (closed_loop_match). FAILED: no memory.
MUST_CHECK done_t loop_fit(closed_loop_t *loop, set_t *s, const model_t *m, const flown_by_t *by,
                           unsigned long seed, why_t *why);

#endif
