// 4_candidates.c - the effects that the model lacks, and what each would add to every residual.
#include "gap/4_candidates.h"

#include "gap/2_replay.h"
#include "gap/lines.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- the list
// -----------------------------------------------------------------------------------------------

static bool is_on(const model_t *m, const fx_t *fx) {
  for (int i = 0; i < m->n_fx; i++)
    if (strcmp(m->fx[i].fx->name, fx->name) == 0) return true;
  return false;
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

status_t candidates_make(candidates_t *c, const model_t *m, const set_t *s, why_t *why) {
  *c = (candidates_t){.candidate = calloc((size_t)(fx_count * FX_SHAPE_MAX), sizeof(candidate_t))};
  if (!c->candidate) return error_failed(why, "out of memory");
  for (int i = 0; i < fx_count; i++) {
    if (is_on(m, fx_table[i]) || candidates_obstacle(fx_table[i], m, s)) continue;
    for (int k = 0; k == 0 || k < fx_table[i]->n_shape; k++) add(c, fx_table[i], m, k);
  }
  return ST_OK;
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

status_t candidates_model(const candidates_t *c, const model_t *base, model_t *m, why_t *why) {
  *m = *base;
  for (int i = 0; i < c->n; i++)
    if (c->candidate[i].named) TRY(model_add_fx(m, &c->candidate[i].use, why));
  return ST_OK;
}

// --- residuals and columns --------------------------------------------------------------------------------

// Room for one flight's replay: `n` of each channel, twice, and what residual_rows wants.
typedef struct {
  double *base[CHANNELS], *with[CHANNELS], *scratch, *room;
} flight_lines_t;

static bool flight_lines_make(flight_lines_t *l, const set_t *s) {
  size_t most = 1;
  for (int f = 0; f < s->n_grid; f++) most = s->grid[f].n > (int)most ? (size_t)s->grid[f].n : most;
  l->room = calloc((2 * CHANNELS + CH_SMOOTH) * most, sizeof(double));
  for (size_t c = 0; c < CHANNELS && l->room; c++) {
    l->base[c] = l->room + c * most;
    l->with[c] = l->room + (CHANNELS + c) * most;
  }
  l->scratch = l->room ? l->room + 2 * CHANNELS * most : NULL;
  return l->room != NULL;
}

// As measured in r, less predicted.
static status_t residual_with(set_t *s, const model_t *m, const flight_lines_t *l, const lines_t *predicted,
                              double *const r[CHANNELS], why_t *why) {
  TRY(residual_measured(s, r, why));
  for (int f = 0; f < s->n_grid; f++) {
    TRY(replay(&s->grid[f], m, l->base, why));
    residual_rows(s, f, SERIES_PREDICTED, (const double *const *)l->base, l->scratch, predicted->r);
  }
  for (int c = 0; c < CHANNELS; c++)
    for (int i = 0; i < set_rows(s, c)->n; i++) r[c][i] -= predicted->r[c][i];
  return ST_OK;
}

status_t residual_of(set_t *s, const model_t *m, double *const r[CHANNELS], why_t *why) {
  lines_t predicted;
  flight_lines_t l = {.room = NULL};
  status_t status = lines_make(&predicted, s, why);
  if (status == ST_OK && !flight_lines_make(&l, s)) status = error_failed(why, "out of memory");
  if (status == ST_OK) status = residual_with(s, m, &l, &predicted, r, why);
  free(l.room);
  lines_free(&predicted);
  return status;
}

// The derivative of a flight's replay with respect to size k of an effect, which the model has or gets; base:
// the model's own.
static status_t differentiate(set_t *s, int flight, const model_t *now, const candidate_t *c, int k,
                              flight_lines_t *l, why_t *why) {
  const fx_size_t *size = &c->use.fx->size[k];
  grid_t *g = &s->grid[flight];
  model_t m = *now;
  fx_use_t more = c->use;
  more.p[size->param] += size->step;
  TRY(model_add_fx(&m, &more, why));
  TRY(replay(g, &m, l->with, why));
  for (int ch = 0; ch < CHANNELS; ch++)
    for (int j = 0; j < g->n; j++) {
      const double d = (l->with[ch][j] - l->base[ch][j]) / size->step;
      l->with[ch][j] = isfinite(d) ? d : 0.0;
    }
  return ST_OK;
}

static bool all_zero(const double *v, int n) {
  for (int j = 0; j < n; j++)
    if (v[j] != 0.0) return false;
  return true;
}

static status_t fill_column(table_t *t, set_t *s, int flight, int column, const flight_lines_t *l) {
  double *row[CHANNELS] = {NULL};
  for (int ch = 0; ch < CHANNELS; ch++) {
    if (!residual_has(s, ch) || all_zero(l->with[ch], s->grid[flight].n)) continue;
    if (!t->x[ch][column]) t->x[ch][column] = calloc((size_t)set_rows(s, ch)->n + 1, sizeof(double));
    if (!t->x[ch][column]) return ST_FAILED;
    row[ch] = t->x[ch][column];
  }
  residual_rows(s, flight, SERIES_PREDICTED, (const double *const *)l->with, l->scratch, row);
  return ST_OK;
}

// The effect that a candidate is another shape of, if that one is named.
static const fx_t *named_otherwise(const candidates_t *c, int candidate) {
  for (int i = 0; i < c->n; i++)
    if (i != candidate && c->candidate[i].named && c->candidate[i].use.fx == c->candidate[candidate].use.fx)
      return c->candidate[i].use.fx;
  return NULL;
}

// The columns of the candidates that start from this model: of all but the other shapes of a named effect, or
// of those of one that the model has no longer.
static status_t fill_from(table_t *t, set_t *s, int flight, const model_t *m, const fx_t *dropped,
                          const candidates_t *c, flight_lines_t *l, why_t *why) {
  TRY(replay(&s->grid[flight], m, l->base, why));
  for (int i = 0; i < c->n; i++) {
    if (named_otherwise(c, i) != dropped) continue;
    for (int k = 0; k < c->candidate[i].n; k++) {
      TRY(differentiate(s, flight, m, &c->candidate[i], k, l, why));
      if (fill_column(t, s, flight, c->candidate[i].first + k, l) != ST_OK)
        return error_failed(why, "out of memory");
    }
  }
  return ST_OK;
}

static status_t fill_flight(table_t *t, set_t *s, int flight, const model_t *now, const candidates_t *c,
                            flight_lines_t *l, why_t *why) {
  TRY(fill_from(t, s, flight, now, NULL, c, l, why));
  for (int i = 0; i < c->n; i++) {
    const fx_t *const fx = c->candidate[i].use.fx;
    if (!c->candidate[i].named || fx->n_shape < 2) continue;
    model_t m = *now;
    model_drop_fx(&m, fx);
    TRY(fill_from(t, s, flight, &m, fx, c, l, why));
  }
  return ST_OK;
}

// The residual gets back what the straight line says that the named effects do.
static void add_named(table_t *t, const set_t *s, const candidates_t *c) {
  for (int i = 0; i < c->n; i++)
    for (int k = 0; c->candidate[i].named && k < c->candidate[i].n; k++)
      for (int ch = 0; ch < CHANNELS; ch++) {
        const double *x = t->x[ch][c->candidate[i].first + k];
        const double value = *candidate_value(&c->candidate[i], k);
        for (int r = 0; x && r < set_rows(s, ch)->n; r++) t->x[ch][t->columns][r] += value * x[r];
      }
}

static bool table_room(table_t *t, const set_t *s) {
  for (int ch = 0; ch < CHANNELS; ch++) {
    t->x[ch] = calloc((size_t)t->columns + 1, sizeof(double *));
    if (!t->x[ch]) return false;
    t->x[ch][t->columns] = calloc((size_t)set_rows(s, ch)->n + 1, sizeof(double));
    if (!t->x[ch][t->columns]) return false;
  }
  return true;
}

status_t table_make(table_t *t, set_t *s, const model_t *base, const candidates_t *c, why_t *why) {
  flight_lines_t l;
  model_t now;
  double *r[CHANNELS];
  *t = (table_t){.columns = c->columns};
  TRY(candidates_model(c, base, &now, why));
  if (!table_room(t, s) || !flight_lines_make(&l, s)) {
    table_free(t);
    return error_failed(why, "out of memory");
  }
  for (int ch = 0; ch < CHANNELS; ch++) r[ch] = t->x[ch][t->columns];
  status_t status = residual_of(s, &now, r, why);
  for (int f = 0; f < s->n_grid && status == ST_OK; f++) status = fill_flight(t, s, f, &now, c, &l, why);
  free(l.room);
  if (status == ST_OK) add_named(t, s, c);
  if (status != ST_OK) table_free(t);
  return status;
}

void table_free(table_t *t) {
  for (int ch = 0; ch < CHANNELS; ch++) {
    for (int i = 0; t->x[ch] && i <= t->columns; i++) free(t->x[ch][i]);
    free(t->x[ch]);
    t->x[ch] = NULL;
  }
}
