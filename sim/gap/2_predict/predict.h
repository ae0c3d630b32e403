// predict.h - what the model predicts at every instant of a flight: the plant's derivative at the measured
// state and the logged commands, one instant at a time, never a free run.
#ifndef SIM_GAP_2_PREDICT_PREDICT_H
#define SIM_GAP_2_PREDICT_PREDICT_H

#include "gap/2_predict/path.h"

// Fills out[channel][point]: specific force and angular acceleration in body axes, and the range sensor's
// reading (NaN where nothing is in sight), with the model's own effects. FAILED: no memory.
MUST_CHECK done_t replay(grid_t *g, const model_t *m, double *const out[CHANNELS], why_t *why);

// As replay(), and keeps it in *path. Free that, also on an error.
MUST_CHECK done_t replay_keep(grid_t *g, const model_t *m, path_t *path, double *const out[CHANNELS],
                              why_t *why);
void path_free(path_t *path);

// Replays the path's model with an effect added, or in place of the model's own one of that name. The numbers
// are those of replay() of such a model, to the bit. BAD_INPUT: as model_add_fx. FAILED: no memory.
MUST_CHECK done_t replay_with(grid_t *g, const path_t *path, const fx_use_t *more,
                              double *const out[CHANNELS], why_t *why);

#endif
