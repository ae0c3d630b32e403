// holds.h - corrects predictions of differences between two points for commands that hold.
//
// Turning (and an acceleration that is not logged) is measured as a difference between the points before and
// after, which is the mean over all holds between. Simpson's rule makes that mean from the model's thrusts at
// three instants, if they are smooth. But thrusts of rotors that follow within a row are steps, which then
// come half a row late. With slower rotors, the torque that spins them up still steps: a twenty-fifth of the
// turning about z with a lag of eleven rows.
#ifndef SIM_GAP_2_PREDICT_HOLDS_H
#define SIM_GAP_2_PREDICT_HOLDS_H

#include "gap/2_predict/grid.h"

// True if every command is logged, and holds until the next row.
bool holds_known(const grid_t *g);

// Fills later_N and later_rootNps of motors whose thrusts are known. hold_N: mean thrusts over the hold of
// every sample of the grid. shift: how many samples earlier a point takes them; fractional, below 0: later.
// False: no memory.
bool holds_fit(const grid_t *g, const four_t *hold_N, double shift, lagged_t *motors);

// Adds these corrections to the predicted channels that are differences. r: the vehicle at the first point;
// what effects change later is neglected: a sag of a tenth is only a tenth of a correction.
void holds_add(const grid_t *g, const rigid_t *r, const lagged_t *motors, double *const out[CHANNELS]);

#endif
