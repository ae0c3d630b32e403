// bias.c - the accelerometer's bias and a velocity free of it.
#include "flight/bias.h"

void bias_start(bias_t *s, v3_t pos_m, v3_t vel_mps) {
  *s = (bias_t){.pos_m = pos_m, .vel_mps = vel_mps};
}

void bias_shift(bias_t *s, v3_t by_m) {
  s->pos_m = v3_add(s->pos_m, by_m);
}

v3_t bias_free_velocity(const bias_t *s, const bias_param_t *p, v3_t vel_mps) {
  return v3_sub(vel_mps, v3_scale(p->vel_s, s->bias_mps2));
}

void bias_step(bias_t *s, const bias_param_t *p, v3_t acc_mps2, v3_t pos_m, v3_t vel_mps, float period_s) {
  if (!(p->pole_radps > 0.0f)) {
    bias_start(s, pos_m, vel_mps);
    return;
  }
  const float w = p->pole_radps, dt = period_s;
  const v3_t acc = v3_sub(acc_mps2, s->bias_mps2);
  s->pos_m = v3_add(s->pos_m, v3_scale(dt, v3_add(s->vel_mps, v3_scale(0.5f * dt, acc))));
  s->vel_mps = v3_add(s->vel_mps, v3_scale(dt, acc));

  const v3_t e = v3_sub(pos_m, s->pos_m);
  const v3_t b = v3_sub(s->bias_mps2, v3_scale(dt * w * w * w, e));
  s->pos_m = v3_add(s->pos_m, v3_scale(dt * 3.0f * w, e));
  s->vel_mps = v3_add(s->vel_mps, v3_scale(dt * 3.0f * w * w, e));
  const float max = p->max_mps2;
  s->bias_mps2 = (v3_t){f_clamp(b.x, -max, max), f_clamp(b.y, -max, max), f_clamp(b.z, -max, max)};
}
