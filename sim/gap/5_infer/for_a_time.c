// for_a_time.c - which effects of the library would explain an unnamed residual, acting only for a time.
#include "gap/5_infer/for_a_time.h"

#include "gap/5_infer/coordinates.h"
#include "gap/5_infer/limits.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Sums of products inside the time and outside it; the residual is what the model with the chosen effects
// leaves.
typedef struct {
  int size, blocks[2];
  double *sums[2];
} times_t;

static bool is_inside(const set_t *s, const rows_t *r, const model_t *m, const cell_t *time, int row) {
  const double t_s = coordinate_of(COORDINATE_TIME, &s->grid[r->flight[row]], m, r->point[row]);
  return t_s >= time->from && t_s <= time->to;
}

// Adds each block to the side on which most of its rows are.
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

// Sets *outside if the mean square of the cell's channel is larger outside the time. False: the other side
// has half of it or more.
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

static done_t times_make(times_t *t, set_t *s, const model_t *base, const candidates_t *c,
                         const chosen_t *chosen, const cell_t *time, why_t *why) {
  remains_t left;
  done_t status = remains_make(&left, s, base, c, chosen, why);
  if (status == DONE) {
    const size_t room = (size_t)(left.g.size * left.g.size);
    t->size = left.g.size;
    for (int i = 0; i < 2; i++) t->sums[i] = calloc(room, sizeof(double));
    if (!t->sums[0] || !t->sums[1]) status = error_failed(why, "out of memory");
  }
  if (status == DONE) {
    add_blocks(t, &left.g, s, base, time);
    for (int i = 0; i < 2; i++) remains_put_back(&left, t->sums[i]);
  }
  remains_free(&left);
  return status;
}

static void judge(for_a_time_t *to, const times_t *t, const candidates_t *c, const chosen_t *chosen) {
  const int last = t->size * t->size - 1, here = to->outside, there = !here;
  const double beyond = t->sums[here][last] - t->sums[there][last] / t->blocks[there] * t->blocks[here];
  if (!(beyond > 0.0)) return;
  for (int i = 0; i < c->n; i++) {
    fx_use_t use;
    const double *const G = t->sums[here];
    const double taken = acts_takes(&c->candidate[i], chosen_use(chosen, i), G, G, t->size, &use);
    acts_add(&to->as, c, i, &use, taken, beyond);
  }
  acts_keep_best(&to->as);
}

done_t for_a_time(for_a_time_t *to, set_t *s, double *const residual[CHANNELS], const model_t *base,
                  const candidates_t *c, const chosen_t *chosen, const cell_t *cell, const cell_t *also,
                  why_t *why) {
  *to = (for_a_time_t){.outside = false};
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
