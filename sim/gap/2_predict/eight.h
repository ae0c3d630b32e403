// eight.h - replays eight points at a time, where the processor can. Only 2_predict files include it.
#ifndef SIM_GAP_2_PREDICT_EIGHT_H
#define SIM_GAP_2_PREDICT_EIGHT_H

#include "gap/2_predict/path.h"

// Computes what the range sensor sees without effects; up: cosine of the tilt.
void predict_sight(const grid_t *g, const model_t *m, const grid_point_t *p, double up, double *range_m,
                   double *rate_mps);

// Puts the body's state and voltage at a point. Its motors, and what effects at ticks do to it, come after.
void predict_place(body_t *b, const grid_point_t *p);

// Predicts one point, by itself.
typedef void (*eight_alone_t)(body_t *b, const grid_t *g, const lagged_t *motors, int j,
                              double *const out[CHANNELS]);

// Replays all points. b: at the first point, after its effects at ticks have acted there. Points that differ
// too much from the others are done by `alone`. False: nothing is done; the points of this vehicle
// have to be replayed one by one, in order.
bool eight_replay(grid_t *g, body_t *b, const lagged_t *motors, eight_alone_t alone,
                  double *const out[CHANNELS]);
// The same, and keeps the replay for the next two. False also where a point would have to be done alone.
bool eight_keep(grid_t *g, body_t *b, const lagged_t *motors, path_t *path, double *const out[CHANNELS]);
// Replays a vehicle that differs from the path's only in effects that act at ticks; the motors do the same.
bool eight_again(grid_t *g, body_t *b, const path_t *path, double *const out[CHANNELS]);
// Replays the path's vehicle b with one effect more, which does not act at ticks.
bool eight_more(grid_t *g, body_t *b, const path_t *path, const fx_use_t *more, double *const out[CHANNELS]);

#endif
