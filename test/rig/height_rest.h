// height_rest.h - a vehicle at rest in free air, as the height filter is told of it.
#ifndef TEST_RIG_HEIGHT_REST_H
#define TEST_RIG_HEIGHT_REST_H

#include "flight/height.h"
#include "flight/params.h"

#define HEIGHT_REST_KG 0.0329f

// A test changes what it is told, before or between the steps.
typedef struct {
  flight_param_t p;
  height_t h;
  height_in_t in;
  float share, down_m; // of the motors; each third step
  float shake_m;       // of every other range sample
  float shake_mps2;    // of every other accelerometer's sample
  bool silent;
  int k;
} height_rest_t;

void height_rest_start(height_rest_t *r);
void height_rest_step(height_rest_t *r);
void height_rest_for(height_rest_t *r, int steps);
// Started, and so long at rest that nothing changes.
void height_rest_settle(height_rest_t *r);

#endif
