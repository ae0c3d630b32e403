// firmware_logs.c - the stock firmware's logs, as its modules would fill them.
#include "firmware.h"

#include "base/constants.h"
#include "range.h"
#include "stock_units.h"
#include "values.h"
#include <math.h>

#define EMPTY_V        3.0  // battery level 0 %
#define FULL_V         4.1  // 100 %
#define LOW_BATTERY_MS 5000 // below pm.lowVoltage for longer is low power

#define TAKE(to, a, b, c, from)                                                                              \
  do {                                                                                                       \
    (to##_##a) = (from).x;                                                                                   \
    (to##_##b) = (from).y;                                                                                   \
    (to##_##c) = (from).z;                                                                                   \
  } while (0)

static void look_at_estimate(stock_logs_t *l, const firmware_t *f) {
  const state_t *const s = &f->vehicle.state;
  const quaternion_t q = s->attitudeQuaternion;
  TAKE(l->stateEstimate, x, y, z, s->position);
  TAKE(l->stateEstimate, vx, vy, vz, s->velocity);
  TAKE(l->stateEstimate, qx, qy, qz, q);
  l->stateEstimate_qw = q.w;
  // Specific force in world axes, gravity taken off; g.
  const Axis3f a = f->vehicle.sensors.acc;
  l->stateEstimate_ax = a.x * (1 - 2 * (q.y * q.y + q.z * q.z)) +
                        2 * (a.y * (q.x * q.y - q.z * q.w) + a.z * (q.x * q.z + q.y * q.w));
  l->stateEstimate_ay = a.y * (1 - 2 * (q.x * q.x + q.z * q.z)) +
                        2 * (a.x * (q.x * q.y + q.z * q.w) + a.z * (q.y * q.z - q.x * q.w));
  l->stateEstimate_az = a.z * (1 - 2 * (q.x * q.x + q.y * q.y)) +
                        2 * (a.x * (q.x * q.z - q.y * q.w) + a.y * (q.y * q.z + q.x * q.w)) - 1.0f;
  l->stateEstimate_roll = l->stabilizer_roll = s->attitude.roll;
  l->stateEstimate_pitch = l->stabilizer_pitch = s->attitude.pitch;
  l->stateEstimate_yaw = l->stabilizer_yaw = s->attitude.yaw;
  TAKE(l->kalman, stateX, stateY, stateZ, s->position);
  TAKE(l->kalman, statePX, statePY, statePZ, s->velocity);
  l->kalman_varX = f->variance[0], l->kalman_varY = f->variance[1], l->kalman_varZ = f->variance[2];
  l->kalman_varPX = f->variance[3], l->kalman_varPY = f->variance[4], l->kalman_varPZ = f->variance[5];
}

static void look_at_target(stock_logs_t *l, const setpoint_t *sp) {
  TAKE(l->ctrltarget, x, y, z, sp->position);
  TAKE(l->ctrltarget, vx, vy, vz, sp->velocity);
  TAKE(l->ctrltarget, ax, ay, az, sp->acceleration);
  TAKE(l->posCtl, targetX, targetY, targetZ, sp->position);
  TAKE(l->posCtl, targetVX, targetVY, targetVZ, sp->velocity);
  l->ctrltarget_roll = sp->attitude.roll;
  l->ctrltarget_pitch = sp->attitude.pitch;
  l->ctrltarget_yaw = sp->attitudeRate.yaw; // as in the firmware
}

// The last values of the stock PID. They stand still while another controller flies.
static void look_at_stock(stock_logs_t *l, const stock_pid_t *pid) {
  const stock_command_t *const c = &pid->command;
  l->controller_cmd_roll = (float)c->roll, l->controller_cmd_pitch = (float)c->pitch;
  l->controller_cmd_yaw = (float)c->yaw, l->controller_cmd_thrust = (float)c->thrust;
  l->controller_actuatorThrust = (float)pid->wanted.thrust;
  l->controller_roll = (float)pid->wanted.roll_deg;
  l->controller_pitch = (float)pid->wanted.pitch_deg;
  l->controller_yaw = (float)pid->yaw_deg;
  l->controller_rollRate = (float)pid->rate_dps[0];
  l->controller_pitchRate = (float)pid->rate_dps[1];
  l->controller_yawRate = (float)pid->rate_dps[2];
  l->controller_r_roll = (float)(RAD_PER_DEG * pid->gyro_dps.x);
  l->controller_r_pitch = (float)(-RAD_PER_DEG * pid->gyro_dps.y);
  l->controller_r_yaw = (float)(RAD_PER_DEG * pid->gyro_dps.z);
  l->controller_accelz = (float)pid->acc_z_g;
}

// Logged whichever controller flies. control_t is a union: in the app's mode these are the command of motor
// 3, and half the bits of that of motor 2.
static void look_at_command(stock_logs_t *l, const control_t *c) {
  l->stabilizer_thrust = c->thrust;
  l->controller_ctr_yaw = c->yaw;
}

static void look_at_motors(stock_logs_t *l, const stand_in_t *around) {
  const uint16_t *const duty = around->duty;
  l->motor_m1 = duty[0], l->motor_m2 = duty[1], l->motor_m3 = duty[2], l->motor_m4 = duty[3];
  l->motor_m1req = duty[0], l->motor_m2req = duty[1], l->motor_m3req = duty[2], l->motor_m4req = duty[3];
}

static void look_at_battery(stock_logs_t *l, firmware_t *f) {
  const float volt = f->vehicle.around.battery_V;
  const uint32_t now_ms = firmware_now_ms(f);
  const double share = ((double)volt - EMPTY_V) / (FULL_V - EMPTY_V);
  if (volt >= f->params.pm_lowVoltage) f->good_ms = now_ms;
  l->pm_vbat = volt;
  l->pm_vbatMV = (uint16_t)(1000.0f * volt);
  l->pm_batteryLevel = (uint8_t)(10.0 * trunc(10.0 * fmin(fmax(share, 0.0), 1.0)));
  l->pm_state = now_ms - f->good_ms > LOW_BATTERY_MS ? 3 : 0; // 3: low power; 0: on battery
}

static void look_at_supervisor(stock_logs_t *l, const firmware_t *f) {
  const supervised_t *const s = &f->vehicle.supervised;
  const Axis3f a = f->vehicle.sensors.acc;
  l->sys_canfly = supervised_can_fly(s), l->sys_isFlying = supervised_flies(s);
  l->sys_isTumbled = s->tumbled;
  l->supervisor_info = firmware_info(f);
  l->supervisor_accNorm = sqrtf(a.x * a.x + a.y * a.y + a.z * a.z);
}

static void look_at_ranges(stock_logs_t *l, const firmware_t *f) {
  const uint16_t *const mm = f->vehicle.around.range_mm;
  l->range_front = mm[rangeFront], l->range_back = mm[rangeBack];
  l->range_left = mm[rangeLeft], l->range_right = mm[rangeRight];
  l->range_up = mm[rangeUp], l->range_zrange = mm[rangeDown];
}

void firmware_look(firmware_t *f) {
  stock_logs_t *const l = &f->logs;
  look_at_estimate(l, f);
  look_at_target(l, &f->vehicle.setpoint);
  look_at_command(l, &f->vehicle.control);
  look_at_stock(l, &f->vehicle.stock);
  look_at_motors(l, &f->vehicle.around);
  look_at_battery(l, f);
  look_at_supervisor(l, f);
  look_at_ranges(l, f);
  TAKE(l->acc, x, y, z, f->vehicle.sensors.acc);
  TAKE(l->gyro, x, y, z, f->vehicle.sensors.gyro);
  l->radio_rssi = 40, l->radio_isConnected = 1;
}
