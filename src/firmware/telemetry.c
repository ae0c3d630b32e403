// telemetry.c - the app's state, its parameters and its logs. No logic.
//
// The parameters and their defaults are the rows of flight/params.h; nothing is said twice. With the stock
// logs of the same instant, indiIn, indiSet and range contain all that the flight code was given.
#include "platform_defaults.h"
#define PARAMS_YAW_ARM_M THRUST2TORQUE

#include "client.h"
#include "glue.h"
#include "log.h"
#include "param.h"

#define INITIAL(group, name, type, field, unit, initial, ...) .field = initial,
#define APP_INITIAL(name, type, field, initial, ...)          .field = initial,
glue_t glue_static = {.tuned = {FLIGHT_PARAMS(INITIAL)}, APP_PARAMS(APP_INITIAL)};

// --- parameters -------------------------------------------------------------------------------------------

#define PARAM_INT PARAM_INT32
#define ROW(group, name, type, field, ...)                                                                   \
  PARAM_ADD_WITH_CALLBACK(type | PARAM_PERSISTENT, name, &glue_static.tuned.field, client_wrote)

#define APP_ROW(name, type, field, ...) PARAM_ADD_WITH_CALLBACK(type, name, &glue_static.field, client_wrote)

// clang-format off
PARAM_GROUP_START(indiPos)
PARAMS_INDIPOS(ROW)
PARAM_GROUP_STOP(indiPos)

PARAM_GROUP_START(indiAtt)
PARAMS_INDIATT(ROW)
PARAM_GROUP_STOP(indiAtt)

PARAM_GROUP_START(ceil)
PARAMS_CEIL(ROW)
APP_PARAMS(APP_ROW)
// Made by the app at a commit; a client only stores it, after the weights.
PARAM_ADD_WITH_CALLBACK(PARAM_UINT32 | PARAM_PERSISTENT, wSum, &glue_static.weights_sum, client_wrote)
PARAM_GROUP_STOP(ceil)

PARAM_GROUP_START(ground)
PARAMS_GROUND(ROW)
PARAM_GROUP_STOP(ground)

PARAM_GROUP_START(rls)
PARAMS_RLS(ROW)
PARAM_GROUP_STOP(rls)

PARAM_GROUP_START(guard)
PARAMS_GUARD(ROW)
PARAM_GROUP_STOP(guard)

PARAM_GROUP_START(height)
PARAMS_HEIGHT(ROW)
PARAM_GROUP_STOP(height)

// --- logs -------------------------------------------------------------------------------------------------

#define F(name, field)   LOG_ADD(LOG_FLOAT, name, &glue_static.field)
#define U8(name, field)  LOG_ADD(LOG_UINT8, name, &glue_static.field)
#define U32(name, field) LOG_ADD(LOG_UINT32, name, &glue_static.field)

// This controller's command in newton and newton metres, also while the stock one flies. thrust is what the height
// loop wants; m1..m4, and total, tx, ty, tz which these four give, are after mixing and limits.
LOG_GROUP_START(indi)
F(thrust, flight.out.outer.thrust_N)
F(m1, flight.out.motors.force_N[0])
F(m2, flight.out.motors.force_N[1])
F(m3, flight.out.motors.force_N[2])
F(m4, flight.out.motors.force_N[3])
F(total, flight.out.motors.thrust_N)
F(tx, flight.out.motors.torque_b_Nm.x)
F(ty, flight.out.motors.torque_b_Nm.y)
F(tz, flight.out.motors.torque_b_Nm.z)
F(model, flight.outer.sync.thrust.model_N)
F(bias, flight.outer.bias.bias_mps2.z)
F(qw, flight.out.q_ref.w)
F(qx, flight.out.q_ref.x)
F(qy, flight.out.q_ref.y)
F(qz, flight.out.q_ref.z)
F(stock, stock_share)
U8(noYaw, flight.out.motors.gave_up_yaw)
U8(noThrust, flight.out.motors.gave_up_thrust)
U8(noTilt, flight.out.motors.gave_up_tilt)
LOG_GROUP_STOP(indi)

// Inputs as the flight code got them: SI, x forward, y left, z up.
LOG_GROUP_START(indiIn)
U32(step, in.step)
F(p, in.rate_b_radps.x)
F(q, in.rate_b_radps.y)
F(r, in.rate_b_radps.z)
F(ax, in.acc_b_mps2.x)
F(ay, in.acc_b_mps2.y)
F(az, in.acc_b_mps2.z)
F(x, in.pos_w_m.x)
F(y, in.pos_w_m.y)
F(z, in.pos_w_m.z)
F(vx, in.vel_w_mps.x)
F(vy, in.vel_w_mps.y)
F(vz, in.vel_w_mps.z)
F(qw, in.q_wb.w)
F(qx, in.q_wb.x)
F(qy, in.q_wb.y)
F(qz, in.q_wb.z)
F(f1, in.force_N[0])
F(f2, in.force_N[1])
F(f3, in.force_N[2])
F(f4, in.force_N[3])
F(up, in.range_m)
F(upAge, in.range_age_s)
U8(upNew, in.range_new)
F(down, in.down_m)
U8(noLesson, in.no_lesson)
LOG_GROUP_STOP(indiIn)

