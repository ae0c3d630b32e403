// att_indi.c - inner loop: attitude to body torques.
#include "flight/att_indi.h"

// Bound of the sum of all states, in mixed units. The angular accelerations are the largest: a gyro that goes
// from one end to the other in each call gives 34,500 rad/s2, in four states on each axis.
// test: inner_loop_knows_a_state_that_can_be
#define STATE_MAX 1e6f

void att_indi_reset(att_indi_t *s) {
  *s = (att_indi_t){.started = false};
}

bool att_indi_good(const att_indi_t *s) {
  const v3_t now = s->torque_model_Nm;
  float sum = now.x + now.y + now.z; // the rest is of the last step, and reaches the filters in the next
  for (int i = 0; i < 3; i++) sum += lpf2_sum(&s->acc[i]) + lpf2_sum(&s->torque[i]);
  return fabsf(sum) <= STATE_MAX;
}

// Returns the rotation about z by the heading, from the half-angle formula in which no digits cancel.
static quat_t turned(sincos_t heading) {
  if (heading.cos >= 0.0f) {
    const float w = sqrtf(0.5f * (1.0f + heading.cos));
    return (quat_t){w, 0.0f, 0.0f, 0.5f * heading.sin / w};
  }
  const float z = sqrtf(0.5f * (1.0f - heading.cos));
  return (quat_t){0.5f * heading.sin / z, 0.0f, 0.0f, z};
}

quat_t att_indi_reference(v3_t up_w, sincos_t heading) {
  // The shortest rotation from the z axis to up_w, after the heading.
  const quat_t tilt = quat_unit((quat_t){1.0f + up_w.z, -up_w.y, up_w.x, 0.0f});
  const quat_t turn = turned(heading);
  // quat_mul(tilt, turn) without what is zero.
  return (quat_t){tilt.w * turn.w, tilt.x * turn.w + tilt.y * turn.z, tilt.y * turn.w - tilt.x * turn.z,
                  tilt.w * turn.z};
}

static APART void start(att_indi_t *s, const att_indi_in_t *in) {
  const float torque[3] = {in->torque_b_Nm.x, in->torque_b_Nm.y, in->torque_b_Nm.z};
  for (int i = 0; i < 3; i++) lpf2_reset(&s->torque[i], torque[i]);
  s->torque_model_Nm = in->torque_b_Nm;
  s->rate_last_radps = in->rate_b_radps;
  s->yaw_now_Nm = in->torque_b_Nm.z;
  s->started = true;
}

static float lag(float model, float share, float input) {
  return model + share * (input - model);
}

// The torque that the rotors give, synchronous with the filtered angular acceleration.
static v3_t torque_now(att_indi_t *s, const lpf2_coef_t *c, float share, v3_t applied) {
  const v3_t m = s->torque_model_Nm, filtered = lpf2_step3(s->torque, c, applied);
  const v3_t now = {lag(m.x, share, filtered.x), lag(m.y, share, filtered.y), lag(m.z, share, filtered.z)};
  s->torque_model_Nm = now;
  return now;
}

static v3_t filtered_acc(att_indi_t *s, const lpf2_coef_t *c, const v3_t *rate, float period_s) {
  const v3_t raw = v3_scale(1.0f / period_s, v3_sub(*rate, s->rate_last_radps));
  s->rate_last_radps = *rate;
  return lpf2_step3(s->acc, c, raw);
}

static float wanted_rate(const att_indi_param_t *p, float rate_radps) {
  return f_clamp(rate_radps, -p->rate_max_radps, p->rate_max_radps);
}

// Returns the ceiling term at this rate, about an axis with this gain (inertia x quick x kd).
static float ceiling_Nm(const att_indi_in_t *in, float gain_Nms, float rate_radps) {
  return f_clamp(in->ceiling_Nms, -ATT_INDI_CEILING_MAX * gain_Nms, 0.0f) * rate_radps;
}

// Returns the external torque about one axis beyond `most_Nm`: exactly 0 within.
static float beyond_Nm(float held_Nm, float most_Nm) {
  return held_Nm - f_clamp(held_Nm, -most_Nm, most_Nm);
}

v3_t att_indi_step(att_indi_t *s, const att_indi_param_t *p, const lpf2_coef_t *c, float lag_share,
                   float period_s, const att_indi_in_t *in) {
  if (!s->started) start(s, in);
  const v3_t *const rate = &in->rate_b_radps;
  const v3_t error = att_indi_error(&in->q_wb, &in->q_ref);
  const v3_t acc = filtered_acc(s, c, rate, period_s);
  const v3_t now = torque_now(s, c, lag_share, in->torque_b_Nm);
  const v3_t nu = {
      p->kd_per_s * (wanted_rate(p, p->kp_per_s * error.x) - rate->x),
      p->kd_per_s * (wanted_rate(p, p->kp_per_s * error.y) - rate->y),
      p->kd_yaw_per_s * (wanted_rate(p, p->kp_yaw_per_s * error.z + in->yaw_rate_radps) - rate->z),
  };
  // The part of the last increment that was applied: the mixer gives up yaw first.
  const float g = p->g2_s / period_s, last_Nm = in->torque_b_Nm.z - s->yaw_now_Nm;
  const float x_kgm2 = p->quick * p->inertia_xx_kgm2, y_kgm2 = p->quick * p->inertia_yy_kgm2;
  v3_t step = {x_kgm2 * (nu.x - acc.x), y_kgm2 * (nu.y - acc.y),
               p->quick * p->inertia_zz_kgm2 * (nu.z - acc.z) + g * last_Nm};
  const bool adds = in->ceiling_Nms < 0.0f; // else there is nothing to add
  if (ANY(adds)) {
    step.x = EITHER(adds, step.x + ceiling_Nm(in, x_kgm2 * p->kd_per_s, rate->x), step.x);
    step.y = EITHER(adds, step.y + ceiling_Nm(in, y_kgm2 * p->kd_per_s, rate->y), step.y);
  }
  // External torque: what the rotors give now, less what the vehicle shows.
  const v3_t held = {in->ratio * now.x - p->inertia_xx_kgm2 * acc.x,
                     in->ratio * now.y - p->inertia_yy_kgm2 * acc.y,
                     now.z + g * (now.z - s->yaw_now_Nm) - p->inertia_zz_kgm2 * acc.z};
  s->yaw_now_Nm = now.z;
  const float most = in->trim_Nm, most_yaw = in->trim_yaw_Nm;
  const bool beyond = !(fabsf(held.x) <= most && fabsf(held.y) <= most && fabsf(held.z) <= most_yaw);
  if (ANY(beyond)) {
    step.x = EITHER(beyond, step.x - beyond_Nm(held.x, most), step.x);
    step.y = EITHER(beyond, step.y - beyond_Nm(held.y, most), step.y);
    step.z = EITHER(beyond, step.z - beyond_Nm(held.z, most_yaw), step.z);
  }
  return (v3_t){now.x + step.x / in->ratio, now.y + step.y / in->ratio, now.z + step.z / (1.0f + g)};
}
