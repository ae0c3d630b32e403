// params.h - every tunable number once: name, unit, default, range.
//
// FLIGHT_PARAMS is the one table. From its rows come the firmware's parameters (group.name, at most 26
// characters with the dot), the host's --set, the range checks and the table in src/README.md. A group's
// rows stand together.
// X(group, name, type, field of flight_param_t, unit, default, min, max, what it does)
#ifndef FLIGHT_PARAMS_H
#define FLIGHT_PARAMS_H

#include "flight/att_indi.h"
#include "flight/bias.h"
#include "flight/ceiling.h"
#include "flight/curve.h"
#include "flight/guard.h"
#include "flight/height.h"
#include "flight/learn.h"
#include "flight/mixer.h"
#include "flight/pos_indi.h"
#include "flight/status.h"
#include <stddef.h>
#include <stdint.h>

// All that can be tuned. Every field has four bytes, so that two sets can be compared byte by byte.
typedef struct {
  pos_indi_param_t pos;
  float cutoff_Hz;   // of the one filter that all signals of the outer loop share
  float motor_tau_s; // first-order lag of the motors
  ceiling_param_t ceiling;
  curve_param_t curve;
  curve_param_t ground; // the same over the ground; distances are heights of the feet
  float ground_zero_m;  // the estimator's height where the feet stand
  learn_param_t learn;
  bias_param_t bias;
  float step_max_N;    // bound of the wanted thrust minus the thrust that the motors give now
  float learn_after_s; // learning starts this long after the rotors began to carry the vehicle
  float up_offset_m;   // propeller plane above the upward range sensor
  float push_N;        // largest force against a ceiling that is touched
  float gap_min_m;     // set points are clipped to this below the ceiling
  float tilt_share;    // share of the ceiling's torque about x and y that the inner loop cancels
  int32_t hold;        // hold_mode_t: how the ceiling's height is held
  att_indi_param_t att;
  float att_cutoff_Hz; // of the inner loop's filters
  mixer_param_t mixer;
  guard_param_t guard;
  height_param_t height;
} flight_param_t;

#ifndef PARAMS_YAW_ARM_M
#define PARAMS_YAW_ARM_M 0.00735f // legacy propellers; the firmware's build sets its own value (telemetry.c)
#endif

