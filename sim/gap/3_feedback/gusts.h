// gusts.h - what of a force's residual is noise of the moment, and what is a force that lasts for a while.
//
// What something without a name leaves at a place, in a state or from a time on is no gust. So the residual
// is looked at in stretches of 4 s, each about its own mean, and of these at the quieter half. A gust of a
// second has lost much there: white noise of the sensor, and first-order Gauss-Markov forces of known
// correlation time, are made to rows along the log's own points as the residual is, and looked at alike. The
// log's covariances from row to row are fitted with theirs.
#ifndef SIM_GAP_3_FEEDBACK_GUSTS_H
#define SIM_GAP_3_FEEDBACK_GUSTS_H

#include "gap/2_predict/set.h"

typedef struct {
  double force_mps2[CH_FORCES]; // sd of what lasts; 0 where the log has no force
  double tau_s;                 // its correlation time: 0.04 to 0.64
  double white[CH_FORCES];      // sd of a sample: m/s2; m/s where the acceleration is made of velocities
} gusts_t;

// residual: by channel and row. FAILED: no memory.
MUST_CHECK done_t gusts_of(const set_t *s, double *const residual[CHANNELS], unsigned long seed, gusts_t *to,
                           why_t *why);

#endif
