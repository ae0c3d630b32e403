// height_rest.h - a vehicle at rest in free air, as the height filter sees it.
#ifndef TEST_RIG_HEIGHT_REST_H
#define TEST_RIG_HEIGHT_REST_H

#include "flight/height.h"
#include "flight/params.h"

#define HEIGHT_REST_KG 0.0329f

// The test may change these inputs before or between the steps.
typedef struct {
  flight_param_t p;
  height_t h;
  height_in_t in;
  float share, down_m; // motor_share of height_step; range, new every third step
  float shake_m;       // alternating error of the range samples
  float shake_mps2;    // alternating error of the accelerometer
  bool silent;
  int k;
} height_rest_t;

void height_rest_start(height_rest_t *r);
void height_rest_step(height_rest_t *r);
void height_rest_for(height_rest_t *r, int steps);
// Starts, and rests until nothing changes any more.
void height_rest_settle(height_rest_t *r);

#endif
