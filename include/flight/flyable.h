// flyable.h - do accelerometer and gyro tell of one and the same vehicle? Judged before it flies, while it
// stands or is carried about.
//
//   up      a = R' g e_z      while nothing moves: the specific force is 1 g, up as the estimate has it
//   turn    a' = -w x a       while it is carried: the change of a's x and y is what the gyro explains. Over
//                             stretches of 0.1 s, k = sum(da c)/sum(c^2), c = integral of -w x a; true is 1
//
// A sensor that is mounted the other way round, or with two axes exchanged, gives k near -1 or 0. What cannot
// be seen: the gyro's yaw while level, anything of the gyro while the vehicle was never turned, and two axes
// exchanged while it was turned about both at the same pace.
#ifndef FLIGHT_FLYABLE_H
#define FLIGHT_FLYABLE_H

#include "flight/v3.h"
#include <stdint.h>

// X(bit, reason, in words). Each stands until what contradicts it has been seen.
// clang-format off
#define FLYABLE_REASONS(X)                                                                                   \
  X(0, UP,     "at rest the accelerometer does not point up")                                                \
  X(1, TURN_X, "gyro and accelerometer contradict each other along x")                                       \
  X(2, TURN_Y, "gyro and accelerometer contradict each other along y")
// clang-format on

#define FLYABLE_BIT(bit, reason, words) FLYABLE_##reason = 1 << (bit),
typedef enum { FLYABLE_REASONS(FLYABLE_BIT) } flyable_reason_t;

// Of the change along one axis: sum(da c), sum(c^2).
typedef struct {
  float cross, square;
} flyable_turn_t;

typedef struct {
  unsigned not_flyable; // flyable_reason_t; 0: nothing speaks against it
  // Not for callers.
  v3_t acc_from, explained;
  flyable_turn_t turn_x, turn_y;
  float wrong_s, steady_s;
  int stretch_ms;
} flyable_t;

void flyable_init(flyable_t *s);

// One millisecond on the ground or in the hand, motors off. Inputs that are not finite are left out.
void flyable_step(flyable_t *s, v3_t acc_b_mps2, v3_t rate_b_radps, quat_t q_wb);

#endif
