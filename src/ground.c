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

void ground_step(ground_t *g, const curve_param_t *c, const learn_param_t *p, const lpf2_coef_t *filter,
                 const ground_in_t *in) {
  if (!g->known) lpf2_reset(&g->filter, in->height_m);
  g->known = true;
  g->height_m = in->height_m;
  const float filtered_m = lpf2_step(&g->filter, filter, in->height_m);
  g->at = curve_at(c, &g->learn.rls.theta, true, in->height_m);
  g->lesson_excess = curve_at(c, &g->learn.rls.theta, true, filtered_m).ratio - 1.0f;
  const bool near = filtered_m >= p->near_m && filtered_m <= p->far_m;
  g->turn = c->mode == CURVE_LIVE && in->sample && near && !(in->shared && g->turn);
  if (!g->turn) return;
  g->sample = *in->sample;
  g->sample.zc_m = filtered_m;
  g->sample.known = true;
  g->sample.blind_s = 0.0f;
  g->sample_excess = in->excess;
}

status_t ground_learn(ground_t *g, const learn_param_t *p) {
  if (!g->turn) return ST_OK;
  return learn_update(&g->learn, p, &g->sample, g->sample_excess);
}