// Height gains. They were flown at 20 mm with the lag +-30 %, 10 ms more delay, the curve +-30 %, the range
// 40 ms older, the mass +-10 %, a bias of 0.1 m/s2, and pairs of these errors. Compared with the earlier
// quick 3 and catch 0.05, 3.1 and 0.08 oscillate 4 % less at 20 mm. What limits them: with motors 30 % faster
// and 10 ms more delay the rms is 1.8 mm for quick 3, 1.9 for 3.1, 2.4 for 3.4 and 3.4 for 4; with catch
// 0.09, 3 of 1,000 flights recover late from a dropped payload; kdz 10 touches at 15 mm. kdz 6 and quick 2
// are a tenth noisier. kpz from 1.5 to 3 makes no difference.
// kp and kd (x, y) are lower than the height gains: the optical flow is too coarse to hold x and y more
// closely (any gains drift 14 cm in a minute), and each degree of tilt costs height (kp 0.5, kd 4: 4 degrees
// at most; kp 1, kd 5: 6).
// The defaults are for the vehicle of the README's tables. Mass: hover with flow and multiranger decks.
// tauMot: legacy propellers respond in 70 to 90 ms, those of the 2.1+ in 58. tauMot 62.5 ms on motors of 96
// ms costs nothing at 20 mm (with the thesis's law 5 of 40 flights touched).
#define PARAMS_INDIPOS(X)                                                                                    \
  X(indiPos, kp, PARAM_FLOAT, pos.kp_per_s, "1/s", 0.5f, 0.05f, 20.0f,                                       \
    "x, y: wanted velocity per position error")                                                              \
  X(indiPos, kd, PARAM_FLOAT, pos.kd_per_s, "1/s", 4.0f, 0.1f, 50.0f,                                        \
    "x, y: wanted acceleration per velocity error")                                                          \
  X(indiPos, kpz, PARAM_FLOAT, pos.kp_z_per_s, "1/s", 2.0f, 0.05f, 20.0f,                                    \
    "height: wanted velocity per position error")                                                            \
  X(indiPos, kdz, PARAM_FLOAT, pos.kd_z_per_s, "1/s", 8.0f, 0.1f, 50.0f,                                     \
    "height: wanted acceleration per velocity error")                                                        \
  X(indiPos, quick, PARAM_FLOAT, pos.quick, "", 3.1f, 0.5f, 4.0f,                                            \
    "how many times faster than the motors the vertical acceleration follows")                               \
  X(indiPos, cutoff, PARAM_FLOAT, cutoff_Hz, "Hz", 30.0f, 0.0f, 45.0f,                                       \
    "cut-off of the filter on all signals; 0 = none")                                                        \
  X(indiPos, tauMot, PARAM_FLOAT, motor_tau_s, "s", 0.08f, 0.001f, 0.5f, "first-order lag of the motors")    \
  X(indiPos, mass, PARAM_FLOAT, pos.mass_kg, "kg", 0.0329f, 0.01f, 2.0f, "mass ready to fly")                \
  X(indiPos, tMax, PARAM_FLOAT, pos.thrust_max_N, "N", 0.48f, 0.05f, 40.0f,                                  \
    "largest thrust of all motors together")                                                                 \
  X(indiPos, tFloor, PARAM_FLOAT, pos.thrust_floor, "m g", 0.5f, 0.1f, 1.0f,                                 \
    "smallest thrust that tilt increments divide by")                                                        \
  X(indiPos, tiltMax, PARAM_FLOAT, pos.tilt_max_rad, "rad", 0.35f, 0.02f, 0.8f, "largest tilt commanded")    \
  X(indiPos, accMax, PARAM_FLOAT, pos.acc_max_mps2, "m/s2", 20.0f, 0.5f, 100.0f,                             \
    "bound of the wanted acceleration")                                                                      \
  X(indiPos, tStep, PARAM_FLOAT, step_max_N, "N", 0.2f, 0.01f, 40.0f,                                        \
    "bound of thrust wanted minus thrust that the motors give")                                              \
  X(indiPos, biasPole, PARAM_FLOAT, bias.pole_radps, "rad/s", 1.0f, 0.0f, 10.0f,                             \
    "speed at which the accelerometer's bias is found; 0 = not")                                             \
  X(indiPos, biasMax, PARAM_FLOAT, bias.max_mps2, "m/s2", 0.5f, 0.0f, 5.0f, "largest bias believed")         \
  X(indiPos, biasVel, PARAM_FLOAT, bias.vel_s, "s", 0.5f, 0.0f, 10.0f,                                       \
    "time over which the estimator's velocity is held against its position")

