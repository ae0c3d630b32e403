// predict.h - what the model says at every instant of a flight: the measured state and the logged commands
// put into the plant, one derivative at a time, never a free run.
#ifndef SIM_GAP_2_PREDICT_PREDICT_H
#define SIM_GAP_2_PREDICT_PREDICT_H

#include "gap/2_predict/path.h"

// out[channel][point]: specific force and angular acceleration in body axes, and the range sensor's reading
// (NaN where nothing is in sight), with the model's own effects. FAILED: no memory.
MUST_CHECK done_t replay(grid_t *g, const model_t *m, double *const out[CHANNELS], why_t *why);

// As replay(), and keeps it. Free it, also on an error.
MUST_CHECK done_t replay_keep(grid_t *g, const model_t *m, path_t *path, double *const out[CHANNELS],
                              why_t *why);
void path_free(path_t *path);

// The replay of the path's model with an effect added, or in place of its own one of that name. Same numbers
// as replay() of such a model, to the bit. BAD_INPUT: as model_add_fx.
MUST_CHECK done_t replay_with(grid_t *g, const path_t *path, const fx_use_t *more,
                              double *const out[CHANNELS], why_t *why);

#endif
