// beyond_control.h - whether a first look, without nominal flights, may take a name that control's work on a
// disturbance looks like.
//
// Such control commands what does not turn the vehicle: a larger inertia does, and a smaller torque
// (fx->control_makes).
#ifndef SIM_GAP_5_INFER_BEYOND_CONTROL_H
#define SIM_GAP_5_INFER_BEYOND_CONTROL_H

#include "gap/5_infer/round.h"

// Of the last candidate of the choice, of which `v` is what it is worth there; chosen: its columns are those
// of its numbers. With nominal flights true: they show what control makes (score_allows).
bool beyond_control(const round_t *r, const choice_t *choice, const verdict_t *v, bool chosen);

#endif
