// 4_candidates.c - the effects that the model lacks, and what each would add to every residual.
#include "gap/4_candidates.h"

#include "gap/2_replay.h"
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
  if (place && !g->has_position) return "the log has no position";
  if (strncmp(fx->name, "tof_", 4) == 0 && !residual_has(s, CH_RANGE))
    return "the log has no range sensor's samples";
  if (strcmp(fx->name, "battery_sag") == 0 && !g->has_vbat) return "the log has no battery voltage";
  if (fx->load && !g->has_velocity && strcmp(fx->name, "gyroscopic") != 0) return "the log has no velocity";
  if (strcmp(fx->name, "wind") == 0 && !g->has_attitude) return "the log has no attitude";
  if (strncmp(fx->name, "tof_", 4) != 0 && !forces && !moments)
    return "the log has neither acceleration nor rates";
  return NULL;
}

static void add(candidates_t *c, const fx_t *fx, int shape) {
  candidate_t *const to = &c->candidate[c->n++];
  *to = (candidate_t){.use = fx_use(fx), .first = c->columns, .n = fx->n_size};
  for (int k = 0; k < fx->n_size; k++) to->use.p[fx->size[k].param] = 0.0;
  if (fx->n_shape) to->use.p[fx->shape_param] = fx->shape[shape];
  c->columns += to->n;
}

status_t candidates_make(candidates_t *c, const model_t *m, const set_t *s, why_t *why) {
  *c = (candidates_t){.candidate = calloc((size_t)(fx_count * FX_SHAPE_MAX), sizeof(candidate_t))};
  if (!c->candidate) return error_failed(why, "out of memory");
  for (int i = 0; i < fx_count; i++) {
    if (is_on(m, fx_table[i]) || candidates_obstacle(fx_table[i], m, s)) continue;
    for (int k = 0; k == 0 || k < fx_table[i]->n_shape; k++) add(c, fx_table[i], k);
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
  for (int i = 0; i < c->n; i++) typical = fmax(typical, fabs(param[size[i].param].nominal));
  return typical > 0.0 ? typical : size[k].step;
}

status_t candidates_model(const candidates_t *c, const model_t *base, model_t *m, why_t *why) {
  *m = *base;
  for (int i = 0; i < c->n; i++)
    if (c->candidate[i].named) TRY(model_add_fx(m, &c->candidate[i].use, why));
  return ST_OK;
}

// --- residuals and columns --------------------------------------------------------------------------------

// Room for one flight's replay: `n` of each channel, twice, and a scratch line.
typedef struct {
  double *base[CHANNELS], *with[CHANNELS], *scratch, *room;
} lines_t;

static bool lines_make(lines_t *l, const set_t *s) {
  size_t most = 1;
  for (int f = 0; f < s->n_grid; f++) most = s->grid[f].n > (int)most ? (size_t)s->grid[f].n : most;
  l->room = calloc((2 * CHANNELS + 1) * most, sizeof(double));
  for (size_t c = 0; c < CHANNELS && l->room; c++) {
    l->base[c] = l->room + c * most;
    l->with[c] = l->room + (CHANNELS + c) * most;
  }
  l->scratch = l->room ? l->room + 2 * CHANNELS * most : NULL;
  return l->room != NULL;
}

status_t residual_of(set_t *s, const model_t *m, double *const r[CHANNELS], why_t *why) {
  lines_t l;
  if (!lines_make(&l, s)) return error_failed(why, "out of memory");
  status_t status = ST_OK;
  for (int c = 0; c < CHANNELS && status == ST_OK; c++) status = residual_measured(s, c, r[c], why);
  for (int f = 0; f < s->n_grid && status == ST_OK; f++) {
    status = replay(&s->grid[f], m, l.base, why);
    for (int c = 0; c < CHANNELS && status == ST_OK; c++) {
      // The rows of this flight, twice: as measured in r, as predicted in a copy.
      const rows_t *rows = set_rows(s, c);
      double *const predicted = malloc(((size_t)rows->n + 1) * sizeof(double));
      if (!predicted) {
        status = error_failed(why, "out of memory");
        break;
      }
      residual_rows(s, f, c, SERIES_PREDICTED, l.base[c], l.scratch, predicted);
      for (int i = 0; i < rows->n; i++)
        if (rows->flight[i] == f) r[c][i] -= predicted[i];
      free(predicted);
    }
  }
  free(l.room);
  return status;
}

status_t candidate_differentiate(grid_t *g, const model_t *now, const candidate_t *c, int k,
                                 double *const base[CHANNELS], double *const with[CHANNELS], why_t *why) {
  const fx_size_t *size = &c->use.fx->size[k];
  model_t m = *now;
  fx_use_t more = c->use;
  more.p[size->param] += size->step;
  TRY(model_add_fx(&m, &more, why));
  TRY(replay(g, &m, with, why));
  for (int ch = 0; ch < CHANNELS; ch++)
    for (int j = 0; j < g->n; j++) {
      const double d = (with[ch][j] - base[ch][j]) / size->step;
      with[ch][j] = isfinite(d) ? d : 0.0;
    }
  return ST_OK;
}

static bool all_zero(const double *v, int n) {
  for (int j = 0; j < n; j++)
    if (v[j] != 0.0) return false;
  return true;
}

static status_t fill_column(table_t *t, set_t *s, int flight, int column, lines_t *l) {
  for (int ch = 0; ch < CHANNELS; ch++) {
    if (!residual_has(s, ch) || all_zero(l->with[ch], s->grid[flight].n)) continue;
    if (!t->x[ch][column]) t->x[ch][column] = calloc((size_t)set_rows(s, ch)->n + 1, sizeof(double));
    if (!t->x[ch][column]) return ST_FAILED;
    residual_rows(s, flight, ch, SERIES_PREDICTED, l->with[ch], l->scratch, t->x[ch][column]);
  }
  return ST_OK;
}

static status_t fill_flight(table_t *t, set_t *s, int flight, const model_t *now, const candidates_t *c,
                            lines_t *l, why_t *why) {
  TRY(replay(&s->grid[flight], now, l->base, why));
  for (int i = 0; i < c->n; i++)
    for (int k = 0; k < c->candidate[i].n; k++) {
      TRY(candidate_differentiate(&s->grid[flight], now, &c->candidate[i], k, l->base, l->with, why));
      if (fill_column(t, s, flight, c->candidate[i].first + k, l) != ST_OK)
        return error_failed(why, "out of memory");
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
  lines_t l;
  model_t now;
  double *r[CHANNELS];
  *t = (table_t){.columns = c->columns};
  TRY(candidates_model(c, base, &now, why));
  if (!table_room(t, s) || !lines_make(&l, s)) {
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
