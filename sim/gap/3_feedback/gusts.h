// gusts.h - splits a force's residual into noise of the moment and forces that last for a while.
//
// What something without a name leaves at a place, in a state or from a time on is no gust. So the residual
// is cut into stretches of 4 s, each about its own mean, and only the quieter half of them counts. That takes
// much of a gust of a second away, too. Therefore white sensor noise and first-order Gauss-Markov forces of
// known correlation time are turned into rows along the log's own points, as the residual is, and treated
// alike. The log's covariances from row to row are fitted with theirs.
#ifndef SIM_GAP_3_FEEDBACK_GUSTS_H
#define SIM_GAP_3_FEEDBACK_GUSTS_H

#include "gap/2_predict/set.h"

// s, correlation time of quick forces. Changes from row to row beyond the noise of two accelerometer samples
// may be noise that the accelerometer filters, or a force between the rows. They are taken for a force that
// lasts one row, which shakes the pilot, too; where the acceleration is made of velocities, for noise of
// these.
#define GUST_QUICK_S (1.0 / RESIDUAL_HZ)

// Sd by axis; 0 where the log has no force.
typedef struct {
  double force_mps2[CH_FORCES], tau_s; // lasting forces, and their correlation time: 0.04 to 0.64 s
  double quick_mps2[CH_FORCES];        // forces that last for GUST_QUICK_S
  double velocity_mps[CH_FORCES];      // noise of a velocity sample, beyond `white`
} gusts_t;

// Finds the gusts in a residual (by channel and row). white: noise of a sample, m/s2, or m/s where the
// acceleration is made of velocities. FAILED: no memory.
MUST_CHECK done_t gusts_of(const set_t *s, double *const residual[CHANNELS], const double white[CH_FORCES],
                           unsigned long seed, gusts_t *to, why_t *why);

#endif
