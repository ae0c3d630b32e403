// crazyflie_ms.c - a millisecond of a Crazyflie on the host.
#include "crazyflie.h"

#include "base/constants.h"
#include "base/either.h"
#include "base/few.h"
#include "controller.h"
#include "plant/rotor.h"
#include "range.h"
#include "stand_in.h"
#include <math.h>
#include <string.h>

#define RANGE_NONE_M 32.767f
#define UNIT_MAX     65535.0

#define TO_FIRMWARE(to, scale, from)                                                                         \
  do {                                                                                                       \
    (to).x = (float)((scale) * (from).x);                                                                    \
    (to).y = (float)((scale) * (from).y);                                                                    \
    (to).z = (float)((scale) * (from).z);                                                                    \
  } while (0)

// Skipped while the estimate does not turn, as in most milliseconds: the angles cost more than all the rest.
static void take_attitude(crazyflie_t *c, dq_t q_wb) {
  if (same_in_bits(&q_wb, &c->q_wb, sizeof q_wb)) return;
  c->q_wb = q_wb;
  const stock_angles_t angles = stock_angles(q_wb);
  c->state.attitude.roll = (float)angles.roll_deg;
  c->state.attitude.pitch = (float)angles.pitch_deg;
  c->state.attitude.yaw = (float)angles.yaw_deg;
  TO_FIRMWARE(c->state.attitudeQuaternion, 1.0, q_wb);
  c->state.attitudeQuaternion.w = (float)q_wb.w;
}

static void measure(crazyflie_t *c, const pilot_in_t *in) {
  sensorData_t *const sensors = &c->sensors;
  state_t *const state = &c->state;
  TO_FIRMWARE(sensors->acc, 1.0 / G_MPS2, in->acc_b_mps2);
  TO_FIRMWARE(sensors->gyro, DEG_PER_RAD, in->gyro_b_radps);
  TO_FIRMWARE(state->position, 1.0, in->pos_w_m);
  TO_FIRMWARE(state->velocity, 1.0, in->vel_w_mps);
  take_attitude(c, in->q_wb);
}

static stab_mode_t mode_of(pilot_mode_t mode) {
  return mode == PILOT_POSITION ? modeAbs : mode == PILOT_VELOCITY ? modeVelocity : modeDisable;
}

static setpoint_t order(const crazyflie_t *c, const pilot_setpoint_t *set) {
  const bool level = set->mode[0] == PILOT_OFF || set->mode[1] == PILOT_OFF;
  setpoint_t sp = {
      .attitude = {.yaw = (float)(DEG_PER_RAD * set->yaw_rad)},
      .attitudeRate = {.yaw = set->yaw_by_rate ? (float)(DEG_PER_RAD * set->yaw_rate_radps) : 0.0f},
      .thrust = (float)(UNIT_MAX * set->thrust_N / (PILOT_MOTORS * c->firmware.thrust_max_N)),
      .velocity_body = set->vel_in_body,
      .mode = {.x = mode_of(set->mode[0]),
               .y = mode_of(set->mode[1]),
               .z = mode_of(set->mode[2]),
               .roll = level ? modeAbs : modeDisable,
               .pitch = level ? modeAbs : modeDisable,
               .yaw = set->yaw_by_rate ? modeVelocity : modeAbs},
  };
  TO_FIRMWARE(sp.position, 1.0, set->pos_w_m);
  TO_FIRMWARE(sp.velocity, 1.0, set->vel_mps);
  TO_FIRMWARE(sp.acceleration, 1.0, set->acc_w_mps2);
  return sp;
}

// Converts the set point only when it has changed: most stay for seconds.
static void take_order(crazyflie_t *c, const pilot_setpoint_t *set) {
  if (ANY(!c->ordered) || !same_in_bits(set, &c->asked, sizeof *set)) {
    memcpy(&c->asked, set, sizeof *set);
    c->setpoint = order(c, set);
  }
  c->setpoint.timestamp = c->around.clock_ms;
}

