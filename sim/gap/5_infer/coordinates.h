// coordinates.h - what a flight is cut along, where someone looks in which part of it something lies.
#ifndef SIM_GAP_5_INFER_COORDINATES_H
#define SIM_GAP_5_INFER_COORDINATES_H

#include "gap/2_predict/grid.h"

enum {
  NOWHERE = -1, // along none of them
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
bool coordinate_is_place(int i); // or a time
// NaN where the log has it not.
double coordinate_of(int i, const grid_t *g, const model_t *m, int point);

#endif
