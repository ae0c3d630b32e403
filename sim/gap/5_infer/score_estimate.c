// score_estimate.c - the numbers of a choice, and their errors.
#include "gap/5_infer/score.h"

#include "base/lsq_blocks.h"
#include <math.h>
#include <string.h>

// Sets the products of the choice's columns with its residual in a block.
static void block_score(const gram_t *g, int block, int n, const int *column, const double *b,
                        double *score) {
  const int size = g->size;
  const double *const G = g->block + (size_t)block * (size_t)(size * size);
  for (int i = 0; i < n; i++) {
    score[i] = G[column[i] * size + size - 1];
    for (int k = 0; k < n; k++) score[i] -= G[column[i] * size + column[k]] * b[k];
  }
}

static double held_in(const gram_t *g, int block, int column) {
  return g->block[(size_t)block * (size_t)(g->size * g->size) + (size_t)(column * (g->size + 1))];
}

// V += (A^-1 s) (A^-1 s)'
static void add_score(const double *inverse, int n, const double *score, double *V) {
  double part[COLUMN_MAX] = {0.0};
  for (int i = 0; i < n; i++)
    for (int k = 0; k < n; k++) part[i] += inverse[i * n + k] * score[k];
  for (int i = 0; i < n; i++)
    for (int k = 0; k < n; k++) V[i * n + k] += part[i] * part[k];
}

// Enlarges V where clusters of whole flights, taken to be independent (Liang and Zeger 1986), give a larger
// error than blocks do, as Birge (1932) does for measurements that contradict each other. The error from two
// or three flights is badly known: by chance it is too large as often as too small. of: V by flights;
// flights: how many hold information about each number.
static void allow_for_flights(const double *of, const int *flights, int n, double *V) {
  double times[COLUMN_MAX];
  for (int i = 0; i < n; i++) {
    const double few = flights[i] > 1 ? flights[i] / (flights[i] - 1.0) : 0.0;
    const double from_flights = of[i * (n + 1)] * few, own = V[i * (n + 1)];
    times[i] = own > 0.0 ? sqrt(fmax(from_flights / own, 1.0)) : 1.0;
  }
  for (int i = 0; i < n; i++)
    for (int k = 0; k < n; k++) V[i * n + k] *= times[i] * times[k];
}

// V = A^-1 (sum over blocks of s s') A^-1, where s is a block's products of the columns and the residual.
void score_estimate(const score_t *j, const choice_t *choice, double *b, double *V) {
  const gram_t *g = j->g;
  int column[COLUMN_MAX], flights[COLUMN_MAX] = {0}, used = 0;
  double inverse[COLUMN_MAX * COLUMN_MAX], of_flights[COLUMN_MAX * COLUMN_MAX] = {0.0};
  const int n = choice_columns(j->c, choice, column), size = g->size;
  lsq_solve_products(g->total, size, column, n, NULL, b, inverse);
  if (!V) return;
  memset(V, 0, (size_t)(n * n) * sizeof(double));
  for (int block = 0; block < g->n_block;) {
    const int flight = gram_flight(g, block);
    double score[COLUMN_MAX], sum[COLUMN_MAX] = {0.0}, holds[COLUMN_MAX] = {0.0};
    for (; block < g->n_block && gram_flight(g, block) == flight; block++) {
      if (!(g->block[(size_t)(block + 1) * (size_t)(size * size) - 1] > 0.0)) continue;
      used++;
      block_score(g, block, n, column, b, score);
      add_score(inverse, n, score, V);
      for (int i = 0; i < n; i++) sum[i] += score[i], holds[i] += held_in(g, block, column[i]);
    }
    add_score(inverse, n, sum, of_flights);
    for (int i = 0; i < n; i++) flights[i] += holds[i] > 0.0;
  }
  const double few = used > n + 1 ? (double)used / (used - n) : 1e6;
  for (int i = 0; i < n * n; i++) V[i] *= few;
  if (g->n_flight > 1) allow_for_flights(of_flights, flights, n, V);
}
