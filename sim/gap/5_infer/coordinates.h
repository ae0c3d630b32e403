// coordinates.h - coordinates along which a flight is cut to find where something lies.
#ifndef SIM_GAP_5_INFER_COORDINATES_H
#define SIM_GAP_5_INFER_COORDINATES_H

#include "gap/2_predict/grid.h"

enum {
  NOWHERE = -1, // along no coordinate
  COORDINATE_CEILING,
  COORDINATE_HEIGHT,
  COORDINATE_X,
  COORDINATE_Y,
  COORDINATE_VEL_X,
  COORDINATE_VEL_Y,
  COORDINATE_VEL_Z,
  COORDINATE_VOLTAGE,
  COORDINATE_THRUST,
  COORDINATE_RATE_X,
  COORDINATE_RATE_Y,
  COORDINATE_RATE_Z,
  COORDINATE_TIME,
  COORDINATES,
  BY_FLIGHT = COORDINATES // from flight to flight
};

const char *coordinate_name(int i);
const char *coordinate_unit(int i);
bool coordinate_is_place(int i); // or time
// Returns it in coordinate_unit(i), velocities in body axes; NaN where the log lacks it.
double coordinate_of(int i, const grid_t *g, const model_t *m, int point);

#endif