#define PARAMS_INDIATT(X)                                                                                    \
  X(indiAtt, kp, PARAM_FLOAT, att.kp_per_s, "1/s", 5.0f, 0.5f, 40.0f, "roll, pitch: wanted rate per angle")  \
  X(indiAtt, kd, PARAM_FLOAT, att.kd_per_s, "1/s", 12.0f, 1.0f, 100.0f,                                      \
    "roll, pitch: wanted angular acceleration per rate error")                                               \
  X(indiAtt, kpYaw, PARAM_FLOAT, att.kp_yaw_per_s, "1/s", 5.0f, 0.1f, 40.0f, "yaw: wanted rate per angle")   \
  X(indiAtt, kdYaw, PARAM_FLOAT, att.kd_yaw_per_s, "1/s", 12.0f, 0.5f, 100.0f,                               \
    "yaw: wanted angular acceleration per rate error")                                                       \
  X(indiAtt, jxx, PARAM_FLOAT, att.inertia_xx_kgm2, "kg m2", 16.57e-6f, 1e-6f, 0.1f, "inertia about x")      \
  X(indiAtt, jyy, PARAM_FLOAT, att.inertia_yy_kgm2, "kg m2", 16.66e-6f, 1e-6f, 0.1f, "inertia about y")      \
  X(indiAtt, jzz, PARAM_FLOAT, att.inertia_zz_kgm2, "kg m2", 29.26e-6f, 1e-6f, 0.1f, "inertia about z")      \
  X(indiAtt, g2, PARAM_FLOAT, att.g2_s, "s", 0.029f, 0.0f, 0.5f,                                             \
    "lead of the rotors' inertia over their drag in yaw")                                                    \
  X(indiAtt, rateMax, PARAM_FLOAT, att.rate_max_radps, "rad/s", 10.0f, 0.5f, 35.0f,                          \
    "bound of the wanted rates")                                                                             \
  X(indiAtt, quick, PARAM_FLOAT, att.quick, "", 2.0f, 0.5f, 4.0f,                                            \
    "how many times faster than the motors the acceleration follows")                                        \
  X(indiAtt, trim, PARAM_FLOAT, att.trim, "", 0.25f, 0.05f, 0.4f,                                            \
    "of arm x thrust: the largest torque from outside that is held against")                                 \
  X(indiAtt, cutoff, PARAM_FLOAT, att_cutoff_Hz, "Hz", 20.0f, 0.0f, 200.0f,                                  \
    "cut-off of the inner filters; 0 = none")                                                                \
  X(indiAtt, arm, PARAM_FLOAT, mixer.arm_m, "m", 0.0325f, 0.005f, 1.0f,                                      \
    "motor's distance from the x and the y axis")                                                            \
  X(indiAtt, yawArm, PARAM_FLOAT, mixer.yaw_m, "m", PARAMS_YAW_ARM_M, 0.0005f, 0.5f,                         \
    "torque over thrust of a rotor")                                                                         \
  X(indiAtt, fMax, PARAM_FLOAT, mixer.force_max_N, "N", 0.12f, 0.01f, 10.0f, "largest thrust of one motor")

