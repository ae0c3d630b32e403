// bias.c - the accelerometer's bias and a velocity free of it.
#include "flight/bias.h"

#include "flight/expneg.h"

// test: bias_takes_a_state_for_one_up_to_2000
#define STATE_MAX 2000.0f // m/s2 and m/s: more than the members of a state can add up to

void bias_start(bias_t *s, v3_t pos_m, v3_t vel_mps) {
  *s = (bias_t){.pos_last_m = pos_m, .vel_slow_mps = vel_mps};
}

void bias_shift(bias_t *s, v3_t by_m) {
  s->pos_last_m = v3_add(s->pos_last_m, by_m);
}

v3_t bias_free_velocity(const bias_t *s, v3_t vel_mps) {
  return v3_sub(vel_mps, s->vel_off_mps);
}

// True if no bit flip shows: a member that is not finite or far out shows in the sum. A wrong pos_last_m is
// treated as a jump.
static bool is_state(const bias_t *s) {
  const v3_t found = v3_add(v3_add(s->bias_mps2, s->first_mps2), s->vel_off_mps);
  return v3_within(v3_add(found, v3_add(s->acc_slow_mps2, s->vel_slow_mps)), STATE_MAX);
}

static v3_t nearer_to(v3_t from, float share, v3_t to) {
  return v3_add(from, v3_scale(share, v3_sub(to, from)));
}

static v3_t bounded(v3_t a, float max) {
  return (v3_t){f_clamp(a.x, -max, max), f_clamp(a.y, -max, max), f_clamp(a.z, -max, max)};
}

void bias_tune(bias_coef_t *c, const bias_param_t *p, float period_s) {
  c->period_s = period_s;
  c->per_s = 1.0f / period_s;
  c->share = 1.0f - expneg(p->pole_radps * period_s);
  c->vel_share = p->vel_s > 0.0f ? 1.0f - expneg(period_s / p->vel_s) : 0.0f;
}

float bias_take(bias_t *s, const bias_param_t *p, float more_mps2) {
  if (!is_state(s) || !f_finite(more_mps2)) return 0.0f; // the next step repairs the state
  const float held_mps2 = f_clamp(s->bias_mps2.z + more_mps2, -p->max_mps2, p->max_mps2);
  const float taken_mps2 = held_mps2 - s->bias_mps2.z;
  s->bias_mps2.z = held_mps2;
  s->first_mps2.z += taken_mps2;
  s->acc_slow_mps2.z += taken_mps2;
  return taken_mps2;
}

status_t bias_step(bias_t *s, const bias_param_t *p, const bias_coef_t *c, v3_t acc_mps2, v3_t pos_m,
                   v3_t vel_mps) {
  const bool known = is_state(s);
  if (!(p->pole_radps > 0.0f) || !known) {
    bias_start(s, pos_m, vel_mps);
    return known ? ST_OK : ST_BAD_STATE;
  }
  const v3_t rate_mps = v3_scale(c->per_s, v3_sub(pos_m, s->pos_last_m)), off_mps = v3_sub(vel_mps, rate_mps);
  s->pos_last_m = pos_m;
  if (!(c->period_s <= BIAS_GAP_S)) {
    s->vel_slow_mps = bias_free_velocity(s, vel_mps);
    s->acc_slow_mps2 = s->first_mps2 = s->bias_mps2;
    return ST_OK;
  }
  if (!v3_within(off_mps, BIAS_JUMP_MPS)) return ST_OK;

  const float share = c->share;
  // The second difference of the position is of one interval ago; so is <a> before it takes this sample.
  const v3_t motion_mps2 = v3_scale(share * c->per_s, v3_sub(rate_mps, s->vel_slow_mps));
  s->first_mps2 =
      bounded(nearer_to(s->first_mps2, share, v3_sub(s->acc_slow_mps2, motion_mps2)), p->max_mps2);
  s->bias_mps2 = bounded(nearer_to(s->bias_mps2, share, s->first_mps2), p->max_mps2);
  s->acc_slow_mps2 = nearer_to(s->acc_slow_mps2, share, acc_mps2);
  s->vel_slow_mps = nearer_to(s->vel_slow_mps, share, rate_mps);

  if (p->vel_s > 0.0f)
    s->vel_off_mps = nearer_to(s->vel_off_mps, c->vel_share, off_mps);
  else
    s->vel_off_mps = (v3_t){0.0f, 0.0f, 0.0f};
  return ST_OK;
}
