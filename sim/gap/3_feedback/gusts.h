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

// What changes more from row to row than two samples of an accelerometer differ by may be noise that it
// filters, or a force between the rows: it is taken for a force that lasts for a row, which shakes who flies,
// too. Of accelerations that are made of velocities it is noise of these.
#define GUST_QUICK_S (1.0 / RESIDUAL_HZ)

// Sd by axis; 0 where the log has no force.
typedef struct {
  double force_mps2[CH_FORCES], tau_s; // what lasts, and its correlation time: 0.04 to 0.64
  double quick_mps2[CH_FORCES];        // what lasts for GUST_QUICK_S
  double velocity_mps[CH_FORCES];      // of a sample, beside `white`
} gusts_t;

// residual: by channel and row. white: noise of a sample, m/s2, or m/s where the acceleration is made of
// velocities. FAILED: no memory.
MUST_CHECK done_t gusts_of(const set_t *s, double *const residual[CHANNELS], const double white[CH_FORCES],
                           unsigned long seed, gusts_t *to, why_t *why);

#endif