#define PARAMS_CEIL(X)                                                                                       \
  X(ceil, mode, PARAM_INT, curve.mode, "", 1, 0, 3,                                                          \
    "0 off, 1 fixed weights, 2 live weights, 3 theory 1 + ca exp(-cb zc)")                                   \
  X(ceil, ca, PARAM_FLOAT, curve.ca, "", 0.44f, 0.0f, 5.0f, "theory: excess thrust ratio at zero distance")  \
  X(ceil, cb, PARAM_FLOAT, curve.cb_per_m, "1/m", 80.0f, 1.0f, 1000.0f, "theory: decay with the distance")   \
  X(ceil, law, PARAM_INT, pos.law, "", 1, 0, 1,                                                              \
    "0 the thesis's, by ceil.kz; 1 by the displacement predicted")                                           \
  X(ceil, kz, PARAM_FLOAT, pos.lead_s, "s", 0.3f, 0.0f, 3.0f,                                                \
    "law 0: lead of the ceiling term, the thesis's K_zdot")                                                  \
  X(ceil, catch, PARAM_FLOAT, pos.catch_s, "s", 0.08f, 0.0f, 1.0f,                                           \
    "law 1: lead by the climb that was not wanted")                                                          \
  X(ceil, zOn, PARAM_FLOAT, curve.on_m, "m", 0.1f, 0.0f, 0.5f, "the curve acts nearer than this")            \
  X(ceil, gain, PARAM_FLOAT, ceiling.gain, "", 0.1f, 0.0f, 1.0f,                                             \
    "share of the range error taken in per sample")                                                          \
  X(ceil, floor, PARAM_FLOAT, ceiling.floor_m, "m", 0.043f, 0.0f, 0.2f,                                      \
    "range samples below this are the sensor's floor")                                                       \
  X(ceil, near, PARAM_FLOAT, ceiling.near_m, "m", 0.05f, 0.01f, 0.2f,                                        \
    "an estimate nearer than this is not corrected")                                                         \
  X(ceil, far, PARAM_FLOAT, ceiling.far_m, "m", 0.5f, 0.25f, 4.0f, "farther than this there is no ceiling")  \
  X(ceil, min, PARAM_FLOAT, gap_min_m, "m", 0.02f, 0.0f, 0.5f,                                               \
    "set points are clipped to this below the ceiling, heights beyond to 6 mm more")                         \
  X(ceil, push, PARAM_FLOAT, push_N, "N", 0.05f, 0.0f, 1.0f,                                                 \
    "law 1: largest force against a ceiling that is touched")                                                \
  X(ceil, hold, PARAM_INT, hold, "", 2, 0, 2, "ceiling's height: 1 latched beyond 20 cm, 2 mean of samples") \
  X(ceil, tilt, PARAM_FLOAT, tilt_share, "", 1.0f, 0.0f, 2.0f,                                               \
    "share of the ceiling's torque in roll and pitch that is taken out")                                     \
  X(ceil, upOffset, PARAM_FLOAT, up_offset_m, "m", 0.0f, -0.1f, 0.1f,                                        \
    "propeller plane above the upward range sensor")                                                         \
  X(ceil, clip, PARAM_INT, curve.clip, "", 1, 0, 1, "1: slope <= 0 and ratio >= 1")                          \
  X(ceil, ratioMin, PARAM_FLOAT, curve.ratio_min, "", 0.5f, 0.1f, 1.0f, "smallest thrust ratio believed")    \
  X(ceil, ratioMax, PARAM_FLOAT, curve.ratio_max, "", 3.0f, 1.0f, 5.0f, "largest thrust ratio believed")     \
  X(ceil, blindMax, PARAM_FLOAT, guard.blind_max_s, "s", 3.0f, 0.0f, 600.0f,                                 \
    "nearer than ceil.near for longer than this without a range sample: retreat")                            \
  X(ceil, w1, PARAM_FLOAT, curve.fixed.w[0], "", 1.43142386f, -5.0f, 5.0f, "constant of the curve")          \
  X(ceil, w2, PARAM_FLOAT, curve.fixed.w[1], "", 0.15021046f, -5.0f, 5.0f, "weight of the bell at 0 mm")     \
  X(ceil, w3, PARAM_FLOAT, curve.fixed.w[2], "", -0.09754395f, -5.0f, 5.0f, "weight of the bell at 5 mm")    \
  X(ceil, w4, PARAM_FLOAT, curve.fixed.w[3], "", -0.07601899f, -5.0f, 5.0f, "weight of the bell at 15 mm")   \
  X(ceil, w5, PARAM_FLOAT, curve.fixed.w[4], "", -0.26694495f, -5.0f, 5.0f, "weight of the bell at 30 mm")   \
  X(ceil, w6, PARAM_FLOAT, curve.fixed.w[5], "", -0.30407099f, -5.0f, 5.0f, "weight of the bell at 60 mm")   \
  X(ceil, w7, PARAM_FLOAT, curve.fixed.w[6], "", -0.37406497f, -5.0f, 5.0f, "weight of the bell at 100 mm")

// The ground's curve is off by default and its weights are flat, because they have to be learned. Theory: 0.5
// exp(-0.76 z / R) with the rotors 30 mm above the feet, as in recorded flights of a Crazyflie
// (sim/gap/README.md).
#define PARAMS_GROUND(X)                                                                                     \
  X(ground, mode, PARAM_INT, ground.mode, "", 0, 0, 3,                                                       \
    "0 off, 1 fixed weights, 2 live weights, 3 theory 1 + ca exp(-cb h)")                                    \
  X(ground, ca, PARAM_FLOAT, ground.ca, "", 0.19f, 0.0f, 5.0f, "theory: excess thrust ratio of who stands")  \
  X(ground, cb, PARAM_FLOAT, ground.cb_per_m, "1/m", 33.0f, 1.0f, 1000.0f, "theory: decay with the height")  \
  X(ground, zOn, PARAM_FLOAT, ground.on_m, "m", 0.1f, 0.0f, 0.5f, "the curve acts lower than this")          \
  X(ground, zero, PARAM_FLOAT, ground_zero_m, "m", 0.0f, -10.0f, 10.0f,                                      \
    "the estimator's height where the feet stand")                                                           \
  X(ground, clip, PARAM_INT, ground.clip, "", 1, 0, 1, "1: slope <= 0 and ratio >= 1")                       \
  X(ground, ratioMin, PARAM_FLOAT, ground.ratio_min, "", 0.5f, 0.1f, 1.0f, "smallest thrust ratio believed") \
  X(ground, ratioMax, PARAM_FLOAT, ground.ratio_max, "", 2.0f, 1.0f, 5.0f, "largest thrust ratio believed")  \
  X(ground, w1, PARAM_FLOAT, ground.fixed.w[0], "", 1.0f, -5.0f, 5.0f, "constant of the curve")              \
  X(ground, w2, PARAM_FLOAT, ground.fixed.w[1], "", 0.0f, -5.0f, 5.0f, "weight of the bell at 0 mm")         \
  X(ground, w3, PARAM_FLOAT, ground.fixed.w[2], "", 0.0f, -5.0f, 5.0f, "weight of the bell at 5 mm")         \
  X(ground, w4, PARAM_FLOAT, ground.fixed.w[3], "", 0.0f, -5.0f, 5.0f, "weight of the bell at 15 mm")        \
  X(ground, w5, PARAM_FLOAT, ground.fixed.w[4], "", 0.0f, -5.0f, 5.0f, "weight of the bell at 30 mm")        \
  X(ground, w6, PARAM_FLOAT, ground.fixed.w[5], "", 0.0f, -5.0f, 5.0f, "weight of the bell at 60 mm")        \
  X(ground, w7, PARAM_FLOAT, ground.fixed.w[6], "", 0.0f, -5.0f, 5.0f, "weight of the bell at 100 mm")

