// commanded.c - the firmware's commander.
#include "commanded.h"

#include <math.h>
#include <string.h>

#define PAD_BYTES      14
#define PAD_THRUST_MIN 1000 // less counts as 0
#define PAD_THRUST_MAX 60000

const pad_param_t pad_default = {.angle_roll = 1, .angle_pitch = 1};

void commanded_init(commanded_t *c) {
  memset(c, 0, sizeof *c);
  planner_init(&c->planner);
  c->pad = pad_default;
  c->pad_locked = true;
}

static void set(commanded_t *c, const setpoint_t *setpoint, commanded_priority_t priority, uint32_t now_ms) {
  if (priority < c->priority) return;
  c->set = *setpoint;
  c->set.timestamp = now_ms;
  c->priority = priority;
  if (priority == COMMANDED_CLIENT) planner_stop(&c->planner);
}

// --- set points of port 7 --------------------------------------------------------------------------------

static float number(const uint8_t *data, int i) {
  float value;
  memcpy(&value, data + 4 * i, sizeof value);
  return value;
}

static float whole(const uint8_t *data, int i) {
  return (float)(int16_t)(data[2 * i] | data[2 * i + 1] << 8);
}

// Roll, pitch and yaw rate; the caller adds height or climb rate.
static void by_angles(setpoint_t *sp, const uint8_t *data, float yaw_sign) {
  sp->mode.roll = sp->mode.pitch = modeAbs;
  sp->attitude.roll = number(data, 0);
  sp->attitude.pitch = number(data, 1);
  sp->mode.yaw = modeVelocity;
  sp->attitudeRate.yaw = yaw_sign * number(data, 2);
}

static void climb(setpoint_t *sp, const uint8_t *data) {
  by_angles(sp, data, 1.0f);
  sp->mode.z = modeVelocity;
  sp->velocity.z = number(data, 3);
}

static void at_height(setpoint_t *sp, const uint8_t *data, float yaw_sign) {
  by_angles(sp, data, yaw_sign);
  sp->mode.z = modeAbs;
  sp->position.z = number(data, 3);
}

// Velocity along x, y and z, then yaw rate.
static void by_velocity(setpoint_t *sp, const uint8_t *data, float yaw_sign) {
  sp->mode.x = sp->mode.y = sp->mode.z = sp->mode.yaw = modeVelocity;
  sp->velocity = (velocity_t){0, number(data, 0), number(data, 1), number(data, 2)};
  sp->attitudeRate.yaw = yaw_sign * number(data, 3);
}

static void hover(setpoint_t *sp, const uint8_t *data, float yaw_sign) {
  sp->mode.x = sp->mode.y = sp->mode.yaw = modeVelocity;
  sp->mode.z = modeAbs;
  sp->velocity.x = number(data, 0);
  sp->velocity.y = number(data, 1);
  sp->velocity_body = true;
  sp->attitudeRate.yaw = yaw_sign * number(data, 2);
  sp->position.z = number(data, 3);
}

static void at_position(setpoint_t *sp, const uint8_t *data) {
  sp->mode.x = sp->mode.y = sp->mode.z = sp->mode.yaw = modeAbs;
  sp->position = (point_t){0, number(data, 0), number(data, 1), number(data, 2)};
  sp->attitude.yaw = number(data, 3);
}

// A quaternion: three components of 10 bits, sign and nine of magnitude, 511 for 1/sqrt(2); the two highest
// bits say which component, the largest, is left out.
static quaternion_t quat_of(uint32_t bits) {
  const unsigned largest = bits >> 30;
  float part[4], left = 1.0f;
  for (unsigned i = 3; i < 4; i--) {
    if (i == largest) continue;
    part[i] = 0.70710678f * (float)(bits & 511) / 511.0f;
    if (bits >> 9 & 1) part[i] = -part[i];
    bits >>= 10;
    left -= part[i] * part[i];
  }
  part[largest] = sqrtf(fmaxf(left, 0.0f));
  return (quaternion_t){.x = part[0], .y = part[1], .z = part[2], .w = part[3]};
}

