// holds.h - what commands that hold give a difference of two points, beyond what three instants show of it.
//
// Turning (and an acceleration that is not logged) is a difference over the points before and after, and sees
// the mean over all holds between. Of a model's thrusts at three instants Simpson's rule makes that mean, if
// they are smooth; those of rotors that follow within a row are steps, and come half a row late.
#ifndef SIM_GAP_2_PREDICT_HOLDS_H
#define SIM_GAP_2_PREDICT_HOLDS_H

#include "gap/2_predict/grid.h"

// Rotors with this lag change within a few rows, and every command is logged and holds.
bool holds_matter(const grid_t *g, const lag_t *lag);

// later_N of motors whose thrusts are known. hold_N: means over the hold of every sample, wanted `shift`
// samples before. room: n numbers.
void holds_fit(const grid_t *g, const four_t *hold_N, double shift, lagged_t *motors, double *room);

// Adds what later_N does, by mass, inertia and rotors of r, to what is predicted of the channels that are
// differences.
void holds_add(const grid_t *g, const rigid_t *r, const lagged_t *motors, double *const out[CHANNELS]);

#endif