#define PARAMS_RLS(X)                                                                                        \
  X(rls, form, PARAM_INT, learn.rls.form, "", 1, 0, 1,                                                       \
    "0 as the thesis prints it, 1 with a random walk of the weights")                                        \
  X(rls, lambda, PARAM_FLOAT, learn.rls.lambda, "", 1.0f, 1e-4f, 1e4f,                                       \
    "variance of the noise, relative to p0")                                                                 \
  X(rls, p0, PARAM_FLOAT, learn.rls.p0, "", 10.0f, 1e-3f, 1e4f, "variance of the weights at the start")      \
  X(rls, q, PARAM_FLOAT, learn.rls.q, "", 1e-6f, 0.0f, 1e-3f,                                                \
    "random walk per sample; below 5e-7 it is lost to rounding")                                             \
  X(rls, zMin, PARAM_FLOAT, learn.near_m, "m", 0.005f, 0.0f, 0.1f,                                           \
    "nearer than this is contact: no learning")                                                              \
  X(rls, zMax, PARAM_FLOAT, learn.far_m, "m", 0.1f, 0.01f, 4.0f, "farther than this: no learning")           \
  X(rls, blindMax, PARAM_FLOAT, learn.blind_max_s, "s", 60.0f, 0.0f, 600.0f,                                 \
    "longest time without a range sample")                                                                   \
  X(rls, upMin, PARAM_FLOAT, learn.up_min, "", 0.97f, 0.0f, 1.0f, "smallest cosine of the tilt")             \
  X(rls, tMin, PARAM_FLOAT, learn.thrust_min, "m g", 0.3f, 0.05f, 1.0f, "smallest thrust that teaches")      \
  X(rls, settle, PARAM_FLOAT, learn.settle_s, "s", 0.2f, 0.0f, 5.0f, "wait after a saturated command")       \
  X(rls, yMax, PARAM_FLOAT, learn.y_max, "", 2.5f, 1.1f, 5.0f,                                               \
    "ratios beyond this, or below its inverse, are bumps")                                                   \
  X(rls, after, PARAM_FLOAT, learn_after_s, "s", 1.0f, 0.0f, 60.0f,                                          \
    "learning starts this long after the rotors began to carry")

#define PARAMS_GUARD(X)                                                                                      \
  X(guard, safeGap, PARAM_FLOAT, guard.safe_gap_m, "m", 0.35f, 0.05f, 2.0f,                                  \
    "a retreat ends so far below the ceiling")                                                               \
  X(guard, sink, PARAM_FLOAT, guard.sink_mps, "m/s", 0.3f, 0.05f, 1.0f, "speed of a retreat")                \
  X(guard, cutAfter, PARAM_FLOAT, guard.cut_after_s, "s", 1.5f, 0.0f, 10.0f,                                 \
    "a hand-over stops the motors after this")                                                               \
  X(guard, takeOff, PARAM_FLOAT, guard.take_off_m, "m", 0.1f, 0.0f, 1.0f,                                    \
    "nearer than this to a ceiling there is no take-off")                                                    \
  X(guard, share, PARAM_FLOAT, guard.share, "", 0.9f, 0.3f, 0.99f, "of hover thrust, in a hand-over")