// Position, velocity and acceleration (mm, s), attitude, rates (mrad/s).
static void full_state(setpoint_t *sp, const uint8_t *data) {
  sp->mode.x = sp->mode.y = sp->mode.z = sp->mode.quat = modeAbs;
  const float k = 0.001f, to_deg = 0.18f / 3.14159265f;
  sp->position = (point_t){0, k * whole(data, 0), k * whole(data, 1), k * whole(data, 2)};
  sp->velocity = (velocity_t){0, k * whole(data, 3), k * whole(data, 4), k * whole(data, 5)};
  sp->acceleration = (acc_t){0, k * whole(data, 6), k * whole(data, 7), k * whole(data, 8)};
  uint32_t bits;
  memcpy(&bits, data + 18, sizeof bits);
  sp->attitudeQuaternion = quat_of(bits);
  sp->attitudeRate =
      (attitude_t){0, to_deg * whole(data, 11), to_deg * whole(data, 12), to_deg * whole(data, 13)};
}

// Roll, pitch, yaw rate, thrust in 16 bits, and whether roll and pitch are rates.
static void manual(setpoint_t *sp, const uint8_t *data) {
  const bool rates = data[14] != 0;
  sp->mode.roll = sp->mode.pitch = rates ? modeVelocity : modeAbs;
  attitude_t *const to = rates ? &sp->attitudeRate : &sp->attitude;
  to->roll = number(data, 0);
  to->pitch = number(data, 1);
  sp->mode.yaw = modeVelocity;
  sp->attitudeRate.yaw = number(data, 2);
  sp->thrust = (float)(data[12] | data[13] << 8);
}

enum {
  STOP,
  OLD_VELOCITY,
  OLD_HEIGHT,
  RADIO_CONTROL, // of an RC transmitter: not supported
  CLIMB,
  OLD_HOVER,
  FULL_STATE,
  POSITION,
  VELOCITY,
  HEIGHT,
  HOVER,
  MANUAL,
  KINDS
};

static bool decode(setpoint_t *sp, int kind, const uint8_t *data) {
  switch (kind) {
  case STOP: return true;
  case OLD_VELOCITY: by_velocity(sp, data, -1.0f); return true;
  case OLD_HEIGHT: at_height(sp, data, -1.0f); return true;
  case CLIMB: climb(sp, data); return true;
  case OLD_HOVER: hover(sp, data, -1.0f); return true;
  case FULL_STATE: full_state(sp, data); return true;
  case POSITION: at_position(sp, data); return true;
  case VELOCITY: by_velocity(sp, data, 1.0f); return true;
  case HEIGHT: at_height(sp, data, 1.0f); return true;
  case HOVER: hover(sp, data, 1.0f); return true;
  case MANUAL: manual(sp, data); return true;
  default: return false;
  }
}

// False if a number is NaN or infinite: nobody could fly it.
static bool is_finite(const setpoint_t *sp) {
  const float all[] = {sp->position.x,   sp->position.y,        sp->position.z,         sp->velocity.x,
                       sp->velocity.y,   sp->velocity.z,        sp->attitude.roll,      sp->attitude.pitch,
                       sp->attitude.yaw, sp->attitudeRate.roll, sp->attitudeRate.pitch, sp->attitudeRate.yaw};
  for (unsigned i = 0; i < sizeof all / sizeof *all; i++)
    if (!isfinite(all[i])) return false;
  return true;
}

