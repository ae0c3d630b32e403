// flight.h - the whole controller in the order in which it runs: one call every millisecond.
//
//   1000 Hz  judge the inputs (guard.h), which may replace the pilot's set point
//    100 Hz  outer loop: position to direction and size of the thrust (step 0 of ten)
//    100 Hz  the learner, of that step's sample or of the ground's (step 4 of ten)
//    100 Hz  a step of the height filter, if height.own asks for it (step 2 of ten)
//    100 Hz  the ground's curve, if ground.mode asks for it (step 6 of ten)
//    100 Hz  repair of what a flipped bit left (step 8 of ten)
//    500 Hz  inner loop: attitude to torques, mixed to four motor forces (odd steps; one loop a millisecond)
//
// One state per vehicle, all of it in flight_t. Nothing here stops, prints or allocates. An input that is not
// finite, or beyond what any indoor flight shows, changes nothing: the last command is given again and the
// fault is counted.
#ifndef FLIGHT_FLIGHT_H
#define FLIGHT_FLIGHT_H

#include "flight/att_indi.h"
#include "flight/by_hand.h"
#include "flight/ground.h"
#include "flight/guard.h"
#include "flight/height.h"
#include "flight/mixer.h"
#include "flight/outer.h"
#include <stdint.h>

typedef enum { AXIS_OFF, AXIS_POSITION, AXIS_VELOCITY } axis_mode_t;
typedef enum { YAW_ANGLE, YAW_RATE } yaw_mode_t;

// What is wanted. If x or y is off, both are, and the tilt is roll_rad and pitch_rad. If z is off, the height
// is not controlled: the thrust is thrust_N, and the outer loop rests.
typedef struct {
  axis_mode_t x, y, z;
  yaw_mode_t yaw;
  bool vel_in_body;          // x and y of vel_mps are along the heading, not along the world's axes
  v3_t pos_w_m;              // of axes in AXIS_POSITION
  v3_t vel_mps;              // of axes in AXIS_VELOCITY; feed-forward of the others
  v3_t acc_w_mps2;           // feed-forward
  float roll_rad, pitch_rad; // right-handed about x and y
  float thrust_N;            // of all motors
  float yaw_rad;             // any angle; the shorter way round is taken
  float yaw_rate_radps;      // YAW_RATE: turns the held heading; in both modes feed-forward of the rate
} flight_setpoint_t;

typedef struct {
  uint32_t step;     // counts milliseconds; wraps
  v3_t rate_b_radps; // gyro
  v3_t acc_b_mps2;   // specific force: +9.81 on z at rest
  v3_t pos_w_m, vel_w_mps;
  quat_t q_wb;
  float force_N[MOTORS]; // applied since the last call: the command after mixing and limits
  bool range_new;        // as outer_in_t
  bool no_lesson;        // the vehicle does not fly: nothing is learned
  float range_m, range_age_s;
  float down_m; // only for height.own: downward range sensor, from the sensor to what is below, along the
                // body's z axis; 0: no new sample in the last ten milliseconds
  flight_setpoint_t setpoint;
} flight_in_t;

typedef struct {
  mixer_out_t motors;
  outer_out_t outer;
  quat_t q_ref; // wanted attitude
} flight_out_t;

typedef struct {
  outer_t outer;
  att_indi_t att;
  lpf2_coef_t att_filter;
  float att_lag_share;
  float att_lag_s;      // of motors and filter together
  sincos_t heading_ref; // heading that is held; YAW_RATE turns it
  float yaw_rad;        // the set point whose heading heading_ref is; NaN: none
  bool heading_known;   // not while the motors are off
  bool range_waits;     // a range sample that the outer loop has not seen
  float range_m, range_age_s;
  // Inputs of this call after the guard, then those of each loop. Kept here, as the vehicle's stack is small.
  flight_in_t in;
  outer_in_t outer_in;
  att_indi_in_t att_in;
  flight_out_t out;
  guard_t guard;
  flight_setpoint_t setpoint; // the last good one
  bool called;                // once at least
  uint32_t step_last;
  unsigned phase;     // millisecond of the ten, 0 to 9, from the step counter
  unsigned due;       // loops that this call runs: FLIGHT_OUTER and so on
  unsigned waiting;   // loops that are due, but put off
  unsigned waited;    // calls since a loop waits
  unsigned pressed;   // waiting loop that was last run beside the inner one (watch.c)
  int inner_ms;       // since the inner loop ran
  bool height_seen;   // height_m is that of the last good call
  float height_m;     // as the estimator gave it
  by_hand_t by_hand;  // while the pilot does not have the height controlled
  float height_off_m; // sum of the estimator's jumps, subtracted while the height is controlled; within
                      // twice BOUND_POS_M, and beyond BOUND_HEIGHT_OFF_M a reason to go down
  unsigned faults[ST_COUNT]; // of this layer; those of the outer loop are in outer.faults
  // Last, so that one instruction can address the others.
  height_t height;
  height_in_t height_in;
  height_fly_t height_fly; // what the last outer loop used, if by_height
  bool by_height;          // the law uses the height filter, or fades it out
  float height_share;      // lag share of the filter's motors in one step
  uint32_t height_last;    // step counter at the filter's last step
  ground_t ground;
} flight_t;

enum {
  FLIGHT_OUTER = 1,
  FLIGHT_LEARN = 2,
  FLIGHT_INNER = 4,
  FLIGHT_SCRUB = 8,
  FLIGHT_HEIGHT = 16,
  FLIGHT_GROUND = 32
};

// Initialises a controller, which then starts bumplessly from its first sample, also in flight.
// ST_BAD_PARAM: a parameter out of range; *f is kept.
MUST_CHECK status_t flight_init(flight_t *f, const flight_param_t *p);

// Uses the parameters *p from the next step on, also in flight. They must have passed params_check(), which
// takes too long for a tick. ST_BAD_PARAM: a cut-off that the loop's rate does not allow, which no checked
// set has.
MUST_CHECK status_t flight_tune(flight_t *f, const flight_param_t *p);

// Runs one millisecond, or more if calls were missed (the step counter tells; it may wrap), and returns
// f->out. A second call with the same count repeats the last command. Between the steps of a loop its last
// output stands.
const flight_out_t *flight_step(flight_t *f, const flight_in_t *in);

#endif
