// flyable.h - whether accelerometer, gyro and attitude agree. Judged before flight, while the vehicle stands
// or is carried about.
//
//   up      a = R' g e_z      at rest: the specific force is 1 g along the estimate's up axis
//   turn    a' = -w x a       while carried: the gyro explains the change of a's x and y. Over stretches of
//                             0.1 s, k = sum(da c)/sum(c^2), c = integral of -w x a; k is 1 if they agree
//
// A sensor that is mounted the other way round, or with two axes exchanged, gives k near -1 or 0. Not
// detectable: an error of the gyro's yaw while level, any error of the gyro if the vehicle was never turned,
// and two exchanged axes if it was turned about both at the same rate.
#ifndef FLIGHT_FLYABLE_H
#define FLIGHT_FLYABLE_H

#include "flight/v3.h"
#include <stdint.h>

// X(bit, reason, in words). Each reason stands until evidence against it is seen.
// clang-format off
#define FLYABLE_REASONS(X)                                                                                   \
  X(0, UP,     "at rest the accelerometer does not point up")                                                \
  X(1, TURN_X, "gyro and accelerometer contradict each other along x")                                       \
  X(2, TURN_Y, "gyro and accelerometer contradict each other along y")
// clang-format on

#define FLYABLE_BIT(bit, reason, words) FLYABLE_##reason = 1 << (bit),
typedef enum { FLYABLE_REASONS(FLYABLE_BIT) } flyable_reason_t;

// Sums of the change along one axis: sum(da c), sum(c^2).
typedef struct {
  float cross, square;
} flyable_turn_t;

typedef struct {
  unsigned not_flyable; // bits of flyable_reason_t; 0: flyable
  // Not for callers.
  v3_t acc_from, explained;
  flyable_turn_t turn_x, turn_y;
  float wrong_s, steady_s;
  int stretch_ms;
} flyable_t;

void flyable_init(flyable_t *s);

// Judges one millisecond on the ground or in the hand, motors off. Ignores inputs that are not finite.
void flyable_step(flyable_t *s, v3_t acc_b_mps2, v3_t rate_b_radps, quat_t q_wb);

#endif
