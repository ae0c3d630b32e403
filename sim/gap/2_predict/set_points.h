// set_points.h - what the controller was told, at the points of a grid.
#ifndef SIM_GAP_2_PREDICT_SET_POINTS_H
#define SIM_GAP_2_PREDICT_SET_POINTS_H

#include "gap/2_predict/grid.h"

// Place, speed and heading of the samples from `from` on; NaN where the log has them not.
void set_point_read(const grid_t *g, const model_t *m, int from, point_t *p);

// Axis by axis over the whole grid: a place that stands still while the speed moves, or from which the
// vehicle stays away, is left over from before, and is not what it follows: NaN.
void set_points_judge(grid_t *g);

// The log says where the vehicle should have been or gone, on some axis.
bool set_points_there(const grid_t *g);

// The points with measured place, speed and attitude replaced by what follows from the set points alone: the
// place, or the way that the speed leads; where nothing is said, the mean place and the first heading.
// Without range samples; the voltage is a line in time. The caller frees points of the copy. FAILED: no
// memory.
MUST_CHECK done_t set_points_track(const grid_t *g, grid_t *track, why_t *why);

#endif