// Gains with the own filter: kd 9, quick 3.3 and catch 0.09 oscillate 4 % less at 20 mm than 8, 3.2 and 0.08.
// In return, where several errors of the plant meet, they need the wait after a hand-back (HEIGHT_FIT_MAX),
// and a range 40 ms older with 10 ms more delay has 2.3 mm of rms, not 2.1. If lag and delay are unknown, a
// slightly short tauMot and a slightly long delay cost least (the plant of the tables has 80 and 1 ms). walk
// 0.06 is worse at noise level `flown`.
#define PARAMS_HEIGHT(X)                                                                                     \
  X(height, own, PARAM_INT, height.own, "", 0, 0, 1,                                                         \
    "the law flies by: 0 the estimator's height and climb, 1 an own filter's while it fits")                 \
  X(height, tauMot, PARAM_FLOAT, height.tau_s, "s", 0.075f, 0.001f, 0.5f,                                    \
    "own filter: first-order lag of the motors")                                                             \
  X(height, delay, PARAM_FLOAT, height.delay_s, "s", 0.006f, 0.0f, 0.0145f,                                  \
    "own filter: delay of the command on its way to the motors")                                             \
  X(height, walk, PARAM_FLOAT, height.walk_mps2, "m/s2/rt s", 0.07f, 0.01f, 3.0f,                            \
    "own filter: how fast the disturbing force changes")                                                     \
  X(height, kp, PARAM_FLOAT, height.kp_per_s, "1/s", 5.0f, 0.05f, 20.0f, "by the own filter: indiPos.kpz")   \
  X(height, kd, PARAM_FLOAT, height.kd_per_s, "1/s", 9.0f, 0.1f, 50.0f, "by the own filter: indiPos.kdz")    \
  X(height, quick, PARAM_FLOAT, height.quick, "", 3.3f, 0.5f, 4.0f, "by the own filter: indiPos.quick")      \
  X(height, catch, PARAM_FLOAT, height.catch_s, "s", 0.09f, 0.0f, 1.0f, "by the own filter: ceil.catch")

#define FLIGHT_PARAMS(X)                                                                                     \
  PARAMS_INDIPOS(X)                                                                                          \
  PARAMS_INDIATT(X) PARAMS_CEIL(X) PARAMS_GROUND(X) PARAMS_RLS(X) PARAMS_GUARD(X) PARAMS_HEIGHT(X)

typedef enum { PARAM_FLOAT, PARAM_INT } param_type_t;

typedef struct {
  const char *name; // group.name
  const char *unit; // "" for none
  const char *help;
  param_type_t type;
  uint16_t offset; // in flight_param_t
  float initial, min, max;
} param_row_t;

extern const param_row_t params_table[];
extern const int params_count;

// Every parameter at its default.
void params_default(flight_param_t *p);

// The row called "group.name", or a null pointer.
const param_row_t *params_find(const char *name);

float params_get(const flight_param_t *p, const param_row_t *row);

// Sets one parameter. ST_BAD_PARAM: NaN, out of min..max, or a fraction for a PARAM_INT; *p is kept.
MUST_CHECK status_t params_set(flight_param_t *p, const param_row_t *row, float value);

#define PARAMS_CUTOFF_MIN_HZ     0.1f // of indiPos.cutoff, unless it is 0
#define PARAMS_ATT_CUTOFF_MIN_HZ 0.5f // of indiAtt.cutoff, unless it is 0

// Checks a whole set. ST_BAD_PARAM: a parameter is out of its range, or two contradict each other (ceil.floor
// > ceil.near, rls.zMin >= rls.zMax). The ranges alone keep rls.q <= rls.p0 and ceil.near < ceil.far.
MUST_CHECK status_t params_check(const flight_param_t *p);

#endif