// Truncates metres to whole millimetres in 16 bits, as the firmware does.
static uint16_t whole_mm(float m) {
  return (uint16_t)fminf(fmaxf(m * 1000.0f, 0.0f), 65535.0f);
}

static void range(crazyflie_t *c, const pilot_in_t *in) {
  uint16_t *const mm = c->around.range_mm;
  if (ANY(in->down_new))
    mm[rangeDown] = (uint16_t)EITHER(in->down_new, whole_mm((float)in->down_m), mm[rangeDown]);
  if (!ANY(in->range_new)) return;
  const float m = EITHER(isnan(in->range_m), RANGE_NONE_M, (float)in->range_m);
  mm[rangeUp] = (uint16_t)EITHER(in->range_new, whole_mm(m), mm[rangeUp]);
}

// The firmware's power distribution, in the two modes that the app and the stock controller command.
static void distribute(const control_t *control, double unit[PILOT_MOTORS]) {
  if (control->controlMode == controlModeLegacy) {
    const stock_command_t command = {.thrust = (double)control->thrust,
                                     .roll = control->roll,
                                     .pitch = control->pitch,
                                     .yaw = control->yaw};
    stock_mix(&command, unit);
    return;
  }
  const few_t none = few_all(0.0), all = few_all(1.0);
  for (int i = 0; i < PILOT_MOTORS; i++) unit[i] = (double)control->normalizedForces[i];
  for (int i = 0; i < PILOT_MOTORS; i += FEW_N) // NaN becomes 0
    few_put(unit + i, few_trunc(UNIT_MAX * few_min(few_max(few_of(unit + i), none), all)));
}

static void drive(crazyflie_t *c, const pilot_in_t *in, double motor_N[PILOT_MOTORS]) {
  double unit[PILOT_MOTORS] = {0.0}, duty[PILOT_MOTORS];
  const bool allowed = c->around.motors_allowed;
  if (ANY(allowed)) distribute(&c->control, unit);
  for (int i = 0; i < PILOT_MOTORS; i++) unit[i] = EITHER(allowed, unit[i], 0.0);
  if (c->compensates)
    stock_power_duty(&c->power, &c->firmware, unit, in->vbat_V, duty);
  else
    memcpy(duty, unit, sizeof duty);
  c->around.battery_V = (float)in->vbat_V;
  rotor_commands_N(&c->map, duty, in->vbat_V, c->firmware.thrust_max_N, motor_N);
  for (int i = 0; i < PILOT_MOTORS; i++) {
    c->around.duty[i] = (uint16_t)duty[i];
  }
}

// Starts with the forces that the controller before commanded.
static void take_over(crazyflie_t *c, const pilot_in_t *in) {
  c->control.controlMode = controlModeForce;
  bool flies = false;
  for (int i = 0; i < PILOT_MOTORS; i++) {
    c->control.normalizedForces[i] = (float)(in->applied_N[i] / c->firmware.thrust_max_N);
    flies = flies || in->applied_N[i] > 0.0;
  }
  if (!c->command) c->supervised = supervised_begun(flies, c->around.clock_ms);
  c->power.supply_V = in->vbat_V;
  c->around.battery_V = (float)in->vbat_V;
  c->called = true;
}

static bool acts(const stand_in_t *around) {
  for (int i = 0; i < PILOT_MOTORS; i++)
    if (around->duty[i] > 0) return true;
  return false;
}

static void supervise(crazyflie_t *c) {
  const Axis3f acc = c->sensors.acc;
  const supervised_in_t in = {.now_ms = c->around.clock_ms,
                              .motors = acts(&c->around),
                              .acc_g = {acc.x, acc.y, acc.z},
                              .setpoint_ms = c->setpoint.timestamp,
                              .fed_ms = c->around.fed_ms,
                              .stop = c->stop};
  if (!supervised_update(&c->supervised, &c->supervised_by, &in)) return;
  if (c->supervised.state == SUPERVISED_LOCKED) stand_in_print("SUP: Locked, reboot required\n");
  if (c->supervised.state == SUPERVISED_CRASHED) stand_in_print("SUP: Crashed, recovery required\n");
}

