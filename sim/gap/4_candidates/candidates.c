// candidates.c - the effects that the model lacks.
#include "gap/4_candidates/candidates.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define COMMANDS_HZ 200.0 // attitude control commands at 500 Hz, and jitters; slower logs miss most of it

// --- the list ---------------------------------------------------------------------------------------------

static bool is_on(const model_t *m, const fx_t *fx) {
  for (int i = 0; i < m->n_fx; i++)
    if (strcmp(m->fx[i].fx->name, fx->name) == 0) return true;
  return false;
}

static double slowest_Hz(const set_t *s) {
  double rate_Hz = HUGE_VAL;
  for (int f = 0; f < s->n_grid; f++) rate_Hz = fmin(rate_Hz, s->grid[f].flight->rate_Hz);
  return rate_Hz;
}

bool candidates_slow(const set_t *s) {
  return slowest_Hz(s) < COMMANDS_HZ;
}

double candidates_least(const fx_t *fx, const set_t *s) {
  return fx->class == FX_TIMING ? fmax(fx->size[0].least, 1.0 / slowest_Hz(s)) : 0.0;
}

const char *candidates_obstacle(const fx_t *fx, const model_t *m, const set_t *s) {
  const grid_t *g = &s->grid[0];
  const bool forces = residual_has(s, CH_FX),
             moments = residual_has(s, CH_WX) || residual_has(s, CH_WY) || residual_has(s, CH_WZ);
  const bool place = fx->surface || strncmp(fx->name, "ceiling", 7) == 0;
  if (fx->n_size == 0) return "it has no numbers that could be estimated";
  if (fx->surface == SURFACE_CEILING || strcmp(fx->name, "ceiling_rpm") == 0)
    if (!isfinite(m->ceiling_m)) return "the vehicle file has no ceiling";
  if (fx->at_wall && !isfinite(m->wall_y_m)) return "the vehicle file has no wall";
  if ((place || fx->at_wall) && !g->has_position) return "the log has no position";
  if (strncmp(fx->name, "tof_", 4) == 0 && !residual_has(s, CH_RANGE))
    return "the log has no range sensor's samples";
  if (strcmp(fx->name, "battery_sag") == 0 && !g->has_vbat) return "the log has no battery voltage";
  if (fx->load && !g->has_velocity && strcmp(fx->name, "gyroscopic") != 0) return "the log has no velocity";
  if (strcmp(fx->name, "wind") == 0 && !g->has_attitude) return "the log has no attitude";
  if (strcmp(fx->name, "inertia") == 0 && candidates_slow(s))
    return "the log is too slow: what commands did between two samples looks like it";
  if (strncmp(fx->name, "tof_", 4) != 0 && !forces && !moments)
    return "the log has neither acceleration nor rates";
  return NULL;
}

static void add(candidates_t *c, const fx_t *fx, const model_t *m, int shape) {
  candidate_t *const to = &c->candidate[c->n++];
  *to = (candidate_t){.use = fx_use(fx), .first = c->columns, .n = fx->n_size};
  for (int k = 0; k < fx->n_size; k++) {
    const int param = fx->size[k].param;
    to->use.p[param] = 0.0;
    to->least[k] = fx->size[k].sign > 0 ? 0.0 : model_fx_least(m, &to->use, param);
  }
  if (fx->at_wall) to->use.p[0] = m->wall_y_m;
  if (fx->n_shape) to->use.p[fx->shape_param] = fx->shape[shape];
  c->columns += to->n;
}

done_t candidates_make(candidates_t *c, const model_t *m, const set_t *s, why_t *why) {
  *c = (candidates_t){.candidate = calloc((size_t)(fx_count * FX_SHAPE_MAX), sizeof(candidate_t))};
  if (!c->candidate) return error_failed(why, "out of memory");
  for (int i = 0; i < fx_count; i++) {
    if (is_on(m, fx_table[i]) || candidates_obstacle(fx_table[i], m, s)) continue;
    for (int k = 0; k == 0 || k < fx_table[i]->n_shape; k++) add(c, fx_table[i], m, k);
  }
  return DONE;
}

void candidates_free(candidates_t *c) {
  free(c->candidate);
  *c = (candidates_t){.n = 0};
}

double *candidate_value(const candidate_t *c, int k) {
  return (double *)&c->use.p[c->use.fx->size[k].param];
}

double candidate_typical(const candidate_t *c, int k) {
  int n;
  const fx_param_t *param = fx_use_params(&c->use, &n);
  const fx_size_t *size = c->use.fx->size;
  double typical = fabs(param[size[k].param].nominal);
  for (int i = 0; i < c->n && typical == 0.0; i++) typical = fabs(param[size[i].param].nominal);
  return typical > 0.0 ? typical : size[k].step;
}

done_t candidates_model(const candidates_t *c, const model_t *base, model_t *m, why_t *why) {
  *m = *base;
  for (int i = 0; i < c->n; i++)
    if (c->candidate[i].named) TRY(model_add_fx(m, &c->candidate[i].use, why));
  return DONE;
}
