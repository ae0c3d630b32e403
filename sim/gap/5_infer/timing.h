// timing.h - before the selection: finds a lag or delay that is too long for a straight line, or that
// measured rotor speeds show directly, without the body in between, where the log has every command.
#ifndef SIM_GAP_5_INFER_TIMING_H
#define SIM_GAP_5_INFER_TIMING_H

#include "gap/4_candidates/candidates.h"

typedef struct {
  bool measured;      // by rotor speeds: nothing else may change it then
  int candidate;      // below 0: none
  double value_s;     // of its one size
  double stderr_s, p; // only where it is measured
} timing_t;

// Finds the lag or delay, if there is one. FAILED: no memory.
MUST_CHECK done_t timing_find(timing_t *found, const candidates_t *c, set_t *s, const model_t *m, why_t *why);

#endif