// The set point as the flight code got it; modes as axis_mode_t and yaw_mode_t.
LOG_GROUP_START(indiSet)
U8(modeX, in.setpoint.x)
U8(modeY, in.setpoint.y)
U8(modeZ, in.setpoint.z)
U8(modeYaw, in.setpoint.yaw)
U8(inBody, in.setpoint.vel_in_body)
F(x, in.setpoint.pos_w_m.x)
F(y, in.setpoint.pos_w_m.y)
F(z, in.setpoint.pos_w_m.z)
F(vx, in.setpoint.vel_mps.x)
F(vy, in.setpoint.vel_mps.y)
F(vz, in.setpoint.vel_mps.z)
F(ax, in.setpoint.acc_w_mps2.x)
F(ay, in.setpoint.acc_w_mps2.y)
F(az, in.setpoint.acc_w_mps2.z)
F(roll, in.setpoint.roll_rad)
F(pitch, in.setpoint.pitch_rad)
F(thrust, in.setpoint.thrust_N)
F(yaw, in.setpoint.yaw_rad)
F(yawRate, in.setpoint.yaw_rate_radps)
LOG_GROUP_STOP(indiSet)

// Stamps at head and end of each event of the uSD deck, which tell what rows belong together (recorder.h).
LOG_GROUP_START(indiRec)
U32(calls, recorder.calls)
U32(stepEnd, in.step)
U8(state, recorder.state)
U8(stateEnd, recorder.state)
U8(set, recorder.set)
U8(setEnd, recorder.set)
U8(tunes, recorder.tunes)
LOG_GROUP_STOP(indiRec)

// ratio includes the ground's share (ground.excess), slope is the ceiling's alone.
LOG_GROUP_START(ceil)
F(zc, flight.out.outer.zc_m)
U8(known, flight.out.outer.zc_known)
F(ratio, flight.out.outer.at.ratio)
F(slope, flight.out.outer.at.slope_per_m)
F(height, flight.out.outer.ceiling_z_m)
F(blind, flight.outer.ceiling.blind_s)
U8(decks, decks)
U8(shadow, shadow)
U8(learning, learning)
U32(commits, commits)
U32(noCommit, commits_refused)
U32(noSet, sets_refused)
LOG_GROUP_STOP(ceil)

// h: height of the feet above where they stand; excess: ratio - 1 there; pull: acceleration per height, 1/s2.
LOG_GROUP_START(ground)
F(h, flight.ground.height_m)
F(excess, flight.outer.ground.excess)
F(pull, flight.outer.ground.pull_per_s2)
F(y, flight.ground.learn.y)
U32(taught, flight.ground.learn.rls.count)
U32(refused, flight.ground.learn.refused)
F(w1, flight.ground.learn.rls.theta.w[0])
F(w2, flight.ground.learn.rls.theta.w[1])
F(w3, flight.ground.learn.rls.theta.w[2])
F(w4, flight.ground.learn.rls.theta.w[3])
F(w5, flight.ground.learn.rls.theta.w[4])
F(w6, flight.ground.learn.rls.theta.w[5])
F(w7, flight.ground.learn.rls.theta.w[6])
LOG_GROUP_STOP(ground)

LOG_GROUP_START(rls)
F(y, flight.outer.learn.y)
U32(taught, flight.outer.learn.rls.count)
U32(refused, flight.outer.learn.refused)
F(w1, flight.outer.learn.rls.theta.w[0])
F(w2, flight.outer.learn.rls.theta.w[1])
F(w3, flight.outer.learn.rls.theta.w[2])
F(w4, flight.outer.learn.rls.theta.w[3])
F(w5, flight.outer.learn.rls.theta.w[4])
F(w6, flight.outer.learn.rls.theta.w[5])
F(w7, flight.outer.learn.rls.theta.w[6])
F(p1, flight.outer.learn.rls.P[0][0])
F(p2, flight.outer.learn.rls.P[1][1])
F(p3, flight.outer.learn.rls.P[2][2])
F(p4, flight.outer.learn.rls.P[3][3])
F(p5, flight.outer.learn.rls.P[4][4])
F(p6, flight.outer.learn.rls.P[5][5])
F(p7, flight.outer.learn.rls.P[6][6])
LOG_GROUP_STOP(rls)

// Reasons as bits (flight/guard.h, flight/flyable.h): now, and all since the controller was selected.
LOG_GROUP_START(guard)
U32(now, flight.guard.now)
U32(latched, flight.guard.latched)
U8(action, flight.guard.action)
U32(notFlyable, flyable.not_flyable)
U32(badInput, flight.faults[ST_BAD_INPUT])
U32(badSet, flight.faults[ST_BAD_SETPOINT])
U32(badRange, flight.outer.faults[ST_BAD_RANGE])
U32(jump, flight.outer.faults[ST_JUMP])
U32(badState, flight.outer.faults[ST_BAD_STATE])
LOG_GROUP_STOP(guard)
// clang-format on
