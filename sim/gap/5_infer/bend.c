// bend.c - shape and size of an effect estimated together.
#include "gap/5_infer/bend.h"

#include "base/lsq_blocks.h"
#include <math.h>

// A candidate with a continuous shape, and those of its kind with the next smaller and larger one, or -1.
typedef struct {
  int own, side[2];
} row_of_shapes_t;

static double shape_of(const candidate_t *c) {
  return fx_use_shape(&c->use);
}

static bool same_kind(const fx_use_t *a, const fx_use_t *b) {
  return a->fx == b->fx && a->form == b->form &&
         (a->fx->n_kind < 2 || a->p[fx_use_kind(a)] == b->p[fx_use_kind(b)]);
}

static bool find_neighbours(const candidates_t *c, int own, row_of_shapes_t *row) {
  const candidate_t *const all = c->candidate;
  *row = (row_of_shapes_t){own, {-1, -1}};
  if (all[own].in_file || all[own].n_shape < 2 || candidate_is_numbered(&all[own])) return false;
  const double here = shape_of(&all[own]);
  for (int i = 0; i < c->n; i++) {
    if (!same_kind(&all[i].use, &all[own].use)) continue;
    const double there = shape_of(&all[i]);
    if (!(there != here)) continue;
    int *const side = &row->side[there > here];
    if (*side < 0 || fabs(there - here) < fabs(shape_of(&all[*side]) - here)) *side = i;
  }
  return row->side[0] >= 0 || row->side[1] >= 0;
}

// Distances to the neighbours' shapes, in the logarithm; 0: there is none.
static void distances(const candidates_t *c, const row_of_shapes_t *row, double x[2]) {
  for (int i = 0; i < 2; i++)
    x[i] = row->side[i] < 0 ? 0.0
                            : log(shape_of(&c->candidate[row->side[i]]) / shape_of(&c->candidate[row->own]));
}

// A weighted sum of columns.
typedef struct {
  int n, of[3 * FX_SIZE_MAX];
  double times[3 * FX_SIZE_MAX];
} mix_t;

enum { MIXED = COLUMN_MAX + FX_SIZE_MAX + 1 }; // columns of a choice, those of a shape, the residual

static mix_t column_alone(int column) {
  return (mix_t){1, {column}, {1.0}};
}

static int mix_choice(const candidates_t *c, const choice_t *choice, mix_t m[COLUMN_MAX]) {
  int column[COLUMN_MAX];
  const int n = choice_columns(c, choice, column);
  for (int i = 0; i < n; i++) m[i] = column_alone(column[i]);
  return n;
}

// Adds column k of the shape below, the own one and the one above to a sum, each by its weight times `times`.
static void mix_shapes(const candidates_t *c, const row_of_shapes_t *row, const double weight[3],
                       double times, int k, mix_t *m) {
  const int at[3] = {row->side[0], row->own, row->side[1]};
  for (int i = 0; i < 3; i++) {
    if (at[i] < 0) continue;
    m->of[m->n] = c->candidate[at[i]].first + k;
    m->times[m->n++] = times * weight[i];
  }
}

static void products(int n, const mix_t *m, const double *G, int size, double *H) {
  for (int a = 0; a < n; a++)
    for (int b = 0; b < n; b++) {
      double sum = 0.0;
      for (int i = 0; i < m[a].n; i++)
        for (int k = 0; k < m[b].n; k++)
          sum += m[a].times[i] * m[b].times[k] * G[m[a].of[i] * size + m[b].of[k]];
      H[a * n + b] = sum;
    }
}

// --- errors on nominal flights ----------------------------------------------------------------------------

// Weights for the derivative by the shape's logarithm: of the parabola through all three, or of a line.
static void slope_of(const double x[2], double weight[3]) {
  for (int i = 0; i < 2; i++) {
    const double other = x[1 - i], alone = x[i] != 0.0 ? 1.0 / x[i] : 0.0;
    weight[2 * i] = other != 0.0 ? -alone * other / (x[i] - other) : alone;
  }
  weight[1] = -weight[0] - weight[2];
}

