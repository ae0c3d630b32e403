// columns.c - the columns of the candidates.
#include "gap/4_candidates/candidates.h"

#include "gap/2_predict/lines.h"
#include "gap/2_predict/predict.h"
#include <math.h>
#include <stdlib.h>

done_t candidate_differentiate(grid_t *g, const path_t *now, const candidate_t *c, int k,
                               double *const base[CHANNELS], double *const with[CHANNELS], why_t *why) {
  const fx_size_t *size = &c->use.fx->size[k];
  fx_use_t more = c->use;
  more.p[size->param] += size->step;
  TRY(replay_with(g, now, &more, with, why));
  for (int ch = 0; ch < CHANNELS; ch++)
    for (int j = 0; j < g->n; j++) {
      const double d = (with[ch][j] - base[ch][j]) / size->step;
      with[ch][j] = isfinite(d) ? d : 0.0;
    }
  return DONE;
}

static bool all_zero(const double *v, int n) {
  for (int j = 0; j < n; j++)
    if (v[j] != 0.0) return false;
  return true;
}

static done_t fill_column(table_t *t, set_t *s, int flight, int column, const flight_lines_t *l) {
  double *row[CHANNELS] = {NULL};
  for (int ch = 0; ch < CHANNELS; ch++) {
    if (!residual_has(s, ch) || all_zero(l->with[ch], s->grid[flight].n)) continue;
    if (!t->x[ch][column]) t->x[ch][column] = calloc((size_t)set_rows(s, ch)->n + 1, sizeof(double));
    if (!t->x[ch][column]) return FAILED;
    row[ch] = t->x[ch][column];
  }
  residual_rows(s, flight, SERIES_PREDICTED, (const double *const *)l->with, l->scratch, row);
  return DONE;
}

// The effect that a candidate is another shape of, if that one is named.
static const fx_t *named_otherwise(const candidates_t *c, int candidate) {
  for (int i = 0; i < c->n; i++)
    if (i != candidate && c->candidate[i].named && c->candidate[i].use.fx == c->candidate[candidate].use.fx)
      return c->candidate[i].use.fx;
  return NULL;
}

static done_t fill_columns(table_t *t, set_t *s, int flight, const path_t *now, const fx_t *dropped,
                           const candidates_t *c, flight_lines_t *l, why_t *why) {
  for (int i = 0; i < c->n; i++) {
    if (named_otherwise(c, i) != dropped) continue;
    for (int k = 0; k < c->candidate[i].n; k++) {
      TRY(candidate_differentiate(&s->grid[flight], now, &c->candidate[i], k, l->base, l->with, why));
      if (fill_column(t, s, flight, c->candidate[i].first + k, l) != DONE)
        return error_failed(why, "out of memory");
    }
  }
  return DONE;
}

// The columns of the candidates that start from this model: of all but the other shapes of a named effect, or
// of those of one that the model has no longer.
static done_t fill_from(table_t *t, set_t *s, int flight, const model_t *m, const fx_t *dropped,
                        const candidates_t *c, flight_lines_t *l, why_t *why) {
  path_t path;
  done_t status = replay_keep(&s->grid[flight], m, &path, l->base, why);
  if (status == DONE) status = fill_columns(t, s, flight, &path, dropped, c, l, why);
  path_free(&path);
  return status;
}

static done_t fill_flight(table_t *t, set_t *s, int flight, const model_t *now, const candidates_t *c,
                          flight_lines_t *l, why_t *why) {
  TRY(fill_from(t, s, flight, now, NULL, c, l, why));
  for (int i = 0; i < c->n; i++) {
    const fx_t *const fx = c->candidate[i].use.fx;
    if (!c->candidate[i].named || fx->n_shape < 2) continue;
    model_t m = *now;
    model_drop_fx(&m, fx);
    TRY(fill_from(t, s, flight, &m, fx, c, l, why));
  }
  return DONE;
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

done_t table_make(table_t *t, set_t *s, const model_t *base, const candidates_t *c, why_t *why) {
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
  done_t status = residual_of(s, &now, r, why);
  for (int f = 0; f < s->n_grid && status == DONE; f++) status = fill_flight(t, s, f, &now, c, &l, why);
  free(l.room);
  if (status == DONE) add_named(t, s, c);
  if (status != DONE) table_free(t);
  return status;
}

void table_free(table_t *t) {
  for (int ch = 0; ch < CHANNELS; ch++) {
    for (int i = 0; t->x[ch] && i <= t->columns; i++) free(t->x[ch][i]);
    free(t->x[ch]);
    t->x[ch] = NULL;
  }
}
