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

static bool is_inside(const set_t *s, const rows_t *r, const model_t *m, const cell_t *time, int row) {
  const double t_s = coordinate_of(COORDINATE_TIME, &s->grid[r->flight[row]], m, r->point[row]);
  return t_s >= time->from && t_s <= time->to;
}

// A block belongs where more of its rows are.
static void add_blocks(times_t *t, const gram_t *g, const set_t *s, const model_t *m, const cell_t *time) {
  const rows_t *const r = &s->smooth;
  const size_t n = (size_t)(g->size * g->size);
  for (int i = 0, end; i < r->n; i = end) {
    int inside = 0;
    for (end = i; end < r->n && r->block[end] == r->block[i]; end++) inside += is_inside(s, r, m, time, end);
    const int side = 2 * inside < end - i;
    t->blocks[side]++;
    for (size_t k = 0; k < n; k++) t->sums[side][k] += g->block[(size_t)r->block[i] * n + k];
  }
}

// By the channel in which it was found: it acts where more is left. False: half of that, or more, is there at
// other times, too.
static bool find_side(const set_t *s, const model_t *m, double *const residual[CHANNELS], const cell_t *time,
                      bool *outside) {
  const rows_t *const r = set_rows(s, time->channel);
  double squares[2] = {0.0}, rows[2] = {0.0};
  for (int i = 0; i < r->n; i++) {
    const int side = !is_inside(s, r, m, time, i);
    squares[side] += residual[time->channel][i] * residual[time->channel][i];
    rows[side] += 1.0;
  }
  *outside = squares[1] * rows[0] > squares[0] * rows[1];
  const int here = *outside, there = !here;
  return squares[there] * rows[here] < SCORE_MOST * squares[here] * rows[there];
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
                         const chosen_t *chosen, const cell_t *time, why_t *why) {
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
    for (int i = 0; i < 2; i++) t->sums[i] = calloc(room, sizeof(double));
    if (!t->sums[0] || !t->sums[1]) status = error_failed(why, "out of memory");
  }
  if (status == DONE) {
    add_blocks(t, &g, s, base, time);
    for (int i = 0; i < 2; i++) put_back(t->sums[i], t->size, known.n, column, b);
  }
  gram_free(&g);
  design_free(&table);
  return status;
}

// What a candidate alone takes from sums, at numbers that it can have: of what is chosen, beside its own.
static double taken_by(const candidate_t *c, const fx_use_t *chosen, const double *G, int size,
                       fx_use_t *use) {
  int column[FX_SIZE_MAX];
  double b[FX_SIZE_MAX], taken = 0.0;
  for (int k = 0; k < c->n; k++) column[k] = c->first + k;
  lsq_solve_products(G, size, column, c->n, NULL, b, NULL);
  *use = c->use;
  for (int k = 0; k < c->n; k++) {
    const double now = chosen ? fx_use_size(chosen, k) : 0.0;
    b[k] = isfinite(b[k]) ? candidate_possible(c, k, now + b[k]) - now : 0.0;
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

static void judge(for_a_time_t *to, const times_t *t, const candidates_t *c, const chosen_t *chosen) {
  const int last = t->size * t->size - 1, here = to->outside, there = !here;
  const double beyond = t->sums[here][last] - t->sums[there][last] / t->blocks[there] * t->blocks[here];
  if (!(beyond > 0.0)) return;
  for (int i = 0; i < c->n; i++) {
    const candidate_t *const one = &c->candidate[i];
    would_do_t would;
    const double share = taken_by(one, chosen_use(chosen, i), t->sums[here], t->size, &would.use) / beyond;
    would.share = fmin(share, 1.0);
    would.worth = share - CANDIDATES_MISFIT * (one->to - one->from - 1);
    if (would.worth >= SCORE_MOST && is_likely(one, &would.use)) put_in(to, would);
  }
  while (to->n && to->would[to->n - 1].worth < UNKNOWN_TIE * to->would[0].worth) to->n--;
}

done_t for_a_time(for_a_time_t *to, set_t *s, double *const residual[CHANNELS], const model_t *base,
                  const candidates_t *c, const chosen_t *chosen, const cell_t *cell, const cell_t *also,
                  why_t *why) {
  *to = (for_a_time_t){.n = 0};
  const cell_t *const time = cell->along == COORDINATE_TIME ? cell : also;
  if (time->along != COORDINATE_TIME || !(time->statistic > 0.0) || time->to - time->from < 2.0 * BLOCK_S)
    return DONE;
  if (!find_side(s, base, residual, time, &to->outside)) return DONE;
  times_t t = {.size = 0};
  const done_t status = times_make(&t, s, base, c, chosen, time, why);
  to->from_s = time->from;
  to->to_s = time->to;
  if (status == DONE && t.blocks[0] > 1 && t.blocks[1] > 1) judge(to, &t, c, chosen);
  free(t.sums[0]);
  free(t.sums[1]);
  return status;
}
