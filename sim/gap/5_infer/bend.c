// bend.c - a shape and its size, estimated together: what nominal flights make of both.
#include "gap/5_infer/bend.h"

#include "base/lsq_blocks.h"
#include <math.h>
#include <string.h>

// A candidate whose shape is a length among others, and those of the same kind on both sides of it, or -1.
typedef struct {
  int own, side[2];
} row_of_shapes_t;

static double shape_of(const candidate_t *c) {
  return c->use.p[c->use.fx->shape_param];
}

static bool same_kind(const fx_use_t *a, const fx_use_t *b) {
  return a->fx == b->fx && (a->fx->n_kind < 2 || a->p[fx_use_kind(a)] == b->p[fx_use_kind(b)]);
}

static bool find_neighbours(const candidates_t *c, int own, row_of_shapes_t *row) {
  const candidate_t *const all = c->candidate;
  *row = (row_of_shapes_t){own, {-1, -1}};
  if (all[own].in_file || all[own].use.fx->n_shape < 2 || candidate_is_numbered(&all[own])) return false;
  const double here = shape_of(&all[own]);
  for (int i = 0; i < c->n; i++) {
    const double there = shape_of(&all[i]);
    if (!same_kind(&all[i].use, &all[own].use) || !(there != here)) continue;
    int *const side = &row->side[there > here];
    if (*side < 0 || fabs(there - here) < fabs(shape_of(&all[*side]) - here)) *side = i;
  }
  return row->side[0] >= 0 || row->side[1] >= 0;
}

// The derivative over the shape's logarithm: so many times the columns at the shape below, here, and above.
// Returns how far the farther one is: no shape that is tried lies beyond it.
static double slope_of(const candidates_t *c, const row_of_shapes_t *row, double weight[3]) {
  const double here = log(shape_of(&c->candidate[row->own]));
  double x[2] = {0.0, 0.0};
  for (int i = 0; i < 2; i++)
    if (row->side[i] >= 0) x[i] = log(shape_of(&c->candidate[row->side[i]])) - here;
  const bool both = row->side[0] >= 0 && row->side[1] >= 0;
  for (int i = 0; i < 2; i++) {
    const double other = x[1 - i], alone = row->side[i] >= 0 ? 1.0 / x[i] : 0.0;
    weight[2 * i] = both ? -other / (x[i] * (x[i] - other)) : alone;
  }
  weight[1] = -weight[0] - weight[2];
  return fmax(fabs(x[0]), fabs(x[1]));
}

// The choice's columns, the slope (number m) and the residual (m + 1), each as a sum over columns of G.
typedef struct {
  int m, n; // n: columns of G in all
  int of[COLUMN_MAX + 2 * FX_SIZE_MAX + 1];
  double part[COLUMN_MAX + 2][COLUMN_MAX + 2 * FX_SIZE_MAX + 1];
} sums_t;

static void take_part(sums_t *s, int which, int column, double times) {
  int at = 0;
  while (at < s->n && s->of[at] != column) at++;
  if (at == s->n) s->of[s->n++] = column;
  s->part[which][at] += times;
}

static void sums_make(sums_t *s, const candidates_t *c, const choice_t *choice, const row_of_shapes_t *row,
                      const double weight[3], const double *value) {
  int column[COLUMN_MAX];
  memset(s, 0, sizeof *s);
  s->m = choice_columns(c, choice, column);
  for (int i = 0; i < s->m; i++) take_part(s, i, column[i], 1.0);
  const int at[3] = {row->side[0], row->own, row->side[1]};
  for (int i = 0; i < 3; i++)
    for (int k = 0; at[i] >= 0 && k < c->candidate[row->own].n; k++)
      take_part(s, s->m, c->candidate[at[i]].first + k, weight[i] * value[k]);
  take_part(s, s->m + 1, c->columns, 1.0);
}

static void products(const sums_t *s, const double *G, int size, double *H) {
  for (int a = 0; a < s->m + 2; a++)
    for (int b = 0; b < s->m + 2; b++) {
      double sum = 0.0;
      for (int i = 0; i < s->n; i++)
        for (int k = 0; k < s->n; k++) sum += s->part[a][i] * s->part[b][k] * G[s->of[i] * size + s->of[k]];
      H[a * (s->m + 2) + b] = sum;
    }
}

bool bend_nominal(const score_t *j, const choice_t *choice, const double value[FX_SIZE_MAX], bend_t *bend) {
  const candidates_t *const c = j->c;
  const int flights = j->nominal ? j->nominal->n : 0, own = choice->of[choice->n - 1];
  row_of_shapes_t row;
  double weight[3], ridge[COLUMN_MAX + 1], b[COLUMN_MAX + 1], H[(COLUMN_MAX + 2) * (COLUMN_MAX + 2)];
  int column[COLUMN_MAX + 1];
  sums_t s;
  *bend = (bend_t){.shape = 0.0};
  if (flights == 0 || !find_neighbours(c, own, &row)) return false;
  const double far = slope_of(c, &row, weight);
  sums_make(&s, c, choice, &row, weight, value);
  for (int i = 0; i <= s.m; i++) {
    column[i] = i;
    ridge[i] = i < s.m ? j->ridge[s.of[i]] : 1.0 / (far * far);
  }
  for (int f = 0; f < flights; f++) {
    products(&s, j->nominal->total + (size_t)f * (size_t)(j->nominal->size * j->nominal->size),
             j->nominal->size, H);
    lsq_solve_products(H, s.m + 2, column, s.m + 1, ridge, b, NULL);
    for (int k = 0; k < c->candidate[own].n; k++) {
      const double error = b[s.m - c->candidate[own].n + k];
      bend->size[k] += error * error / flights;
    }
    bend->shape += b[s.m] * b[s.m] / flights;
  }
  for (int k = 0; k < c->candidate[own].n; k++) bend->size[k] = sqrt(bend->size[k]);
  bend->shape = sqrt(bend->shape);
  return true;
}

