// holds.h - what commands that hold give a difference of two points, beyond what three instants show of it.
//
// Turning (and an acceleration that is not logged) is a difference over the points before and after, and sees
// the mean over all holds between. Of a model's thrusts at three instants Simpson's rule makes that mean, if
// they are smooth. Those of rotors that follow within a row are steps, and come half a row late; of slower
// ones what spins them up steps all the same: a twenty-fifth of the turning about z, of a lag of eleven rows.
#ifndef SIM_GAP_2_PREDICT_HOLDS_H
#define SIM_GAP_2_PREDICT_HOLDS_H

#include "gap/2_predict/grid.h"

// Every command is logged, and holds until the next row.
bool holds_known(const grid_t *g);

// later_N and later_rootNps of motors whose thrusts are known. hold_N: means over the hold of every sample of
// the grid, wanted `shift` samples before, a part of one too, or after where it is below 0. False: no memory.
bool holds_fit(const grid_t *g, const four_t *hold_N, double shift, lagged_t *motors);

// Adds what these do to what is predicted of the channels that are differences. r: the vehicle at the first
// point, whatever its effects make of it later: a sag of a tenth is a tenth of a correction.
void holds_add(const grid_t *g, const rigid_t *r, const lagged_t *motors, double *const out[CHANNELS]);

#endif