bool bend_nominal(const score_t *j, const choice_t *choice, const double value[FX_SIZE_MAX], bend_t *bend) {
  const candidates_t *const c = j->c;
  const int flights = j->nominal ? j->nominal->n : 0, own = choice->of[choice->n - 1];
  const int sizes = c->candidate[own].n; // followed by the slope
  row_of_shapes_t row;
  double x[2], weight[3], ridge[MIXED], b[MIXED], H[MIXED * MIXED], inverse[MIXED * MIXED];
  double made[FX_SIZE_MAX + 1][NOMINAL_FLIGHTS], holds[FX_SIZE_MAX + 1][NOMINAL_FLIGHTS];
  int order[MIXED];
  mix_t m[MIXED];
  *bend = (bend_t){.shape = 0.0};
  if (flights == 0 || !find_neighbours(c, own, &row)) return false;
  distances(c, &row, x);
  slope_of(x, weight);
  const int n = mix_choice(c, choice, m); // column n: the slope
  m[n] = (mix_t){.n = 0};
  for (int k = 0; k < sizes; k++) mix_shapes(c, &row, weight, value[k], k, &m[n]);
  m[n + 1] = column_alone(c->columns);
  const double far = fmax(fabs(x[0]), fabs(x[1])); // no shape beyond it is tried
  for (int i = 0; i <= n; i++) {
    order[i] = i;
    ridge[i] = i < n ? j->ridge[m[i].of[0]] : 1.0 / (far * far);
  }
  for (int f = 0; f < flights; f++) {
    const int size = j->nominal->size;
    products(n + 2, m, j->nominal->total + (size_t)f * (size_t)(size * size), size, H);
    lsq_solve_products(H, n + 2, order, n + 1, ridge, b, inverse);
    for (int k = 0; k <= sizes; k++) {
      const int at = n - sizes + k;
      made[k][f] = b[at];
      holds[k][f] = 1.0 / inverse[at * (n + 2)];
    }
  }
  for (int k = 0; k < sizes; k++) bend->size[k] = score_rms(made[k], holds[k], flights);
  bend->shape = score_rms(made[sizes], holds[sizes], flights);
  return true;
}

// --- the shape that fits best -----------------------------------------------------------------------------

// Weights that give the columns at the logarithmic distance `on` from the own shape: of a parabola or a line.
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

// Returns the sum of squares that the shape at distance `on` leaves; HUGE_VAL if a size is impossible.
static double left_at(const bent_t *t, double on) {
  const candidates_t *const c = t->j->c;
  const candidate_t *const own = &c->candidate[t->row.own];
  const gram_t *const g = t->j->g;
  mix_t m[MIXED];
  int order[MIXED];
  double weight[3], b[MIXED], H[MIXED * MIXED];
  int n = mix_choice(c, t->beside, m);
  between(t->x, on, weight);
  for (int k = 0; k < own->n; k++) {
    m[n] = (mix_t){.n = 0};
    mix_shapes(c, &t->row, weight, 1.0, k, &m[n++]);
  }
  m[n] = column_alone(c->columns);
  products(n + 1, m, g->total, g->size, H);
  for (int i = 0; i < n; i++) order[i] = i;
  const double left = lsq_solve_products(H, n + 1, order, n, NULL, b, NULL);
  for (int k = 0; k < own->n; k++)
    if (own->use.fx->size[k].sign > 0 && b[n - own->n + k] < own->least[k]) return HUGE_VAL;
  return left;
}

double bend_best(const score_t *j, const choice_t *beside, int own, double reach) {
  const double golden = 0.618034, here = shape_of(&j->c->candidate[own]);
  bent_t t = {.j = j, .beside = beside};
  if (!find_neighbours(j->c, own, &t.row)) return here;
  distances(j->c, &t.row, t.x);
  double low = reach * t.x[0], high = reach * t.x[1];
  const double ends[2] = {low, high}, span = high - low;
  for (int i = 0; i < 20; i++) { // to 1e-4 of the span, a tenth of `close`
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    if (left_at(&t, a) < left_at(&t, b))
      high = b;
    else
      low = a;
  }
  const double best = 0.5 * (low + high), close = 1e-3 * span;
  if (best - ends[0] < close || ends[1] - best < close) return here; // at an end: a neighbour's to find
  return left_at(&t, best) < left_at(&t, 0.0) * (1.0 - SELECT_GAIN) ? here * exp(best) : here;
}