// --- the shape that fits best -----------------------------------------------------------------------------

// How far, in the logarithm, the shapes on both sides are; 0: there is none.
static void distances(const candidates_t *c, const row_of_shapes_t *row, double x[2]) {
  for (int i = 0; i < 2; i++)
    x[i] = row->side[i] < 0 ? 0.0
                            : log(shape_of(&c->candidate[row->side[i]]) / shape_of(&c->candidate[row->own]));
}

// Of the columns at the shape below, here and above, for one that is `on` from here: a parabola, or a line.
static void between(const double x[2], double on, double weight[3]) {
  for (int i = 0; i < 2; i++) {
    const double other = x[1 - i], alone = x[i] != 0.0 ? on / x[i] : 0.0;
    weight[2 * i] = other != 0.0 ? alone * (on - other) / (x[i] - other) : alone;
  }
  weight[1] = 1.0 - weight[0] - weight[2];
}

typedef struct {
  const score_t *j;
  const choice_t *beside;
  row_of_shapes_t row;
  double x[2];
} bent_t;

// A sum of columns.
typedef struct {
  int n, of[3];
  double times[3];
} mix_t;

static double product(const gram_t *g, const mix_t *a, const mix_t *b) {
  double sum = 0.0;
  for (int i = 0; i < a->n; i++)
    for (int k = 0; k < b->n; k++) sum += a->times[i] * b->times[k] * g->total[a->of[i] * g->size + b->of[k]];
  return sum;
}

// What is beside it, its own numbers and the residual; returns how many but for that.
static int mix(const bent_t *t, double on, mix_t m[COLUMN_MAX + FX_SIZE_MAX + 1]) {
  const candidates_t *const c = t->j->c;
  const int at[3] = {t->row.side[0], t->row.own, t->row.side[1]};
  int column[COLUMN_MAX];
  double weight[3];
  int n = choice_columns(c, t->beside, column);
  between(t->x, on, weight);
  for (int i = 0; i < n; i++) m[i] = (mix_t){1, {column[i]}, {1.0}};
  for (int k = 0; k < c->candidate[t->row.own].n; k++) {
    m[n] = (mix_t){.n = 0};
    for (int i = 0; i < 3; i++) {
      if (at[i] < 0) continue;
      m[n].of[m[n].n] = c->candidate[at[i]].first + k;
      m[n].times[m[n].n++] = weight[i];
    }
    n++;
  }
  m[n] = (mix_t){1, {c->columns}, {1.0}};
  return n;
}

// The sum of squares that is left with a shape that is `on` from here; HUGE_VAL: at a size that cannot be.
static double left_at(const bent_t *t, double on) {
  const candidate_t *const own = &t->j->c->candidate[t->row.own];
  mix_t m[COLUMN_MAX + FX_SIZE_MAX + 1];
  int order[COLUMN_MAX + FX_SIZE_MAX];
  double b[COLUMN_MAX + FX_SIZE_MAX], H[(COLUMN_MAX + FX_SIZE_MAX + 1) * (COLUMN_MAX + FX_SIZE_MAX + 1)];
  const int n = mix(t, on, m);
  for (int i = 0; i <= n; i++)
    for (int k = 0; k <= n; k++) H[i * (n + 1) + k] = product(t->j->g, &m[i], &m[k]);
  for (int i = 0; i < n; i++) order[i] = i;
  const double left = lsq_solve_products(H, n + 1, order, n, NULL, b, NULL);
  for (int k = 0; k < own->n; k++)
    if (own->use.fx->size[k].sign > 0 && b[n - own->n + k] < own->least[k]) return HUGE_VAL;
  return left;
}

double bend_best(const score_t *j, const choice_t *beside, int own) {
  const double golden = 0.618034, here = shape_of(&j->c->candidate[own]);
  bent_t t = {.j = j, .beside = beside};
  if (!find_neighbours(j->c, own, &t.row)) return here;
  distances(j->c, &t.row, t.x);
  double low = 0.5 * t.x[0], high = 0.5 * t.x[1];
  const double ends[2] = {low, high}, span = high - low;
  for (int i = 0; i < 20; i++) { // to 1e-4 of the span, a tenth of what is close to an end
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    if (left_at(&t, a) < left_at(&t, b))
      high = b;
    else
      low = a;
  }
  const double best = 0.5 * (low + high), close = 1e-3 * span;
  if (best - ends[0] < close || ends[1] - best < close) return here; // beyond, it is a neighbour's to find
  return left_at(&t, best) < left_at(&t, 0.0) * (1.0 - SELECT_GAIN) ? here * exp(best) : here;
}
