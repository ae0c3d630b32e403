// mixer.c - torques and thrust to four motor forces.
#include "flight/mixer.h"

#define ASKED_MAX_N 1e30f // of a motor's share of a torque: what is larger would overflow below

mixer_out_t mixer_of(const mixer_param_t *p, const float force_N[MOTORS]) {
  return (mixer_out_t){
      .force_N = {force_N[0], force_N[1], force_N[2], force_N[3]},
      .torque_b_Nm = mixer_torque(p, force_N),
      .thrust_N = mixer_thrust_N(force_N),
  };
}

mixer_out_t mixer_mix(const mixer_param_t *p, v3_t torque_b_Nm, float thrust_N) {
  const float max = p->force_max_N, arms_m = 4.0f * p->arm_m;
  // A torque of NaN counts as 0: clamped as a force it would stop all motors.
  const float roll = f_bound(torque_b_Nm.x / arms_m, ASKED_MAX_N);
  const float pitch = f_bound(torque_b_Nm.y / arms_m, ASKED_MAX_N);
  const float yaw_N = f_bound(torque_b_Nm.z / (4.0f * p->yaw_m), ASKED_MAX_N);
  // The extremes of roll and pitch are +-(|roll| + |pitch|): their span must fit between 0 and max.
  const float half_span = fabsf(roll) + fabsf(pitch);
  const float tilt_share = EITHER(2.0f * half_span > max, max / (2.0f * half_span), 1.0f);
  const float span = tilt_share * half_span;
  const float lift = f_clamp(0.25f * thrust_N, span, max - span);

  // Motors 1 and 3 lie at lift -+ same, 2 and 4 at lift -+ other. What yaw takes from one pair it gives to
  // the other: the smallest room of the four bounds it.
  const float same = tilt_share * (roll + pitch), other = tilt_share * (roll - pitch);
  const float down_1_3 = lift - fabsf(same), up_1_3 = max - lift - fabsf(same);
  const float down_2_4 = lift - fabsf(other), up_2_4 = max - lift - fabsf(other);
  const float left = f_max(f_min(down_1_3, up_2_4), 0.0f), right = f_max(f_min(down_2_4, up_1_3), 0.0f);
  const float turn = f_clamp(yaw_N, -right, left);

  mixer_out_t out;
  out.force_N[0] = f_clamp(lift - same - turn, 0.0f, max);
  out.force_N[1] = f_clamp(lift - other + turn, 0.0f, max);
  out.force_N[2] = f_clamp(lift + same - turn, 0.0f, max);
  out.force_N[3] = f_clamp(lift + other + turn, 0.0f, max);
  out.torque_b_Nm = mixer_torque(p, out.force_N);
  out.thrust_N = mixer_thrust_N(out.force_N);
  out.gave_up_tilt = tilt_share < 1.0f;
  out.gave_up_thrust = !(fabsf(4.0f * lift - thrust_N) <= 1e-6f * max);
  out.gave_up_yaw = turn != yaw_N;
  return out;
}
