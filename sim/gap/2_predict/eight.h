// eight.h - replays eight points at a time, where the processor can. Within sim/gap/2_predict only.
#ifndef SIM_GAP_2_PREDICT_EIGHT_H
#define SIM_GAP_2_PREDICT_EIGHT_H

#include "gap/2_predict/path.h"

// What range sensors see without effects; up: cosine of the tilt.
void predict_sight(const grid_t *g, const model_t *m, const grid_point_t *p, double up, double *range_m,
                   double *rate_mps);

// The body at a point, by itself. Its motors and what effects at ticks do to it come after.
void predict_place(body_t *b, const grid_point_t *p);

// What one point predicts, by itself.
typedef void (*eight_alone_t)(body_t *b, const grid_t *g, const lagged_t *motors, int j,
                              double *const out[CHANNELS]);

// b: at the first point, with what its effects at ticks did there; the points that differ too much are done
// one by one. False, and nothing is done: this vehicle's points have to be looked at in their order.
bool eight_replay(grid_t *g, body_t *b, const lagged_t *motors, eight_alone_t alone,
                  double *const out[CHANNELS]);
// The same, and keeps it for the next two. False, too, where a point would have to be done by itself.
bool eight_keep(grid_t *g, body_t *b, const lagged_t *motors, path_t *path, double *const out[CHANNELS]);
// A vehicle that differs from the path's in its effects at ticks alone, with the same motors.
bool eight_again(grid_t *g, body_t *b, const path_t *path, double *const out[CHANNELS]);
// b: the path's, likewise; with one effect more that does not act at ticks.
bool eight_more(grid_t *g, body_t *b, const path_t *path, const fx_use_t *more, double *const out[CHANNELS]);

#endif
