// mixer.c - torques and thrust to four motor forces.
#include "flight/mixer.h"

// Signs of roll, pitch and yaw in the motors' forces.
static const float ROLL[MOTORS] = {-1.0f, -1.0f, 1.0f, 1.0f};
static const float PITCH[MOTORS] = {-1.0f, 1.0f, 1.0f, -1.0f};
static const float YAW[MOTORS] = {-1.0f, 1.0f, -1.0f, 1.0f};

mixer_out_t mixer_of(const mixer_param_t *p, const float force_N[MOTORS]) {
  mixer_out_t out = {.thrust_N = 0.0f};
  for (int i = 0; i < MOTORS; i++) {
    out.force_N[i] = force_N[i];
    out.thrust_N += force_N[i];
    out.torque_b_Nm.x += p->arm_m * ROLL[i] * force_N[i];
    out.torque_b_Nm.y += p->arm_m * PITCH[i] * force_N[i];
    out.torque_b_Nm.z += p->yaw_m * YAW[i] * force_N[i];
  }
  return out;
}

// The largest share of `part`, 0..1, that keeps base + share part within 0..max.
static float share_that_fits(const float base[MOTORS], const float part[MOTORS], float max) {
  float share = 1.0f;
  for (int i = 0; i < MOTORS; i++) {
    const float room = part[i] > 0.0f ? max - base[i] : base[i];
    const float need = fabsf(part[i]);
    if (need * share > room) share = f_max(room, 0.0f) / need;
  }
  return share;
}

mixer_out_t mixer_mix(const mixer_param_t *p, v3_t torque_b_Nm, float thrust_N) {
  const float max = p->force_max_N;
  const float roll = torque_b_Nm.x / (4.0f * p->arm_m), pitch = torque_b_Nm.y / (4.0f * p->arm_m);
  // Of roll and pitch the extremes are +-(|roll| + |pitch|): their span must fit between 0 and max.
  const float half_span = fabsf(roll) + fabsf(pitch);
  const float tilt_share = 2.0f * half_span > max ? max / (2.0f * half_span) : 1.0f;
  const float lift = f_clamp(0.25f * thrust_N, tilt_share * half_span, max - tilt_share * half_span);

  float force_N[MOTORS], yaw_N[MOTORS];
  for (int i = 0; i < MOTORS; i++) {
    force_N[i] = lift + tilt_share * (ROLL[i] * roll + PITCH[i] * pitch);
    yaw_N[i] = YAW[i] * torque_b_Nm.z / (4.0f * p->yaw_m);
  }
  const float yaw_share = share_that_fits(force_N, yaw_N, max);
  for (int i = 0; i < MOTORS; i++) force_N[i] = f_clamp(force_N[i] + yaw_share * yaw_N[i], 0.0f, max);

  mixer_out_t out = mixer_of(p, force_N);
  out.gave_up_tilt = tilt_share < 1.0f;
  out.gave_up_thrust = fabsf(4.0f * lift - thrust_N) > 1e-6f * max;
  out.gave_up_yaw = yaw_share < 1.0f;
  return out;
}
