// bounds.h - beyond these no indoor flight goes: what says so is broken, not fast (and 1e38 would poison the
// filters). One place, so that no layer flies on what another refuses.
#ifndef FLIGHT_BOUNDS_H
#define FLIGHT_BOUNDS_H

#include <stdint.h> // a header that is only numbers compiles alone, too

#define BOUND_RATE_RADPS        34.5f // of the gyro, each axis; it ends at 34.9
#define BOUND_ACC_MPS2          1000.0f
#define BOUND_POS_M             1e4f
#define BOUND_VEL_MPS           20.0f
#define BOUND_THRUST_N          100.0f // of a motor, and of all
#define BOUND_WANTED_ANGLE_RAD  1000.0f
#define BOUND_WANTED_RATE_RADPS 100.0f
#define BOUND_HEIGHT_JUMP_M     0.01f // a height that moves by more than velocity x time was reset
#define BOUND_HEIGHT_OFF_M      1.0f  // resets that sum up to more: the estimate knows no height any more
#define CARRYING_SHARE          0.3f  // of the weight: with less thrust the rotors do not carry

#endif
