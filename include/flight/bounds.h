// bounds.h - limits that no indoor flight exceeds: an input beyond them is broken, not fast (and 1e38 would
// poison the filters). In one place, so that no layer accepts what another refuses.
#ifndef FLIGHT_BOUNDS_H
#define FLIGHT_BOUNDS_H

#include <stdint.h> // a header that is only numbers compiles alone, too

// test: guard_raises_each_reason_at_its_threshold
#define BOUND_RATE_RADPS   34.5f   // of the gyro, each axis; its range ends at 34.9
#define BOUND_ACC_MPS2     1000.0f // four times the accelerometer's range
#define BOUND_POS_M        1e4f    // a float still resolves millimetres there
#define BOUND_VEL_MPS      20.0f   // ten times an indoor flight
#define BOUND_HEIGHT_OFF_M 1.0f    // if resets sum up to more, the estimated height means nothing any more
// test: watch_takes_a_jump_of_the_height_out_that_its_velocity_does_not_explain
#define BOUND_HEIGHT_JUMP_M 0.01f // a height that moves by this much more than velocity x time was reset
// test: guard_learns_hover_thrust_as_a_mean_over_half_a_second
#define CARRYING_SHARE 0.3f // of the weight: with less thrust the rotors do not carry the vehicle

// Bounds of set points: so far beyond any flight that their values do not matter.
#define BOUND_THRUST_N          100.0f // of a motor, and of all
#define BOUND_WANTED_ANGLE_RAD  1000.0f
#define BOUND_WANTED_RATE_RADPS 100.0f

#endif
