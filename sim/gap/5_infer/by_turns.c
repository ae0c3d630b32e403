// by_turns.c - the numbers of the chosen effects, by turn.
#include "gap/5_infer/by_turns.h"

#include "base/lsq_blocks.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
  candidates_t names; // the chosen, without what measured rotor speeds gave
  chosen_t own;       // the same, by their numbers in `names`
  design_t table;
  gram_t gram;
  score_t score;
  int *turn; // of each block
} fitting_t;

static void find_turns(const set_t *s, int *turn) {
  for (int list = 0; list < 2; list++) {
    const rows_t *const r = list ? &s->range : &s->smooth;
    for (int i = 0; i < r->n; i++) turn[r->block[i]] = by_turns_at(&s->grid[r->flight[i]], r->point[i]);
  }
}

bool by_turns_cover(const set_t *s) {
  double longest_s = 0.0;
  for (int i = 0; i < s->n_grid; i++) {
    const grid_t *const g = &s->grid[i];
    if (g->n) longest_s = fmax(longest_s, g->point[g->n - 1].t_s - g->point[0].t_s);
  }
  return longest_s >= TURNS * BLOCK_S;
}

done_t by_turns_estimate(const score_t *j, const int *turn, int held_out, chosen_t *own, why_t *why) {
  const gram_t *const g = j->g;
  const size_t n = (size_t)(g->size * g->size);
  int column[COLUMN_MAX];
  double b[COLUMN_MAX];
  double *const others = malloc(n * sizeof(double));
  if (!others) return error_failed(why, "out of memory");
  memcpy(others, g->total, n * sizeof(double));
  for (int block = 0; block < g->n_block; block++)
    for (size_t i = 0; turn[block] == held_out && i < n; i++) others[i] -= g->block[(size_t)block * n + i];
  for (int i = 0; i < j->c->columns; i++) column[i] = i;
  lsq_solve_products(others, g->size, column, j->c->columns, j->ridge, b, NULL);
  for (int i = 0; i < j->c->n; i++) {
    const candidate_t *const c = &j->c->candidate[i];
    for (int k = 0; k < c->n; k++) fx_use_resize(&own->use[i], k, candidate_possible(c, k, b[c->first + k]));
  }
  free(others);
  return DONE;
}

static done_t take_sums(fitting_t *t, set_t *s, const model_t *base, why_t *why) {
  int column[COLUMN_MAX];
  double value[COLUMN_MAX];
  for (int i = 0; i < t->names.n; i++)
    for (int k = 0; k < t->names.candidate[i].n; k++) {
      const int at = t->names.candidate[i].first + k;
      column[at] = at;
      value[at] = fx_use_size(&t->own.use[i], k);
    }
  const explained_t known = {t->names.columns, column, value, false, NULL};
  t->turn = calloc((size_t)s->n_block + 1, sizeof(int));
  if (!t->turn) return error_failed(why, "out of memory");
  find_turns(s, t->turn);
  TRY(design_make(&t->table, s, base, &t->names, &t->own, why));
  TRY(gram_make(&t->gram, s, &t->table, &known, NULL, why));
  return score_make(&t->score, &t->names, &t->gram, NULL, why);
}

done_t by_turns_make(by_turns_t *t, const candidates_t *c, set_t *s, const model_t *base,
                     const chosen_t *chosen, const timing_t *timing, why_t *why) {
  fitting_t by = {.turn = NULL};
  chosen_t rest = *chosen;
  model_t timed = *base;
  const fx_use_t *const measured = timing->measured ? chosen_use(chosen, timing->candidate) : NULL;
  *t = (by_turns_t){.n = TURNS};
  for (int k = 0; k < TURNS; k++) t->of[k] = *chosen;
  if (measured) {
    TRY(model_add_fx(&timed, measured, why));
    chosen_drop(&rest, timing->candidate);
  }
  if (rest.n == 0) return DONE;
  done_t status = candidates_chosen(&by.names, &by.own, c, &rest, why);
  if (status == DONE) status = take_sums(&by, s, &timed, why);
  for (int k = 0; k < TURNS && status == DONE; k++) {
    status = by_turns_estimate(&by.score, by.turn, k, &by.own, why);
    for (int i = 0; i < rest.n; i++) *chosen_take(&t->of[k], c, rest.of[i]) = by.own.use[i];
  }
  score_free(&by.score);
  gram_free(&by.gram);
  design_free(&by.table);
  candidates_free(&by.names);
  free(by.turn);
  return status;
}

void by_turns_drop(by_turns_t *t, int candidate) {
  for (int k = 0; k < t->n; k++) chosen_drop(&t->of[k], candidate);
}
