// hover6.h - the flight code in the plant: a quiet flight in free air that starts in a hover at 0.5 m, with
// true measurements and no upward range sensor.
#ifndef TEST_RIG_HOVER6_H
#define TEST_RIG_HOVER6_H

#include "body/body.h"
#include "pilots/pilot_flight.h"

typedef struct {
  body_t body;
  model_t model;
  pilot_flight_t flight;
  pilot_t pilot;
  pilot_in_t in;
  d3_t acc_bias_b_mps2;
  double height_off_m; // error of the estimated height
} hover6_t;

// The caller zeroes *r before, and calls body_close(&r->body) after.
void hover6_start(hover6_t *r, double yaw_rad);

// Takes the true state as measurements, with the accelerometer's bias and the height error.
void hover6_sense(hover6_t *r);

// Steps the flight code for span_ms on the same measurements; motor_N: its last command.
void hover6_think(hover6_t *r, int span_ms, double motor_N[PILOT_MOTORS]);

void hover6_fly(hover6_t *r, double span_s);

double hover6_yaw_rad(const hover6_t *r);
double hover6_tilt_rad(const hover6_t *r);
d3_t hover6_pos_m(const hover6_t *r);

#endif
