// confirm.h - after the selection: the names once more, with the reference trajectory as the
// instrument.
//
// Feedback makes what disturbs the vehicle correlate with its states and commands, and noise of the states
// weakens what depends on them: both bias least squares. What the controller was told depends on neither. The
// model is flown along the logs' set points, without noise and disturbance, by the pilot of the nominal
// flights; what each name adds there (its columns, through the same 8 Hz filter, at three lags) is a filter
// of the reference and of nothing else, and the instruments of two-stage least squares (lsq_instrument.h).
// These ask velocities as logged; what they are held against is found in smooth ones, as the names were.
#ifndef SIM_GAP_5_INFER_CONFIRM_H
#define SIM_GAP_5_INFER_CONFIRM_H

#include "gap/5_infer/found.h"

// The set points tell of it, as strongly as is needed, and they tell of something else than least squares:
// feedback made it.
static inline bool confirm_refutes(const confirm_t *a) {
  return a->answer == CONFIRM_NO && a->apart;
}

// Sets found->named[].confirm; nothing changes where no log has set points, or the model cannot be flown
// along them (*why_not says so, else it is null). Names and their values stay. FAILED: no memory.
MUST_CHECK done_t confirm_names(const candidates_t *c, set_t *s, const model_t *base,
                                const closed_loop_t *loop, found_t *found, const char **why_not, why_t *why);

#endif
