// learn.c - which samples the curve may learn from.
#include "flight/learn.h"

#include "flight/v3.h"
#include <limits.h>

status_t learn_init(learn_t *s, const learn_param_t *p, const rbf_weights_t *start) {
  TRY(rls_init(&s->rls, &p->rls, start));
  s->y = 0.0f;
  s->refused = 0;
  return ST_OK;
}

learn_sample_t learn_sample(const sync_t *s, const sync_out_t *x, float mass_kg) {
  const v3_t force_w = {x->acc_w_mps2.x, x->acc_w_mps2.y, x->acc_w_mps2.z + GRAVITY_MPS2};
  return (learn_sample_t){
      .up = x->up_w.z,
      .force_N = mass_kg * v3_dot(force_w, x->up_w),
      .thrust_N = x->thrust_N,
      .weight_N = mass_kg * GRAVITY_MPS2,
      .since_limit_s = s->thrust.since_limit_s,
  };
}

// Each comparison is false for NaN.
static bool usable(const learn_param_t *p, const learn_sample_t *x) {
  return x->known && x->blind_s <= p->blind_max_s && x->zc_m >= p->near_m && x->zc_m <= p->far_m &&
         x->up >= p->up_min && x->weight_N > 0.0f && x->thrust_N >= p->thrust_min * x->weight_N &&
         x->since_limit_s >= p->settle_s && x->force_N * p->y_max >= x->thrust_N &&
         x->force_N <= p->y_max * x->thrust_N && x->thrust_N <= FLT_MAX;
}

static status_t teach(learn_t *s, const learn_param_t *p, const learn_sample_t *sample, float excess) {
  float basis[RBF_N];
  rbf_basis(sample->zc_m, basis);
  const float y = sample->force_N / sample->thrust_N - excess;
  TRY(rls_update(&s->rls, &p->rls, basis, y));
  s->y = y;
  return ST_OK;
}

status_t learn_update(learn_t *s, const learn_param_t *p, const learn_sample_t *sample, float excess) {
  const bool good = usable(p, sample);
  status_t status = ST_OK;
  FOR_WHOM(good, s) status = teach(s, p, sample, excess);
  FOR_WHOM(!good, &status) status = ST_SAMPLE_REFUSED;
  FOR_WHOM(!good && s->refused < UINT_MAX, &s->refused) s->refused++;
  return status;
}
