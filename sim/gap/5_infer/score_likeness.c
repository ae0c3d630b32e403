// score_likeness.c - could one effect stand for another, and how large must it be to be seen?
#include "base/lsq_blocks.h"
#include "gap/5_infer/score.h"
#include <math.h>

double judge_likeness(const judge_t *j, const choice_t *choice, int own, int other) {
  const gram_t *g = j->g;
  const candidate_t *a = &j->c->candidate[own], *c = &j->c->candidate[other];
  int column[COLUMN_MAX];
  const int n = choice_columns(j->c, choice, column), size = c->n + 1;
  double b[COLUMN_MAX], at[FX_SIZE_MAX], G[(FX_SIZE_MAX + 1) * (FX_SIZE_MAX + 1)] = {0.0};
  int order[FX_SIZE_MAX];
  judge_estimate(j, choice, b, NULL);
  for (int i = 0; i < n; i++) {
    const bool mine = column[i] >= a->first && column[i] < a->first + a->n;
    for (int k = 0; mine && k < c->n; k++)
      G[k * size + c->n] += b[i] * g->total[column[i] * g->size + c->first + k];
    for (int k = 0; mine && k < n; k++)
      if (column[k] >= a->first && column[k] < a->first + a->n)
        G[size * size - 1] += b[i] * b[k] * g->total[column[i] * g->size + column[k]];
  }
  for (int i = 0; i < c->n; i++) {
    order[i] = i;
    G[c->n * size + i] = G[i * size + c->n];
    for (int k = 0; k < c->n; k++) G[i * size + k] = g->total[(c->first + i) * g->size + c->first + k];
  }
  const double all = G[size * size - 1];
  return all > 0.0 ? 1.0 - lsq_solve_products(G, size, order, c->n, NULL, at, NULL) / all : 0.0;
}

double judge_alike(const judge_t *j, int column, int candidate) {
  const candidate_t *const c = &j->c->candidate[candidate];
  const int size = j->g->size, n = c->n + 1;
  double b[FX_SIZE_MAX], G[(FX_SIZE_MAX + 1) * (FX_SIZE_MAX + 1)] = {0.0};
  int of[FX_SIZE_MAX + 1], order[FX_SIZE_MAX];
  for (int i = 0; i < c->n; i++) of[order[i] = i] = c->first + i;
  of[c->n] = column;
  for (int i = 0; i < n; i++)
    for (int k = 0; k < n; k++) G[i * n + k] = j->g->total[of[i] * size + of[k]];
  const double all = G[n * n - 1];
  return all > 0.0 ? 1.0 - lsq_solve_products(G, n, order, c->n, NULL, b, NULL) / all : 0.0;
}

// A number b takes b^2 / (A^-1)_kk from the sum of squares.
void judge_least_gain(const judge_t *j, const choice_t *choice, double gain, double size[FX_SIZE_MAX]) {
  int column[COLUMN_MAX];
  double b[COLUMN_MAX], inverse[COLUMN_MAX * COLUMN_MAX];
  const int n = choice_columns(j->c, choice, column), own = j->c->candidate[choice->of[choice->n - 1]].n;
  lsq_solve_products(j->g->total, j->g->size, column, n, NULL, b, inverse);
  for (int k = 0; k < own; k++) {
    const double v = inverse[(n - own + k) * (n + 1)];
    size[k] = isfinite(v) && v > 0.0 ? sqrt(gain * v) : HUGE_VAL;
  }
}
