// ground.c - the thrust ratio over the ground.
#include "flight/ground.h"

status_t ground_init(ground_t *g, const learn_param_t *p, const rbf_weights_t *start) {
  TRY(learn_init(&g->learn, p, start));
  ground_rest(g);
  return ST_OK;
}

void ground_rest(ground_t *g) {
  g->known = g->turn = false;
}

static status_t learn(ground_t *g, const learn_param_t *p, float distance_m, const ground_in_t *in) {
  learn_sample_t sample = *in->sample;
  sample.zc_m = distance_m;
  sample.known = true;
  sample.blind_s = 0.0f;
  return learn_update(&g->learn, p, &sample, in->excess);
}

status_t ground_step(ground_t *g, const curve_param_t *c, const learn_param_t *p, const lpf2_coef_t *filter,
                     const ground_in_t *in, rbf_point_t *at) {
  status_t status = ST_OK;
  if (!g->known) lpf2_reset(&g->filter, in->height_m);
  g->known = true;
  g->height_m = in->height_m;
  const float filtered_m = lpf2_step(&g->filter, filter, in->height_m);
  if (c->mode == CURVE_LIVE && in->sample) {
    const bool near = filtered_m <= p->far_m;
    if (g->turn || !in->shared) status = learn(g, p, filtered_m, in);
    g->turn = near && in->shared && !g->turn;
  } else {
    g->turn = false;
  }
  *at = curve_at(c, &g->learn.rls.theta, true, in->height_m);
  return status;
}
