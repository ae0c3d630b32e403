// guard.h - what is wrong with the inputs, and what to do about it: fly on, go down, or give up.
//
//   fly        follow the set point
//   hold       follow the last good set point (the new one is not finite, or beyond its bounds)
//   retreat    go down to guard.safeGap below the last known ceiling, or straight down if none was known;
//              if the thrust contradicts the range (RATIO), to that gap below the height where it did
//   hand over  level, slightly below hover thrust, motors off after guard.cutAfter
//
// Near a ceiling the upward sensor alone is too slow (full thrust closes 5 cm in 110 ms, a sample comes every
// 100 ms), so all inputs that fly the vehicle are judged every millisecond. A retreat lasts until its reasons
// have been gone for a second and the pilot asks for another height (after RATIO: one that needs no climb); a
// hand-over lasts until the height is no longer controlled. All reasons are latched for a log group; the
// table says which are in `now`, too.
#ifndef FLIGHT_GUARD_H
#define FLIGHT_GUARD_H

#include "flight/mixer.h"
#include "flight/v3.h"
#include <stdint.h>

typedef enum { GUARD_FLY, GUARD_HOLD, GUARD_RETREAT, GUARD_HAND_OVER } guard_action_t;

// The table: one row per reason, file by file, in the order in which the file judges them. The function of
// the same name judges the reason (GYRO_FROZEN: gyro_frozen). Times are in ms.
//
//   bit      in guard_t.now and .latched; never changed, because logs contain it
//   lasts    how long the condition lasts before it is a reason
//   down     retreat if it lasts longer than this; 0: as soon as it is a reason; -1: never
//   ends     hand over if it lasts longer than this in the air; 0 and -1 likewise. Both -1: fly on
//   gone     how long the condition is gone before the reason ends
//
// X(bit, reason, lasts, down, ends, gone, in words)
// clang-format off

// judge_motion.c: each uses the results of those before.
#define GUARD_OF_MOTION(X)                                                                                            \
  X(16, VELOCITY,       0,   0, 2000, 50, "the estimated velocity jumps")                                             \
  X( 1, GYRO_FROZEN,   25,  -1,  100,  0, "the gyro is frozen")                                                       \
  X( 2, ACC_FROZEN,    25,   0,   -1,  0, "the accelerometer is frozen")                                              \
  X( 3, ACC_CLIPPED,    0,  -1,   -1,  0, "the accelerometer is clipped")                                             \
  X( 5, TILT,           0,  -1,  100,  0, "tilted beyond 60 degrees")                                                 \
  X( 4, ACC_BIAS,       0,  -1,   -1,  0, "the accelerometer contradicts the velocity")                               \
  X(18, HEIGHT_LOST,  250,   0,   -1,  0, "resets of the estimated height sum up to more than a metre")

// judge_ceiling.c: RANGE_FROZEN, RANGE_ODD, TOO_NEAR and RATIO are judged by samples; a result stands until the next.
#define GUARD_OF_CEILING(X)                                                                                           \
  X( 6, RANGE_LOST,   250,   0,   -1,  0, "the range sensor is lost")                                                 \
  X( 9, BLIND,          0,   0,   -1,  0, "below the range sensor's floor for longer than ceil.blindMax")             \
  X( 8, RANGE_ODD,      0,  -1,   -1,  0, "odd range samples")                                                        \
  X( 7, RANGE_FROZEN, 200,   0,   -1,  0, "the range sensor is frozen")                                               \
  X(10, SATURATED,    200,   0,   -1,  0, "full thrust near the ceiling")                                             \
  X(12, TOO_NEAR,       0,   0,   -1,  0, "the ceiling is nearer than the set point allows")                          \
  X(17, RATIO,         10,   0,   -1,  0, "the thrust carries more than it should so far from a ceiling")

// guard.c: inputs without which no other reason can be judged (while they are bad, the others stay as they are), and
// what is asked for. A bad set point leads to a hold at once; without room the motors stay off.
#define GUARD_OF_CALL(X)                                                                                              \
  X( 0, NOT_A_NUMBER,   0,  -1,   50,  0, "a sensor or the estimate is no number")                                    \
  X(11, SETPOINT,       0, 250,   -1,  0, "a set point that is no number")                                            \
  X(15, NO_ROOM,        0,  -1,    0,  0, "no room to take off")

// watch.c, watch_time and take_jump_out: events of a single call, corrected there; latched only, never in `now`.
#define GUARD_OF_WATCH(X)                                                                                             \
  X(14, TIME,           0,  -1,   -1,  0, "milliseconds were missed")                                                 \
  X(13, HEIGHT_JUMP,    0,  -1,   -1,  0, "the height estimate jumped")
// clang-format on

#define GUARD_REASONS(X) GUARD_OF_MOTION(X) GUARD_OF_CEILING(X) GUARD_OF_CALL(X) GUARD_OF_WATCH(X)

#define GUARD_BIT(bit, reason, ...) GUARD_##reason = 1 << (bit),
typedef enum { GUARD_REASONS(GUARD_BIT) } guard_reason_t;

// Defines GUARD_TILT_ENDS_MS and so on. Times of 0 and -1 are not compared with; the rules are written so.
#define GUARD_TIMES(bit, reason, lasts, down, ends, gone, words)                                             \
  GUARD_##reason##_LASTS_MS = lasts, GUARD_##reason##_DOWN_MS = down, GUARD_##reason##_ENDS_MS = ends,       \
  GUARD_##reason##_GONE_MS = gone,
