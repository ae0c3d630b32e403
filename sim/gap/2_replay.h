// 2_replay.h - what the model says at every instant of a flight: the measured state and the logged commands
// put into the plant, one derivative at a time, never a free run.
#ifndef SIM_GAP_REPLAY_H
#define SIM_GAP_REPLAY_H

#include "gap/grid.h"

// out[channel][point]: specific force and angular acceleration in body axes, and the range sensor's reading
// (NaN where nothing is in sight), with the model's own effects. ST_FAILED: no memory.
MUST_CHECK status_t replay(grid_t *g, const model_t *m, double *const out[CHANNELS], why_t *why);

#endif
