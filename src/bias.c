// bias.c - the accelerometer's bias and a velocity free of it.
#include "flight/bias.h"

void bias_start(bias_t *s, v3_t pos_m, v3_t vel_mps) {
  *s = (bias_t){.pos_m = pos_m, .vel_mps = vel_mps};
}

void bias_shift(bias_t *s, v3_t by_m) {
  s->pos_m = v3_add(s->pos_m, by_m);
  s->pos_slow_m = v3_add(s->pos_slow_m, by_m);
}

v3_t bias_free_velocity(const bias_t *s, v3_t vel_mps) {
  return v3_sub(vel_mps, s->vel_off_mps);
}

static void compare(bias_t *s, float vel_s, v3_t pos_m, v3_t vel_mps, float dt) {
  if (!(vel_s > 0.0f)) {
    s->compared = false;
    s->vel_off_mps = (v3_t){0.0f, 0.0f, 0.0f};
    return;
  }
  if (!s->compared) {
    s->pos_slow_m = v3_sub(pos_m, v3_scale(vel_s, vel_mps));
    s->vel_slow_mps = vel_mps;
    s->compared = true;
  }
  const float share = f_clamp(dt / vel_s, 0.0f, 1.0f), per_s = 1.0f / f_max(vel_s, 1e-3f);
  s->pos_slow_m = v3_add(s->pos_slow_m, v3_scale(share, v3_sub(pos_m, s->pos_slow_m)));
  s->vel_slow_mps = v3_add(s->vel_slow_mps, v3_scale(share, v3_sub(vel_mps, s->vel_slow_mps)));
  s->vel_off_mps = v3_sub(s->vel_slow_mps, v3_scale(per_s, v3_sub(pos_m, s->pos_slow_m)));
}

void bias_step(bias_t *s, const bias_param_t *p, v3_t acc_mps2, v3_t pos_m, v3_t vel_mps, float period_s) {
  if (!(p->pole_radps > 0.0f)) {
    bias_start(s, pos_m, vel_mps);
    return;
  }
  compare(s, p->vel_s, pos_m, vel_mps, period_s);
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
