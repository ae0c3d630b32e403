// for_a_time.c - which effects of the library would do for what has no name, if they acted for a time only.
#include "gap/5_infer/for_a_time.h"

#include "base/lsq_blocks.h"
#include "gap/5_infer/coordinates.h"
#include "gap/5_infer/evidence.h"
#include "gap/5_infer/limits.h"
#include "gap/5_infer/unknown.h"
#include "gap/5_infer/whiten.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Sums of products in that time, and in all other; products with the residual without what is chosen.
typedef struct {
  int size, blocks[2];
  double *sums[2];
} times_t;

static void add_block(times_t *t, const gram_t *g, int block, bool inside) {
  const size_t n = (size_t)(g->size * g->size);
  t->blocks[!inside]++;
  for (size_t i = 0; i < n; i++) t->sums[!inside][i] += g->block[(size_t)block * n + i];
}

static void add_blocks(times_t *t, const gram_t *g, const set_t *s, const model_t *m, const cell_t *cell) {
  const rows_t *const r = &s->smooth;
  for (int i = 0, end; i < r->n; i = end) {
    double sum_s = 0.0;
    for (end = i; end < r->n && r->block[end] == r->block[i]; end++)
      sum_s += coordinate_of(COORDINATE_TIME, &s->grid[r->flight[end]], m, r->point[end]);
    const double middle_s = sum_s / (end - i);
    add_block(t, g, r->block[i], middle_s >= cell->from && middle_s <= cell->to);
  }
}

// The last column is the residual with what is chosen taken out again: it is put back.
static void put_back(double *G, int size, int n, const int *column, const double *b) {
  const int last = size - 1;
  double squares = G[last * size + last];
  for (int k = 0; k < n; k++) {
    squares -= 2.0 * b[k] * G[column[k] * size + last];
    for (int i = 0; i < n; i++) squares += b[k] * b[i] * G[column[k] * size + column[i]];
  }
  for (int j = 0; j < last; j++)
    for (int k = 0; k < n; k++) {
      G[j * size + last] -= b[k] * G[j * size + column[k]];
      G[last * size + j] = G[j * size + last];
    }
  G[last * size + last] = squares;
}

static int numbers_of(const candidates_t *c, const chosen_t *chosen, int *column, double *b) {
  int n = 0;
  for (int i = 0; i < chosen->n; i++) {
    const candidate_t *const one = &c->candidate[chosen->of[i]];
    for (int k = 0; k < one->n; k++, n++) {
      column[n] = one->first + k;
      b[n] = fx_use_size(&chosen->use[i], k);
    }
  }
  return n;
}

static done_t times_make(times_t *t, set_t *s, const model_t *base, const candidates_t *c,
                         const chosen_t *chosen, const cell_t *cell, why_t *why) {
  int column[CHOSEN_MAX * FX_SIZE_MAX];
  double b[CHOSEN_MAX * FX_SIZE_MAX];
  design_t table = {.columns = 0};
  gram_t g = {.size = 0};
  const explained_t known = {numbers_of(c, chosen, column, b), column, b, true};
  done_t status = design_make(&table, s, base, c, chosen, why);
  if (status == DONE) status = gram_make(&g, s, &table, &known, NULL, why);
  if (status == DONE) {
    const size_t room = (size_t)(g.size * g.size);
    t->size = g.size;
    t->sums[0] = calloc(2 * room, sizeof(double));
    t->sums[1] = t->sums[0] + room;
    if (!t->sums[0]) status = error_failed(why, "out of memory");
  }
  if (status == DONE) {
    add_blocks(t, &g, s, base, cell);
    for (int i = 0; i < 2; i++) put_back(t->sums[i], t->size, known.n, column, b);
  }
  gram_free(&g);
  design_free(&table);
  return status;
}

// What a candidate alone takes from sums, at numbers that it can have.
static double taken_by(const candidate_t *c, const double *G, int size, fx_use_t *use) {
  int column[FX_SIZE_MAX];
  double b[FX_SIZE_MAX], taken = 0.0;
  for (int k = 0; k < c->n; k++) column[k] = c->first + k;
  lsq_solve_products(G, size, column, c->n, NULL, b, NULL);
  *use = c->use;
  for (int k = 0; k < c->n; k++) {
    b[k] = isfinite(b[k]) ? candidate_possible(c, k, b[k]) : 0.0;
    fx_use_resize(use, k, b[k]);
  }
  for (int k = 0; k < c->n; k++) {
    taken += 2.0 * b[k] * G[column[k] * size + size - 1];
    for (int i = 0; i < c->n; i++) taken -= b[k] * b[i] * G[column[k] * size + column[i]];
  }
  return taken;
}

// No number is larger than the evidence's prior has it.
static bool is_likely(const candidate_t *c, const fx_use_t *use) {
  bool likely = !c->barred;
  for (int k = 0; k < c->n; k++)
    likely = likely && fabs(fx_use_size(use, k)) <= EVIDENCE_TYPICAL_MOST * c->typical[k];
  return likely;
}

static void take_out(for_a_time_t *to, int i) {
  to->n--;
  for (int k = i; k < to->n; k++) to->would[k] = to->would[k + 1];
}

// One of each effect, the one that is worth most first.
static void put_in(for_a_time_t *to, would_do_t one) {
  for (int i = 0; i < to->n; i++) {
    if (to->would[i].use.fx != one.use.fx) continue;
    if (to->would[i].worth >= one.worth) return;
    take_out(to, i);
  }
  int at = to->n;
  while (at > 0 && to->would[at - 1].worth < one.worth) at--;
  if (at == FOR_A_TIME_MAX) return;
  if (to->n < FOR_A_TIME_MAX) to->n++;
  for (int k = to->n - 1; k > at; k--) to->would[k] = to->would[k - 1];
  to->would[at] = one;
}

static void judge(for_a_time_t *to, const times_t *t, const candidates_t *c) {
  const int last = t->size * t->size - 1;
  const double in = t->sums[0][last] / t->blocks[0], out = t->sums[1][last] / t->blocks[1];
  const double beyond = fabs(in - out) * t->blocks[out > in];
  to->outside = out > in;
  for (int i = 0; i < c->n; i++) {
    would_do_t one;
    const double share = taken_by(&c->candidate[i], t->sums[to->outside], t->size, &one.use) / beyond;
    one.share = fmin(share, 1.0);
    one.worth = share - CANDIDATES_MISFIT * (c->candidate[i].n - 1);
    if (one.worth >= SCORE_MOST && is_likely(&c->candidate[i], &one.use)) put_in(to, one);
  }
  while (to->n && to->would[to->n - 1].worth < UNKNOWN_TIE * to->would[0].worth) to->n--;
}

done_t for_a_time(for_a_time_t *to, set_t *s, const model_t *base, const candidates_t *c,
                  const chosen_t *chosen, const cell_t *cell, const cell_t *also, why_t *why) {
  *to = (for_a_time_t){.n = 0};
  const cell_t *const time = cell->along == COORDINATE_TIME ? cell : also;
  if (time->along != COORDINATE_TIME || !(time->statistic > 0.0)) return DONE;
  times_t t = {.size = 0};
  const done_t status = times_make(&t, s, base, c, chosen, time, why);
  to->from_s = time->from;
  to->to_s = time->to;
  if (status == DONE && t.blocks[0] > 1 && t.blocks[1] > 1) judge(to, &t, c);
  free(t.sums[0]);
  return status;
}
