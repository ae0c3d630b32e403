// beyond_control.h - whether a first look, without nominal flights, may take a name that control can mimic.
//
// Control that cancels a disturbance commands moments that do not turn the vehicle, as if its inertia were
// larger or its torque smaller (fx->control_makes).
#ifndef SIM_GAP_5_INFER_BEYOND_CONTROL_H
#define SIM_GAP_5_INFER_BEYOND_CONTROL_H

#include "gap/5_infer/round.h"

// True if the last candidate of the choice explains more than control can. v: its verdict in the choice
// (score_last). chosen: its columns are derivatives about its own numbers, not about 0. Always true with
// nominal flights: they show what control makes (score_allows).
bool beyond_control(const round_t *r, const choice_t *choice, const verdict_t *v, bool chosen);

#endif
