// kinematic.h - vehicles that follow a prescribed path: the truth that the sensors see.
#ifndef TEST_RIG_KINEMATIC_H
#define TEST_RIG_KINEMATIC_H

#include "sense/truth.h"

typedef struct {
  double start_s, span_s; // of the motion: smooth (ninth-order polynomial), at rest before and after
  d3_t from_m, to_m;
  double yaw_from_rad, yaw_to_rad;
  double ceiling_m; // height of a level ceiling above the world's origin; HUGE_VAL: none
  double motors_on_s;
  d3_t sway_m; // amplitude of an oscillation on top of it
  double sway_Hz;
} kinematic_t;

truth_t kinematic_at(const kinematic_t *path, double t_s);

#endif
