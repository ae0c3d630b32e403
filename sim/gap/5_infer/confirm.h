// confirm.h - estimates the names again after the selection, with the reference trajectory as instrument.
//
// Feedback correlates disturbances with states and commands, and noise of the states attenuates what depends
// on them: both bias least squares. The set points depend on neither. So the pilot of the nominal flights
// flies the model along the logged set points, without noise or disturbance. What each name adds there (its
// columns, through the same 8 Hz filter, at three lags) depends on the reference alone, and serves as
// instrument of two-stage least squares (lsq_instrument.h). The instrumented fit uses velocities as logged;
// the least squares that it is compared with uses smoothed ones, as the selection did.
#ifndef SIM_GAP_5_INFER_CONFIRM_H
#define SIM_GAP_5_INFER_CONFIRM_H

#include "gap/5_infer/found.h"

// True if feedback made the name: the instrument is strong enough, does not confirm the name, and disagrees
// with least squares.
static inline bool confirm_refutes(const confirm_t *a) {
  return a->answer == CONFIRM_NO && a->apart;
}

// Sets found->named[].confirm; names and their values stay. Nothing changes unless all logs have set points
// and the model can be flown along them. If it cannot, *why_not gives the reason, else it is null. FAILED: no
// memory.
MUST_CHECK done_t confirm_names(const candidates_t *c, set_t *s, const model_t *base,
                                const closed_loop_t *loop, found_t *found, const char **why_not, why_t *why);

#endif