bool commanded_take(commanded_t *c, const uint8_t *data, int size, uint32_t now_ms) {
  static const int bytes[KINDS] = {
      [OLD_VELOCITY] = 16, [OLD_HEIGHT] = 16, [CLIMB] = 16,  [OLD_HOVER] = 16, [FULL_STATE] = 28,
      [POSITION] = 16,     [VELOCITY] = 16,   [HEIGHT] = 16, [HOVER] = 16,     [MANUAL] = 15};
  const int kind = size > 0 ? data[0] : KINDS;
  setpoint_t sp = {.thrust = 0.0f};
  if (kind >= KINDS || size - 1 < bytes[kind] || !decode(&sp, kind, data + 1) || !is_finite(&sp))
    return false;
  set(c, &sp, COMMANDED_CLIENT, now_ms);
  return true;
}

// --- a game pad -------------------------------------------------------------------------------------------

static void tilt(setpoint_t *sp, const pad_param_t *p, float roll, float pitch) {
  sp->mode.roll = p->angle_roll ? modeAbs : modeVelocity;
  sp->mode.pitch = p->angle_pitch ? modeAbs : modeVelocity;
  *(p->angle_roll ? &sp->attitude.roll : &sp->attitudeRate.roll) = roll;
  *(p->angle_pitch ? &sp->attitude.pitch : &sp->attitudeRate.pitch) = pitch;
}

bool commanded_take_pad(commanded_t *c, const uint8_t *data, int size, uint32_t now_ms) {
  if (size < PAD_BYTES) return false;
  const float roll = number(data, 0), pitch = number(data, 1), yaw = number(data, 2);
  if (!isfinite(roll) || !isfinite(pitch) || !isfinite(yaw)) return false;
  const pad_param_t *const p = &c->pad;
  const int thrust = data[12] | data[13] << 8;
  if (c->priority == COMMANDED_NOBODY) c->pad_locked = true;
  if (thrust == 0) c->pad_locked = false;
  setpoint_t sp = {.thrust = 0.0f};
  if (!c->pad_locked && thrust >= PAD_THRUST_MIN) sp.thrust = fminf((float)thrust, PAD_THRUST_MAX);
  if (p->alt_hold) {
    sp.thrust = 0.0f;
    sp.mode.z = modeVelocity;
    sp.velocity.z = ((float)thrust - 32767.0f) / 32767.0f;
  }
  const bool places = !p->pos_hold && p->pos_set && thrust != 0;
  if (p->pos_hold) {
    sp.mode.x = sp.mode.y = modeVelocity;
    sp.velocity.x = pitch / 30.0f;
    sp.velocity.y = roll / 30.0f;
  } else if (places) {
    sp.thrust = 0.0f;
    sp.mode.x = sp.mode.y = sp.mode.z = sp.mode.yaw = modeAbs;
    sp.position = (point_t){0, -pitch, roll, (float)thrust / 1000.0f};
    sp.attitude.yaw = yaw;
  } else {
    tilt(&sp, p, roll, pitch);
  }
  if (!p->pos_set) {
    sp.mode.yaw = p->angle_yaw ? modeAbs : modeVelocity;
    *(p->angle_yaw ? &sp.attitude.yaw : &sp.attitudeRate.yaw) = p->angle_yaw ? yaw : -yaw;
  }
  set(c, &sp, COMMANDED_CLIENT, now_ms);
  return true;
}

// --- who may ----------------------------------------------------------------------------------------------

void commanded_relax(commanded_t *c) {
  planner_tell(&c->planner, &c->state);
  c->priority = COMMANDED_PLANNER;
}

void commanded_let_go(commanded_t *c) {
  c->priority = COMMANDED_NOBODY;
}

setpoint_t commanded_now(commanded_t *c, const state_t *state, bool can_fly, uint32_t step, uint32_t now_ms) {
  planner_block(&c->planner, !can_fly);
  setpoint_t planned = {.thrust = 0.0f};
  const bool due = step % PLANNER_PERIOD_MS == 0;
  if (can_fly && due && planner_setpoint(&c->planner, state, now_ms, &planned))
    set(c, &planned, COMMANDED_PLANNER, now_ms);
  c->state = *state;
  return c->set;
}
