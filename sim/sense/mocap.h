// mocap.h - motion capture: position and attitude at a fixed rate, delivered to the vehicle with a delay.
#ifndef SIM_SENSE_MOCAP_H
#define SIM_SENSE_MOCAP_H

#include "base/random.h"
#include "sense/truth.h"

typedef struct {
  double period_s;    // between poses, whole milliseconds; 0: no motion capture
  double late_s;      // age when it arrives, less than the period
  double sd_m;        // of the position, each axis
  double sd_rad;      // of the attitude, each axis
  double tilt_rad[2]; // constant rotation of the markers' body about the vehicle's x and y
} mocap_param_t;

typedef struct {
  bool is_new;
  d3_t pos_w_m;
  dq_t q_wb;
} mocap_sample_t;

typedef struct {
  int ms; // since the last pose was captured
  mocap_sample_t taken;
} mocap_t;

// One period of 1 ms. *s starts as all zero.
mocap_sample_t mocap_step(mocap_t *s, const mocap_param_t *p, random_t *r, const truth_t *truth);

#endif
