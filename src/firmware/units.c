// units.c - the border between the firmware's units, signs and frames, and ours.
#include "units.h"

#include "flight/trig.h"
#include "glue.h"
#include "platform_defaults.h"

#define RAD_PER_DEG 0.017453293f
#define UNITS_MAX   65535.0f

#define V3_OF(a) ((v3_t){(a).x, (a).y, (a).z})

void units_sensors(flight_in_t *in, const sensorData_t *sensors, const state_t *state) {
  const quaternion_t q = state->attitudeQuaternion;
  in->rate_b_radps = v3_scale(RAD_PER_DEG, V3_OF(sensors->gyro));
  in->acc_b_mps2 = v3_scale(GRAVITY_MPS2, V3_OF(sensors->acc));
  in->pos_w_m = V3_OF(state->position);
  in->vel_w_mps = V3_OF(state->velocity);
  in->q_wb = (quat_t){q.w, q.x, q.y, q.z};
}

static axis_mode_t axis_of(stab_mode_t mode) {
  return mode == modeAbs ? AXIS_POSITION : mode == modeVelocity ? AXIS_VELOCITY : AXIS_OFF;
}

// Full-state set points give the heading by a quaternion.
static float yaw_of(const quaternion_t *q) {
  return trig_angle(2.0f * (q->w * q->z + q->x * q->y), 1.0f - 2.0f * (q->y * q->y + q->z * q->z));
}

void units_setpoint(flight_setpoint_t *to, const setpoint_t *sp) {
  const bool by_angle = sp->mode.roll == modeAbs && sp->mode.pitch == modeAbs;
  const bool by_quat = sp->mode.yaw == modeDisable && sp->mode.quat == modeAbs;
  to->x = axis_of(sp->mode.x);
  to->y = axis_of(sp->mode.y);
  to->z = axis_of(sp->mode.z);
  to->pos_w_m = V3_OF(sp->position);
  to->vel_mps = V3_OF(sp->velocity);
  to->vel_in_body = sp->velocity_body;
  to->acc_w_mps2 = V3_OF(sp->acceleration);
  to->roll_rad = by_angle ? RAD_PER_DEG * sp->attitude.roll : 0.0f;
  to->pitch_rad = by_angle ? -RAD_PER_DEG * sp->attitude.pitch : 0.0f;
  to->thrust_N = sp->thrust * (MOTORS * THRUST_MAX / UNITS_MAX);
  to->yaw = sp->mode.yaw == modeAbs || by_quat ? YAW_ANGLE : YAW_RATE;
  to->yaw_rad = by_quat ? yaw_of(&sp->attitudeQuaternion) : RAD_PER_DEG * sp->attitude.yaw;
  // A set point of zeros asks for nothing: its rate is left over from before.
  to->yaw_rate_radps = sp->mode.yaw == modeDisable && !by_quat ? 0.0f : RAD_PER_DEG * sp->attitudeRate.yaw;
}

unsigned units_not_flown(const setpoint_t *sp) {
  const setpoint_mode_t *const m = &sp->mode;
  const unsigned rates = m->roll == modeVelocity || m->pitch == modeVelocity ? NOT_FLOWN_RATES : 0;
  if (m->quat != modeAbs) return rates;
  if (m->x == modeDisable || m->y == modeDisable) return rates | NOT_FLOWN_QUAT;
  return sp->attitudeRate.roll != 0.0f || sp->attitudeRate.pitch != 0.0f ? rates | NOT_FLOWN_TURN : rates;
}

// --- motors -----------------------------------------------------------------------------------------------

// Which motors a positive roll, pitch and yaw adds to; in the legacy mode pitch and yaw have the other sign.
static const float ROLL[MOTORS] = {-1.0f, -1.0f, 1.0f, 1.0f};
static const float PITCH[MOTORS] = {-1.0f, 1.0f, 1.0f, -1.0f};
static const float YAW[MOTORS] = {-1.0f, 1.0f, -1.0f, 1.0f};

static float legacy_N(const control_t *c, int i) {
  const float tilt = 0.5f * (ROLL[i] * (float)c->roll - PITCH[i] * (float)c->pitch);
  return (c->thrust + tilt - YAW[i] * (float)c->yaw) * (THRUST_MAX / UNITS_MAX);
}

static float torque_N(const control_t *c, int i) {
  const float arm_m = 0.70710678f * ARM_LENGTH;
  const float tilt_N = (ROLL[i] * c->torqueX + PITCH[i] * c->torqueY) / arm_m;
  return 0.25f * (c->thrustSi + tilt_N + YAW[i] * c->torqueZ / THRUST2TORQUE);
}

static float others_N(const control_t *c, int i) {
  switch (c->controlMode) {
  case controlModeLegacy: return legacy_N(c, i);
  case controlModeForceTorque: return torque_N(c, i);
  default: return 0.0f;
  }
}

// The firmware stops a motor below THRUST_MIN (11 %). The force counts as commanded all the same: otherwise
// thrust that is built up from increments, as at a take-off, would never get beyond it.
void units_applied(float force_N[MOTORS], const control_t *control) {
  if (control->controlMode == controlModeForce)
    for (int i = 0; i < MOTORS; i++)
      force_N[i] = f_clamp(THRUST_MAX * control->normalizedForces[i], 0.0f, THRUST_MAX);
  else
    for (int i = 0; i < MOTORS; i++) force_N[i] = f_clamp(others_N(control, i), 0.0f, THRUST_MAX);
}

void units_command(control_t *control, const float force_N[MOTORS]) {
  control->controlMode = controlModeForce;
  for (int i = 0; i < MOTORS; i++)
    control->normalizedForces[i] = f_clamp(force_N[i] / THRUST_MAX, 0.0f, 1.0f);
}