enum { GUARD_REASONS(GUARD_TIMES) };

typedef struct {
  float blind_max_s; // >= 0  longest time nearer than ceil.near without a range sample
  float safe_gap_m;  // > 0   a retreat ends this far below the ceiling
  float sink_mps;    // > 0   of a retreat
  float cut_after_s; // >= 0  from the hand-over until the motors stop
  float take_off_m;  // >= 0  nearer than this to a ceiling there is no take-off
  float share;       // 0..1  of hover thrust, in a hand-over
} guard_param_t;

typedef struct {
  int ms;        // since the last call, >= 1
  bool wanted;   // the pilot has the height controlled
  bool carries;  // the height is controlled, and the thrust is enough for the rotors to carry the vehicle
  bool on_floor; // something other than the rotors carries it
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
  bool find_bias;     // the accelerometer's bias is estimated; otherwise it is removed only as a fault
  bool force_new;     // the next two are of a period that has not been judged yet
  // Along the thrust: mass times specific force, and the thrust of the motors in free air.
  float force_N, thrust_now_N;
  float bias_known_mps2; // that the outer loop removes from the vertical acceleration itself
} guard_in_t;

// Sums of a least-squares fit (judge_ceiling.c): of 1, f, f f, y, f y, y y.
typedef struct {
  float n, f, ff, y, fy, yy;
} guard_growth_t;

typedef struct {
  unsigned now, latched; // guard_reason_t
  guard_action_t action;
  v3_t vel_w_mps;      // believed: as estimated; while vel_lost the last good one, with z integrated on
  bool vel_lost;       // the estimated velocity is not to be used
  bool acc_lost;       // the accelerometer is not to be used
  float acc_bias_mps2; // to be subtracted from the vertical acceleration
  float hover_N;       // mean thrust that carries the vehicle while nothing is wrong
  bool airborne;       // has flown and not landed since the height is controlled
  float hold_z_m;      // height at which the retreat began
  v3_t hold_w_m;       // place over which it goes down
  int retreat_ms;      // since the retreat began
  int handed_ms;       // since the hand-over
  // Not for callers: what each rule remembers.
  bool started; // judged once at least
  // VELOCITY
  v3_t vel_raw;                           // as estimated in the last call
  int vel_calm_ms, vel_odd_ms, impact_ms; // time without a jump; not believed; until an impact is forgotten
  // GYRO_FROZEN, ACC_FROZEN
  v3_t rate_last, acc_last;
  float rate_life, acc_life; // mean change per millisecond
  int rate_same_ms, acc_same_ms;
  // ACC_CLIPPED, TILT
  int acc_clip_ms; // until it is forgotten
  int tilt_ms;
  // ACC_BIAS
  float window_mps, window_vel_mps; // of one estimator period: integrated acceleration, climb rate before
  int window_ms;
  float bias_mps2, bias_fast_mps2, bias_s; // found, not handed over; fast mean of the rest; averaging time
  // HEIGHT_LOST
  int off_ms;
  // RANGE_LOST
  bool near_seen; // a ceiling was near, and could be seen
  int range_ms;   // since a sample that was a distance
  // RANGE_FROZEN; NO_ROOM uses range_last_m, too
  float range_last_m, range_z_m; // the last range that differed from its predecessor; the height then
  int range_same, range_same_ms; // samples equal to it: how many, over what time
  int range_new_ms;              // since the last sample
  // SATURATED, TOO_NEAR
  int full_ms;
  int nearer; // sum of what range samples say for TOO_NEAR
  // RATIO
  float ratio_now, ratio_usual, carried_s; // force over thrust now, and usually; time that rotors carry
  int force_ms;                            // since force and thrust were judged
  guard_growth_t growth;                   // of the ratio beyond the usual one, with the height risen
  int ratio_ms;
  // NOT_A_NUMBER, SETPOINT
  float bad_ms; // time of bad inputs, less a quarter of the good time since
  int setpoint_ms;
  // What is done about them
  bool flown;       // the rotors have carried since the height is controlled
  int floor_ms;     // that a floor carries
  int quiet_ms;     // without a reason to go down
  float asked_at_m; // the pilot's height when the retreat began
  bool unseen;      // RATIO since then: the ceiling is nearer than the range says
} guard_t;

// Nothing is wrong, nothing is known.
void guard_init(guard_t *g);

// Call while the height is not controlled: forgets all but the latched reasons and the last range.
void guard_rest(guard_t *g);

// Judges one call of the controller. g->action then says what to do, and g->vel_w_mps with which velocity.
void guard_step(guard_t *g, const guard_param_t *p, const guard_in_t *in);

// Returns the height set point of a retreat at height z_m. ceiling_z_m: NaN: none known.
float guard_retreat_z_m(const guard_t *g, const guard_param_t *p, float z_m, float ceiling_z_m,
                        float kp_per_s);

// Returns the present thrust of a hand-over.
float guard_thrust_N(const guard_t *g, const guard_param_t *p, float weight_N);

// Returns the accelerometer's vertical bias if it has settled since its last step, else 0.
float guard_settled_bias_mps2(const guard_t *g);
// Subtracts given_mps2 from the bias: the outer loop removes that much from now on.
void guard_give_bias(guard_t *g, float given_mps2);

#endif
