// pos_indi.c - outer loop: position to thrust direction and thrust.
#include "flight/pos_indi.h"

static v3_t each_by(v3_t a, v3_t b) {
  return (v3_t){a.x * b.x, a.y * b.y, a.z * b.z};
}

v3_t pos_indi_wanted_acc(const pos_indi_param_t *p, const pos_setpoint_t *sp, v3_t pos_w_m, v3_t vel_w_mps) {
  const v3_t kp = {p->kp_per_s, p->kp_per_s, p->kp_z_per_s}, kd = {p->kd_per_s, p->kd_per_s, p->kd_z_per_s};
  const v3_t vel_ref = v3_add(sp->vel_w_mps, each_by(kp, v3_sub(sp->pos_w_m, pos_w_m)));
  const v3_t acc = v3_add(sp->acc_w_mps2, each_by(kd, v3_sub(vel_ref, vel_w_mps)));
  const float max = p->acc_max_mps2;
  return (v3_t){f_clamp(acc.x, -max, max), f_clamp(acc.y, -max, max), f_clamp(acc.z, -max, max)};
}

pos_step_t pos_indi_step(const pos_indi_param_t *p, quat_t q_wb, float thrust_N, v3_t acc_error_w_mps2,
                         float dzc_m, rbf_point_t at) {
  const v3_t a = quat_to_body(q_wb, acc_error_w_mps2);
  const float lever_N = at.ratio * f_max(thrust_N, p->thrust_floor * p->mass_kg * GRAVITY_MPS2);
  return (pos_step_t){
      .roll_rad = -p->mass_kg * a.y / lever_N,
      .pitch_rad = p->mass_kg * a.x / lever_N,
      .thrust_N = p->quick * ((p->mass_kg * a.z - thrust_N * at.slope_per_m * dzc_m) / at.ratio),
  };
}

// sin(x) for |x| <= 0.8 to 5e-6: enough for a limit.
static float sin_small(float x) {
  const float x2 = x * x;
  return x * (1.0f - x2 * (1.0f / 6.0f) * (1.0f - x2 * (1.0f / 20.0f) * (1.0f - x2 * (1.0f / 42.0f))));
}

static v3_t at_limit(v3_t up, float side2, float side_max) {
  if (!(side2 > 1e-12f)) return (v3_t){0.0f, 0.0f, 1.0f}; // upside down: all directions are equally good
  const float k = side_max / sqrtf(side2);
  return (v3_t){k * up.x, k * up.y, sqrtf(1.0f - side_max * side_max)};
}

// The direction `up`, of any length but 0, made unit and brought within tilt_max_rad of vertical.
static v3_t limit_tilt(v3_t up, float tilt_max_rad) {
  const float side2 = up.x * up.x + up.y * up.y;
  const float side_max = sin_small(tilt_max_rad);
  const float norm2 = side2 + up.z * up.z;
  const bool within = up.z > 0.0f && side2 <= side_max * side_max * norm2;
  v3_t held;
  FOR_WHOM(within, &held) held = v3_scale(1.0f / sqrtf(norm2), up);
  FOR_WHOM(!within, &held) held = at_limit(up, side2, side_max);
  return held;
}

pos_command_t pos_indi_command(const pos_indi_param_t *p, quat_t q_wb, float thrust_N, pos_step_t step) {
  // A small rotation turns the body's up axis by (pitch, -roll, 0); normalised, it is exact to third order.
  const v3_t up = quat_to_world(q_wb, (v3_t){step.pitch_rad, -step.roll_rad, 1.0f});
  const float wanted_N = thrust_N + step.thrust_N;
  const float given_N = f_clamp(wanted_N, 0.0f, p->thrust_max_N);
  return (pos_command_t){
      .up_w = limit_tilt(up, p->tilt_max_rad),
      .thrust_N = given_N,
      .at_limit = !(wanted_N > 0.0f && wanted_N < p->thrust_max_N),
  };
}
