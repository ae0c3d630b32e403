// plan.h - the plan of an exam flight: pieces that together excite every effect, in random order.
#ifndef EXAM_PLAN_H
#define EXAM_PLAN_H

#include "base/random.h"
#include "gap/1_read/flight.h"

#define EXAM_CEILING_M 0.8
#define EXAM_PIECES                                                                                          \
  7 // near the ceiling, near the floor, a line, a circle, steps up and down, a turn, a hover

// Set point: m and m/s in the world, z up; yaw in rad.
typedef struct {
  d3_t pos, vel;
  double yaw;
} wish_t;

// The order of a flight's pieces, and four numbers in 0..1 for each piece.
typedef struct {
  int order[EXAM_PIECES];
  double number[EXAM_PIECES][4];
} plan_t6;

// Seven pieces, or a hover of the same length.
plan_t6 plan_make(random_t *r, bool hover_only);

// The set point at a time of 0..EXAM_SPAN_S.
wish_t plan_wish(const plan_t6 *plan, double t_s);

#endif
