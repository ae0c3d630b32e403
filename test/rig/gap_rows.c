// gap_rows.c - synthetic rows.
#include "rig/gap_rows.h"

#include "base/random.h"
#include "rig/test.h"
#include "vehicle/model_file.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void *room(size_t n, size_t size) {
  void *const p = calloc(n, size);
  if (!p) abort();
  return p;
}

static rows_t rows(int n) {
  const size_t some = (size_t)n + 1;
  return (rows_t){.point = room(some, sizeof(int)),
                  .flight = room(some, sizeof(int)),
                  .block = room(some, sizeof(int)),
                  .follows = room(some, sizeof(bool))};
}

static void take_rows(gap_rows_t *g) {
  set_t *const s = &g->set;
  *s = (set_t){.grid = &g->grid, .n_grid = 1, .smooth = rows(GAP_ROWS), .range = rows(0), .n_half = 4};
  s->n_block = GAP_ROWS / 50;
  s->half = room((size_t)s->n_block + 1, sizeof(int));
  for (int i = 0; i < GAP_ROWS; i++) {
    rows_t *const r = &s->smooth;
    r->point[r->n] = i;
    r->block[r->n] = i / 50;
    s->half[i / 50] = 4 * i / GAP_ROWS;
    r->follows[r->n++] = i > 0;
    grid_point_t *const p = &g->grid.point[i];
    *p = (grid_point_t){.t_s = 0.04 * i, .ok = true, .q_wb = {.w = 1.0}, .clear_m = 1.0};
    p->pos_w_m = d3(sin(0.37 * i), 0.0, (double)i / GAP_ROWS);
  }
}

void gap_rows_make(gap_rows_t *g, unsigned long seed) {
  why_t why;
  memset(g, 0, sizeof *g);
  CHECK_OK(model_builtin("cf21_legacy", &g->model, &why));
  g->model.ceiling_m = HUGE_VAL;
  g->random = random_open(seed);
  g->flight = (gap_flight_t){.rate_Hz = 500.0, .t_s = room(1, sizeof(double))};
  g->grid = (grid_t){.flight = &g->flight,
                     .n = GAP_ROWS,
                     .point = room(GAP_ROWS, sizeof(grid_point_t)),
                     .period_s = 0.04,
                     .every = 1,
                     .has_force = true,
                     .has_rates = true,
                     .has_moments = true,
                     .has_position = true};
  take_rows(g);
  g->candidates = (candidates_t){.candidate = g->candidate};
  g->round =
      (round_t){.c = &g->candidates, .s = &g->set, .given = &g->model, .base = &g->model, .never = g->never};
  for (int ch = 0; ch < CHANNELS; ch++) {
    g->residual[ch] = room(GAP_ROWS + 1, sizeof(double));
    if (ch < CH_SMOOTH) gap_rows_white(g, g->residual[ch]);
  }
}

void gap_rows_free(gap_rows_t *g) {
  round_close(&g->round);
  for (int ch = 0; ch < CHANNELS; ch++) {
    for (int i = 0; i < GAP_COLUMNS; i++) free(g->column[ch][i]);
    free(g->residual[ch]);
  }
  free(g->flight.t_s);
  free(g->grid.point);
  free(g->set.half);
  rows_t *const r[] = {&g->set.smooth, &g->set.range};
  for (int i = 0; i < 2; i++) {
    free(r[i]->point);
    free(r[i]->flight);
    free(r[i]->block);
    free(r[i]->follows);
  }
  free(g->nominal.total);
  free(g->nominal.scan);
  free(g->nominal.kept);
  random_close(g->random);
}

int gap_rows_candidate(gap_rows_t *g, const char *effect) {
  candidate_t *const c = &g->candidate[g->candidates.n];
  const fx_t *const fx = fx_find(effect);
  *c = (candidate_t){.use = fx_use(fx), .first = g->candidates.columns, .n = fx->n_size, .to = fx->n_size};
  for (int k = 0; k < fx->n_size; k++) {
    c->use.p[fx->size[k].param] = 0.0;
    c->least[k] = fx->size[k].sign > 0 ? 0.0 : -HUGE_VAL;
    c->typical[k] = fabs(fx->param[fx->size[k].param].nominal);
    if (c->typical[k] == 0.0) c->typical[k] = fx->size[k].step;
  }
  const double *shape;
  c->n_shape = fx_use_shapes(&c->use, &shape);
  memcpy(c->shape, shape, sizeof c->shape);
  g->candidates.columns += c->n;
  return g->candidates.n++;
}

