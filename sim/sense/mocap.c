// mocap.c - motion capture.
#include "sense/mocap.h"

#include <math.h>

static mocap_sample_t take(const mocap_param_t *p, random_t *r, const truth_t *truth) {
  d3_t n;
  n.x = random_normal(r);
  n.y = random_normal(r);
  n.z = random_normal(r);
  const double x = p->tilt_rad[0] + p->sd_rad * random_normal(r);
  const double y = p->tilt_rad[1] + p->sd_rad * random_normal(r), z = p->sd_rad * random_normal(r);
  const dq_t turn = dq_unit((dq_t){1.0, 0.5 * x, 0.5 * y, 0.5 * z});
  return (mocap_sample_t){.pos_w_m = d3_add_scaled(truth->pos_w_m, p->sd_m, n),
                          .q_wb = dq_mul(truth->q_wb, turn)};
}

mocap_sample_t mocap_step(mocap_t *s, const mocap_param_t *p, random_t *r, const truth_t *truth) {
  if (s->ms == 0) s->taken = take(p, r, truth);
  mocap_sample_t sample = s->taken;
  sample.is_new = s->ms == (int)lround(1e3 * p->late_s);
  s->ms = (s->ms + 1) % (int)lround(1e3 * p->period_s);
  return sample;
}
