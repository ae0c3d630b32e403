// guard.h - what is wrong with the inputs, and what to do about it: fly on, go down, or give up.
//
//   fly        what the set point says
//   hold       the last good set point (the new one is no number)
//   retreat    down to guard.safeGap below the ceiling that was last known, or straight down where none was
//   hand over  level, slightly below hover thrust, after guard.cutAfter nothing
//
// Near a ceiling the upward sensor is too slow to be the only witness (full thrust closes 5 cm in 110 ms, a
// sample comes every 100 ms), so that what flies the vehicle is judged every millisecond. A retreat lasts
// until its reasons are gone for a second and the pilot asks for another height; a hand-over until the height
// is no longer controlled. Reasons are kept as bits, now and latched, for a log group.
#ifndef FLIGHT_GUARD_H
#define FLIGHT_GUARD_H

#include "flight/mixer.h"
#include "flight/v3.h"
#include <stdint.h>

typedef enum { GUARD_FLY, GUARD_HOLD, GUARD_RETREAT, GUARD_HAND_OVER } guard_action_t;

typedef enum {
  GUARD_NOT_A_NUMBER = 1 << 0, // a sensor or the estimate is not finite, or beyond what it can be
  GUARD_GYRO_FROZEN = 1 << 1,  // the same bits for 25 ms after it was alive
  GUARD_ACC_FROZEN = 1 << 2,   // likewise
  GUARD_ACC_CLIPPED = 1 << 3,  // beyond 20 g
  GUARD_ACC_BIAS = 1 << 4,     // contradicts the velocity for long
  GUARD_TILT = 1 << 5,         // beyond 60 degrees
  GUARD_RANGE_LOST = 1 << 6,   // no valid sample for 250 ms near a ceiling
  GUARD_RANGE_FROZEN = 1 << 7, // the same value while the height moved by more than 2 cm
  GUARD_RANGE_ODD = 1 << 8,    // a sample that is no distance, or that the vehicle's climb does not explain
  GUARD_BLIND = 1 << 9,        // below the sensor's floor for longer than ceil.blindMax
  GUARD_SATURATED = 1 << 10,   // full thrust for 200 ms near a ceiling
  GUARD_SETPOINT = 1 << 11,    // a set point that is no number
  GUARD_TOO_NEAR = 1 << 12,    // the ceiling is nearer than the set point allows
  GUARD_HEIGHT_JUMP = 1 << 13, // the estimate of the height was reset
  GUARD_TIME = 1 << 14,        // milliseconds were missed, came twice, or ran backwards
  GUARD_NO_ROOM = 1 << 15,     // a take-off under a ceiling nearer than guard.takeOff
  GUARD_VELOCITY = 1 << 16,    // the estimated velocity jumps
  GUARD_RATIO = 1 << 17,       // the thrust carries more than it should so far from a ceiling
  GUARD_HEIGHT_LOST = 1 << 18, // resets of the estimated height sum up to more than 1 m, for 250 ms
} guard_reason_t;

typedef struct {
  float blind_max_s; // >= 0  longest time nearer than the sensor's floor
  float safe_gap_m;  // > 0   where a retreat ends
  float sink_mps;    // > 0   of a retreat
  float cut_after_s; // >= 0  of a hand-over until the motors stop
  float take_off_m;  // >= 0  nearer than this to a ceiling there is no take-off
  float share;       // 0..1  of hover thrust, in a hand-over
} guard_param_t;

typedef struct {
  int ms;        // since the last call, >= 1
  bool wanted;   // the pilot has the height controlled
  bool carries;  // the height is controlled, and so much thrust is given that the rotors carry
  bool on_floor; // something else than the rotors carries
  v3_t rate_b_radps, acc_b_mps2, pos_w_m, vel_w_mps;
  quat_t q_wb;
  bool range_new;
  float range_m, range_floor_m, range_near_m;
  float thrust_N, thrust_max_N, weight_N; // thrust: applied since the last call
  float zc_m, blind_s, ceiling_z_m;
  bool zc_known;
  bool setpoint_good;
  float setpoint_z_m; // wanted height, limits included; NaN: none
  float asked_z_m;    // the same without limits
  float height_off_m; // sum of the height's resets
  bool find_bias;     // the accelerometer's bias is looked for; else it is taken off as a fault only
  float force_N,
      thrust_now_N;      // along the thrust: what accelerates the mass, what the motors give in free air
  float bias_known_mps2; // what the outer loop takes off the vertical acceleration itself
} guard_in_t;

typedef struct {
  unsigned now, latched; // guard_reason_t
  guard_action_t action;
  float hover_N;       // thrust that carries, while nothing is wrong
  bool acc_lost;       // the accelerometer is not to be used
  bool vel_lost;       // the estimated velocity is not to be used; vel_last is
  float acc_bias_mps2; // to be taken off the vertical acceleration
  float hold_z_m;      // height at which the retreat began
  v3_t hold_w_m;       // place over which it goes down
  int retreat_ms;      // since the retreat began
  int handed_ms;       // since the hand-over
  bool airborne;       // has flown and not landed since the height is controlled
  // Not for callers.
  bool started;
  v3_t rate_last, acc_last, vel_last;
  float rate_life, acc_life; // mean change per millisecond
  v3_t vel_raw;
  int vel_calm_ms, vel_odd_ms, impact_ms, range_same_ms, range_new_ms, ratio_ms, floor_ms, off_ms;
  float ratio_usual, carried_s;
  int rate_same_ms, acc_same_ms, acc_clip_ms, tilt_ms, setpoint_ms, full_ms, range_ms, quiet_ms;
  float bad_ms;
  bool near_seen;
  float range_last_m, range_z_m;
  int range_same;
  float bias_mps2, bias_fast_mps2, bias_s; // found and not given away; what is new in it; time of its mean
  float window_mps, window_vel_mps; // of one period of the estimator: acceleration summed up, climb before
  int window_ms;
  int nearer; // what range samples say of it, summed up
  bool flown;
  float asked_at_m; // the pilot's height when the retreat began
} guard_t;

// Nothing is wrong, nothing known.
void guard_init(guard_t *g);

// The height is not controlled: forgets but for what is latched.
void guard_rest(guard_t *g);

// A number of a sensor or the estimate is out of all bounds (a part of what GUARD_NOT_A_NUMBER is raised by).
bool guard_plausible(const guard_in_t *in);

// One call of the controller. Afterwards g->action says what to do. A velocity that is none is replaced in
// *in.
void guard_step(guard_t *g, const guard_param_t *p, guard_in_t *in);

// The height that a retreat wants at this height.
float guard_retreat_z_m(const guard_t *g, const guard_param_t *p, float z_m, float ceiling_z_m);

// The thrust of a hand-over now.
float guard_thrust_N(const guard_t *g, const guard_param_t *p, float weight_N);

// The accelerometer's bias as far as it has settled since it stepped; 0: nothing has.
float guard_settled_bias_mps2(const guard_t *g);
// Somebody else takes so much of it off from now on.
void guard_give_bias(guard_t *g, float given_mps2);

#endif
