// mixer.c - torques and thrust to four motor forces.
#include "flight/mixer.h"

mixer_out_t mixer_of(const mixer_param_t *p, const float force_N[MOTORS]) {
  mixer_out_t out;
  for (int i = 0; i < MOTORS; i++) out.force_N[i] = force_N[i];
  out.torque_b_Nm = mixer_torque(p, out.force_N);
  out.thrust_N = mixer_thrust_N(out.force_N);
  out.gave_up_yaw = out.gave_up_thrust = out.gave_up_tilt = false;
  return out;
}

// The share so far, made smaller where `need` times it does not fit into a motor's room.
static inline float that_fits(float share, float need, float room) {
  return need * share > room ? f_max(room, 0.0f) / need : share;
}

// The largest share of yaw, 0..1, that keeps base -+ share yaw within 0..max.
static float yaw_share_of(const float base[MOTORS], float yaw_N, float max) {
  if (yaw_N > 0.0f) {
    float share = that_fits(1.0f, yaw_N, base[0]);
    share = that_fits(share, yaw_N, max - base[1]);
    share = that_fits(share, yaw_N, base[2]);
    return that_fits(share, yaw_N, max - base[3]);
  }
  float share = that_fits(1.0f, -yaw_N, max - base[0]);
  share = that_fits(share, -yaw_N, base[1]);
  share = that_fits(share, -yaw_N, max - base[2]);
  return that_fits(share, -yaw_N, base[3]);
}

mixer_out_t mixer_mix(const mixer_param_t *p, v3_t torque_b_Nm, float thrust_N) {
  const float max = p->force_max_N, arms_m = 4.0f * p->arm_m;
  const float roll = torque_b_Nm.x / arms_m, pitch = torque_b_Nm.y / arms_m;
  const float yaw_N = torque_b_Nm.z / (4.0f * p->yaw_m);
  // Of roll and pitch the extremes are +-(|roll| + |pitch|): their span must fit between 0 and max.
  const float half_span = fabsf(roll) + fabsf(pitch);
  const float tilt_share = 2.0f * half_span > max ? max / (2.0f * half_span) : 1.0f;
  const float span = tilt_share * half_span;
  const float lift = f_clamp(0.25f * thrust_N, span, max - span);

  const float same = tilt_share * (roll + pitch), other = tilt_share * (roll - pitch);
  const float base[MOTORS] = {lift - same, lift - other, lift + same, lift + other};
  const float yaw_share = yaw_share_of(base, yaw_N, max), turn = yaw_share * yaw_N;

  mixer_out_t out;
  out.force_N[0] = f_clamp(base[0] - turn, 0.0f, max);
  out.force_N[1] = f_clamp(base[1] + turn, 0.0f, max);
  out.force_N[2] = f_clamp(base[2] - turn, 0.0f, max);
  out.force_N[3] = f_clamp(base[3] + turn, 0.0f, max);
  out.torque_b_Nm = mixer_torque(p, out.force_N);
  out.thrust_N = mixer_thrust_N(out.force_N);
  out.gave_up_tilt = tilt_share < 1.0f;
  out.gave_up_thrust = fabsf(4.0f * lift - thrust_N) > 1e-6f * max;
  out.gave_up_yaw = yaw_share < 1.0f;
  return out;
}
