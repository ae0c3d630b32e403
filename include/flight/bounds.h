// bounds.h - beyond these no indoor flight goes: what says so is broken, not fast (and 1e38 would poison the
// filters). One place, so that no layer flies on what another refuses.
#ifndef FLIGHT_BOUNDS_H
#define FLIGHT_BOUNDS_H

#include <stdint.h> // a header that is only numbers compiles alone, too

// test: guard_raises_each_reason_at_its_threshold
#define BOUND_RATE_RADPS   34.5f   // of the gyro, each axis; it ends at 34.9
#define BOUND_ACC_MPS2     1000.0f // four times what the accelerometer can say
#define BOUND_POS_M        1e4f    // a float still tells millimetres there
#define BOUND_VEL_MPS      20.0f   // ten times an indoor flight
#define BOUND_HEIGHT_OFF_M 1.0f    // resets that sum up to more: the estimate knows no height any more
// test: watch_takes_a_jump_of_the_height_out_that_its_velocity_does_not_explain
#define BOUND_HEIGHT_JUMP_M 0.01f // a height that moves by more than velocity x time was reset
// test: guard_learns_hover_thrust_as_a_mean_over_half_a_second
#define CARRYING_SHARE 0.3f // of the weight: with less thrust the rotors do not carry

// Of what is asked for: so far from any flight that it matters nowhere where they are.
#define BOUND_THRUST_N          100.0f // of a motor, and of all
#define BOUND_WANTED_ANGLE_RAD  1000.0f
#define BOUND_WANTED_RATE_RADPS 100.0f

#endif