// Overrides the set point to level out or to stop. True if it did.
static bool override(const supervised_t *s, setpoint_t *set) {
  const bool levels = s->state == SUPERVISED_LEVEL_OUT, stops = !levels && !supervised_motors_run(s);
  FOR_WHOM(levels, set) {
    set->mode.x = set->mode.y = modeDisable;
    set->mode.roll = set->mode.pitch = modeAbs;
    set->mode.yaw = modeVelocity;
    set->attitude.roll = set->attitude.pitch = 0.0f;
    set->attitudeRate.yaw = 0.0f;
  }
  FOR_WHOM(stops, set) *set = (setpoint_t){.thrust = 0.0f};
  return levels || stops;
}

static void fly(crazyflie_t *c, const pilot_in_t *in) {
  c->now = in;
  if (c->fly)
    c->fly(c->fly_context, &c->control, &c->setpoint, &c->sensors, &c->state, in->step);
  else
    controllerOutOfTree(&c->control, &c->setpoint, &c->sensors, &c->state, in->step);
}

static pilot_mode_t pilot_mode(stab_mode_t mode) {
  return mode == modeAbs ? PILOT_POSITION : mode == modeVelocity ? PILOT_VELOCITY : PILOT_OFF;
}

// Converts the firmware's set point to that of the host's controllers: the inverse of order().
static pilot_setpoint_t as_pilot(const crazyflie_t *c, const setpoint_t *sp) {
  const double k = RAD_PER_DEG;
  const bool tilts = sp->mode.roll == modeAbs && sp->mode.pitch == modeAbs;
  return (pilot_setpoint_t){
      .mode = {pilot_mode(sp->mode.x), pilot_mode(sp->mode.y), pilot_mode(sp->mode.z)},
      .pos_w_m = {(double)sp->position.x, (double)sp->position.y, (double)sp->position.z},
      .vel_in_body = sp->velocity_body,
      .vel_mps = {(double)sp->velocity.x, (double)sp->velocity.y, (double)sp->velocity.z},
      .acc_w_mps2 = {(double)sp->acceleration.x, (double)sp->acceleration.y, (double)sp->acceleration.z},
      .roll_rad = tilts ? k * (double)sp->attitude.roll : 0.0,
      .pitch_up_rad = tilts ? k * (double)sp->attitude.pitch : 0.0,
      .yaw_by_rate = sp->mode.yaw != modeAbs,
      .yaw_rad = k * (double)sp->attitude.yaw,
      .yaw_rate_radps = sp->mode.yaw == modeVelocity ? k * (double)sp->attitudeRate.yaw : 0.0,
      .thrust_N = (double)sp->thrust * PILOT_MOTORS * c->firmware.thrust_max_N / UNIT_MAX,
  };
}

PAIR_COPIES void crazyflie_ms(crazyflie_t *c, const pilot_in_t *in, double motor_N[PILOT_MOTORS]) {
  stand_in = &c->around;
  if (!c->called) take_over(c, in);
  measure(c, in);
  range(c, in);
  if (c->command)
    c->setpoint = c->command(c->command_context, &c->state, in->step);
  else
    take_order(c, &in->set);
  const bool may = supervised_can_fly(&c->supervised);
  FOR_WHOM(!may, &c->setpoint) c->setpoint = (setpoint_t){.timestamp = 0};
  FOR_WHOM(in->step % SUPERVISED_PERIOD_MS == 0, &c->supervised) supervise(c);
  const bool overridden = override(&c->supervised, &c->setpoint);
  c->ordered = !c->command && may && !overridden; // else the next call converts it again
  c->around.can_fly = supervised_can_fly(&c->supervised);
  c->around.flying = supervised_flies(&c->supervised);
  c->around.motors_allowed = supervised_motors_run(&c->supervised);
  if (c->command) {
    pilot_in_t told = *in;
    told.set = as_pilot(c, &c->setpoint);
    fly(c, &told);
  } else {
    fly(c, in);
  }
  drive(c, in, motor_N);
  c->around.clock_ms++;
}
