// sync.c - signals through one and the same filter.
#include "flight/sync.h"

// Bound of the sum of all filter states, in mixed units: more than they can add up to. A flipped bit more
// often gives 1e30 than NaN, and from 1e30 a filter needs a hundred time constants to recover.
// test: sync_knows_a_state_that_can_be
#define STATE_MAX 2e4f

status_t sync_tune(sync_coef_t *c, float cutoff_Hz, float motor_tau_s, float period_s) {
  TRY(lpf2_tune(&c->filter, cutoff_Hz, 1.0f / period_s));
  c->lag_share = thrust_lag_share(period_s, motor_tau_s);
  c->period_s = period_s;
  return ST_OK;
}

static v3_t acc_world(v3_t acc_b_mps2, quat_t q_wb) {
  const v3_t force = quat_to_world(q_wb, acc_b_mps2);
  return (v3_t){force.x, force.y, force.z - GRAVITY_MPS2};
}

void sync_start(sync_t *s, const sync_in_t *in) {
  const quat_t q = quat_unit(in->q_wb);
  const v3_t acc = acc_world(in->acc_b_mps2, q);
  lpf2_reset(&s->acc_w[0], acc.x);
  lpf2_reset(&s->acc_w[1], acc.y);
  lpf2_reset(&s->acc_w[2], acc.z);
  lpf2_reset(&s->att[0], q.w);
  lpf2_reset(&s->att[1], q.x);
  lpf2_reset(&s->att[2], q.y);
  lpf2_reset(&s->att[3], q.z);
  s->att_last = q;
  s->distance_known = false;
  thrust_reset(&s->thrust, in->thrust_N);
}

bool sync_good(const sync_t *s) {
  float sum = thrust_sum(&s->thrust);
  // While the distance is not known, nothing steps its filter, and it will restart.
  sum = EITHER(s->distance_known, sum + lpf2_sum(&s->distance), sum);
  for (int i = 0; i < 3; i++) sum += lpf2_sum(&s->acc_w[i]);
  for (int i = 0; i < 4; i++) sum += lpf2_sum(&s->att[i]);
  return fabsf(sum) <= STATE_MAX;
}

void sync_step(sync_t *s, const sync_coef_t *c, const sync_in_t *in, sync_out_t *out) {
  const lpf2_coef_t *f = &c->filter;
  quat_t q = quat_unit(in->q_wb);
  const v3_t acc = acc_world(in->acc_b_mps2, q);
  if (quat_dot(q, s->att_last) < 0.0f) q = (quat_t){-q.w, -q.x, -q.y, -q.z};
  s->att_last = q;
  const quat_t q_f = quat_unit((quat_t){lpf2_step(&s->att[0], f, q.w), lpf2_step(&s->att[1], f, q.x),
                                        lpf2_step(&s->att[2], f, q.y), lpf2_step(&s->att[3], f, q.z)});
  out->acc_now_w_mps2 = acc;
  out->acc_w_mps2 = lpf2_step3(s->acc_w, f, acc);
  out->q_wb = q_f;
  out->up_w = quat_up(q_f);
  out->thrust_N = thrust_step(&s->thrust, f, c->lag_share, c->period_s, in->thrust_N, in->at_limit);
}

void sync_shift_acc(sync_t *s, float by_mps2) {
  lpf2_t *const z = &s->acc_w[2];
  z->x1 += by_mps2;
  z->x2 += by_mps2;
  z->y1 += by_mps2;
  z->y2 += by_mps2;
}

float sync_distance_m(sync_t *s, const sync_coef_t *c, bool known, float distance_m) {
  FOR_WHOM(known && !s->distance_known, &s->distance) lpf2_reset(&s->distance, distance_m);
  s->distance_known = known;
  float filtered_m = distance_m;
  FOR_WHOM(known, &s->distance) filtered_m = lpf2_step(&s->distance, &c->filter, distance_m);
  return EITHER(known, filtered_m, distance_m);
}