double *gap_rows_column(gap_rows_t *g, int candidate, int k, int channel) {
  double **const x = &g->column[channel][g->candidate[candidate].first + k];
  if (!*x) *x = room(GAP_ROWS + 1, sizeof(double));
  return *x;
}

void gap_rows_white(gap_rows_t *g, double *v) {
  for (int i = 0; i < GAP_ROWS; i++) v[i] = random_normal(g->random);
}

int gap_rows_along(gap_rows_t *g, const char *effect, int channel, double sure) {
  const int of = gap_rows_candidate(g, effect);
  for (int k = 0; k < g->candidate[of].n; k++) {
    double *const x = gap_rows_column(g, of, k, channel + k);
    gap_rows_white(g, x);
    for (int i = 0; i < GAP_ROWS; i++) x[i] *= sure / sqrt(GAP_ROWS);
  }
  return of;
}

void gap_rows_add(gap_rows_t *g, int candidate, int k, double times) {
  for (int ch = 0; ch < CHANNELS; ch++) {
    const double *const x = g->column[ch][g->candidate[candidate].first + k];
    for (int i = 0; x && i < GAP_ROWS; i++) g->residual[ch][i] += times * x[i];
  }
}

static double typical_of(const gap_rows_t *g, int column) {
  for (int i = 0; i < g->candidates.n; i++)
    if (column >= g->candidate[i].first && column < g->candidate[i].first + g->candidate[i].n)
      return g->candidate[i].typical[column - g->candidate[i].first];
  return 1.0;
}

void gap_rows_nominal(gap_rows_t *g, int flights, double information, const double *b) {
  const int n = g->candidates.columns, size = n + 1;
  free(g->nominal.total);
  free(g->nominal.scan);
  free(g->nominal.kept);
  g->nominal = (nominal_t){.n = flights, .size = size};
  g->nominal.total = room((size_t)(flights * size * size) + 1, sizeof(double));
  g->nominal.scan = room((size_t)flights + 1, sizeof(scan_t));
  g->nominal.kept = room((size_t)size, sizeof(double));
  for (int k = 0; k < size; k++) g->nominal.kept[k] = 1.0;
  for (int f = 0; f < flights; f++)
    for (int k = 0; k < n; k++) {
      double *const G = g->nominal.total + f * size * size;
      const double t = typical_of(g, k);
      G[k * (size + 1)] = information / t / t;
      G[k * size + n] = G[n * size + k] = information * b[f * n + k] / t;
    }
  g->round.nominal = &g->nominal;
}

static double *copy(const double *from, double over) {
  double *const to = room(GAP_ROWS + 1, sizeof(double));
  for (int i = 0; i < GAP_ROWS; i++) to[i] = from[i] / over;
  return to;
}

void gap_rows_open(gap_rows_t *g, int n, const int *chosen) {
  why_t why;
  round_t *const r = &g->round;
  round_close(r);
  r->choice = (choice_t){.n = n};
  for (int i = 0; i < n; i++) r->choice.of[i] = chosen[i];
  r->table = (design_t){.columns = g->candidates.columns};
  for (int ch = 0; ch < CHANNELS; ch++) {
    r->table.x[ch] = room((size_t)r->table.columns + 1, sizeof(double *));
    for (int k = 0; k < r->table.columns; k++)
      if (g->column[ch][k]) r->table.x[ch][k] = copy(g->column[ch][k], typical_of(g, k));
    r->table.x[ch][r->table.columns] = copy(g->residual[ch], 1.0);
  }
  CHECK_OK(score_make(&r->score, &g->candidates, &r->gram, r->nominal, &why));
  CHECK_OK(gram_make(&r->gram, &g->set, &r->table, NULL, r->score.color_ridge, &why));
}
