// score.c - how well a choice of candidates explains the rows.
#include "gap/5_infer/score.h"

#include "base/lsq_blocks.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define HARM 0.01 // of the sum of squares of a group of channels
#define FAR  10.0 // times the typical size: what the ridge takes to be possible

done_t judge_make(judge_t *j, const candidates_t *c, const gram_t *g, const nominal_t *nominal, why_t *why) {
  *j = (judge_t){
      .c = c, .g = g, .nominal = nominal, .ridge = calloc(2 * (size_t)c->columns + 2, sizeof(double))};
  if (!j->ridge) return error_failed(why, "out of memory");
  j->color_ridge = j->ridge + c->columns + 1;
  for (int i = 0; i < c->n; i++)
    for (int k = 0; k < c->candidate[i].n; k++) {
      const double typical = FAR * candidate_typical(&c->candidate[i], k);
      const int column = c->candidate[i].first + k;
      j->ridge[column] = 1.0 / (typical * typical);
      j->color_ridge[column] = c->candidate[i].use.fx->only_beside_nominal ? 1e30 : j->ridge[column];
    }
  return DONE;
}

void judge_free(judge_t *j) {
  free(j->ridge);
}

// --- choices ----------------------------------------------------------------------------------------------

int choice_columns(const candidates_t *c, const choice_t *choice, int column[COLUMN_MAX]) {
  int n = 0;
  for (int i = 0; i < choice->n; i++)
    for (int k = 0; k < c->candidate[choice->of[i]].n && n < COLUMN_MAX; k++)
      column[n++] = c->candidate[choice->of[i]].first + k;
  return n;
}

choice_t choice_with(const choice_t *choice, int candidate) {
  choice_t with = *choice;
  if (with.n <= NAMED_MAX) with.of[with.n++] = candidate;
  return with;
}

choice_t choice_without(const choice_t *choice, int candidate) {
  choice_t less = {.n = 0};
  for (int i = 0; i < choice->n; i++)
    if (choice->of[i] != candidate) less.of[less.n++] = choice->of[i];
  return less;
}

bool choice_has(const choice_t *choice, int candidate) {
  for (int i = 0; i < choice->n; i++)
    if (choice->of[i] == candidate) return true;
  return false;
}

// --- scores -----------------------------------------------------------------------------------------------

double judge_left(const judge_t *j, const choice_t *choice, double *halves) {
  const gram_t *g = j->g;
  const size_t n = (size_t)(g->size * g->size);
  int column[COLUMN_MAX];
  double b[COLUMN_MAX], sum = 0.0;
  const int columns = choice_columns(j->c, choice, column);
  double *const others = malloc(n * sizeof(double));
  if (!others) return HUGE_VAL;
  for (int h = 0; h < g->n_half; h++) {
    const double *own = g->by_half + (size_t)h * n;
    for (size_t i = 0; i < n; i++) others[i] = g->total[i] - own[i];
    lsq_solve_products(others, g->size, column, columns, j->ridge, b, NULL);
    const double left = lsq_left(own, g->size, column, columns, b);
    if (halves) halves[h] = left;
    sum += left;
  }
  free(others);
  return sum;
}

// What a choice, fitted to the other half-flights, leaves of every group of channels.
static bool left_by_group(const judge_t *j, const choice_t *choice, double left[GROUPS]) {
  const gram_t *g = j->g;
  const size_t n = (size_t)(g->size * g->size);
  int column[COLUMN_MAX];
  double b[COLUMN_MAX];
  const int columns = choice_columns(j->c, choice, column);
  double *const others = malloc(n * sizeof(double));
  for (int i = 0; i < GROUPS; i++) left[i] = 0.0;
  for (int h = 0; others && h < g->n_half; h++) {
    const double *own = g->by_half + (size_t)h * n;
    for (size_t i = 0; i < n; i++) others[i] = g->total[i] - own[i];
    lsq_solve_products(others, g->size, column, columns, j->ridge, b, NULL);
    for (int i = 0; i < GROUPS; i++)
      left[i] += lsq_left(g->by_group[i] + (size_t)h * n, g->size, column, columns, b);
  }
  free(others);
  return others != NULL;
}

bool judge_harms(const judge_t *j, const choice_t *without, const choice_t *with) {
  double before[GROUPS], after[GROUPS];
  if (!left_by_group(j, without, before) || !left_by_group(j, with, after)) return true;
  for (int i = 0; i < GROUPS; i++)
    if (after[i] > before[i] * (1.0 + HARM) + 10.0) return true;
  return false;
}

double judge_fitted(const judge_t *j, const choice_t *choice) {
  int column[COLUMN_MAX];
  double b[COLUMN_MAX];
  const int n = choice_columns(j->c, choice, column);
  return lsq_solve_products(j->g->total, j->g->size, column, n, NULL, b, NULL);
}

bool judge_is_sure(const judge_t *j, const choice_t *worse, const choice_t *better) {
  const int n = j->g->n_half;
  double *const a = calloc(2 * (size_t)n + 1, sizeof(double)), sum = 0.0, squares = 0.0;
  if (!a) return false;
  judge_left(j, worse, a);
  judge_left(j, better, a + n);
  for (int h = 0; h < n; h++) {
    const double less = a[h] - a[n + h];
    sum += less;
    squares += less * less;
  }
  free(a);
  return sum > SELECT_SURE * sqrt(squares);
}

// The sum of squares that both leave differs by D; the fits by d, white. Where the better one is true, D is
// d^2 with a standard error of 2 d.
bool judge_is_rival(const judge_t *j, const choice_t *own, const choice_t *other) {
  const gram_t *g = j->g;
  int column[2 * COLUMN_MAX];
  double b[2 * COLUMN_MAX], apart = 0.0;
  const int n = choice_columns(j->c, own, column), m = choice_columns(j->c, other, column + n);
  const double left = lsq_solve_products(g->total, g->size, column, n, j->ridge, b, NULL);
  const double left_other = lsq_solve_products(g->total, g->size, column + n, m, j->ridge, b + n, NULL);
  for (int i = n; i < n + m; i++) b[i] = -b[i];
  for (int i = 0; i < n + m; i++)
    for (int k = 0; k < n + m; k++) apart += b[i] * b[k] * g->total[column[i] * g->size + column[k]];
  return left_other - left < JUDGE_RIVAL_SPAN * sqrt(fmax(apart, 0.0));
}

// V = A^-1 (sum over blocks of s s') A^-1, s: the block's products of columns and what is left.
void judge_estimate(const judge_t *j, const choice_t *choice, double *b, double *V) {
  const gram_t *g = j->g;
  int column[COLUMN_MAX], used = 0;
  double inverse[COLUMN_MAX * COLUMN_MAX], part[COLUMN_MAX];
  const int n = choice_columns(j->c, choice, column), size = g->size;
  lsq_solve_products(g->total, size, column, n, NULL, b, inverse);
  if (!V) return;
  memset(V, 0, (size_t)(n * n) * sizeof(double));
  for (int block = 0; block < g->n_block; block++) {
    const double *G = g->block + (size_t)block * (size_t)(size * size);
    if (!(G[size * size - 1] > 0.0)) continue;
    used++;
    double score[COLUMN_MAX];
    for (int i = 0; i < n; i++) {
      score[i] = G[column[i] * size + size - 1];
      for (int k = 0; k < n; k++) score[i] -= G[column[i] * size + column[k]] * b[k];
    }
    for (int i = 0; i < n; i++) {
      part[i] = 0.0;
      for (int k = 0; k < n; k++) part[i] += inverse[i * n + k] * score[k];
    }
    for (int i = 0; i < n; i++)
      for (int k = 0; k < n; k++) V[i * n + k] += part[i] * part[k];
  }
  const double few = used > n + 1 ? (double)used / (used - n) : 1e6;
  for (int i = 0; i < n * n; i++) V[i] *= few;
}

void judge_nominal_rms(const judge_t *j, const choice_t *choice, double rms[FX_SIZE_MAX]) {
  int column[COLUMN_MAX];
  double b[COLUMN_MAX];
  const int n = choice_columns(j->c, choice, column), own = j->c->candidate[choice->of[choice->n - 1]].n;
  for (int k = 0; k < own; k++) rms[k] = 0.0;
  for (int i = 0; j->nominal && i < j->nominal->n; i++) {
    const size_t at = (size_t)i * (size_t)(j->nominal->size * j->nominal->size);
    lsq_solve_products(j->nominal->total + at, j->nominal->size, column, n, j->ridge, b, NULL);
    for (int k = 0; k < own; k++) rms[k] += b[n - own + k] * b[n - own + k] / j->nominal->n;
  }
  for (int k = 0; k < own; k++) rms[k] = sqrt(rms[k]);
}

verdict_t judge_last(const judge_t *j, const choice_t *choice) {
  verdict_t v = {.p = 1.0};
  double b[COLUMN_MAX], V[COLUMN_MAX * COLUMN_MAX], own[FX_SIZE_MAX * FX_SIZE_MAX], rms[FX_SIZE_MAX];
  const int n_own = j->c->candidate[choice->of[choice->n - 1]].n;
  int column[COLUMN_MAX];
  const int n = choice_columns(j->c, choice, column);
  for (int i = n - n_own; i < n; i++) // nothing in these flights depends on it
    if (!(j->g->total[column[i] * (j->g->size + 1)] > 0.0)) return v;
  judge_estimate(j, choice, b, V);
  for (int i = 0; i < n_own; i++) {
    v.value[i] = b[n - n_own + i];
    v.stderr_[i] = sqrt(V[(n - n_own + i) * (n + 1)]);
    for (int k = 0; k < n_own; k++) own[i * n_own + k] = V[(n - n_own + i) * n + n - n_own + k];
  }
  const double blocks = fmax(j->g->n_block - n, 2.0);
  v.p = lsq_f_above(lsq_wald(v.value, own, n_own) / n_own, n_own, blocks);
  judge_nominal_rms(j, choice, rms);
  double sum = 0.0;
  for (int i = 0; i < n_own; i++) sum += rms[i] > 0.0 ? v.value[i] * v.value[i] / (rms[i] * rms[i]) : 1e12;
  v.over_nominal = sqrt(sum / n_own);
  return v;
}

// Size k of a candidate, or something that is `margin` from it, is one that the effect can have.
static bool can_be(const candidate_t *c, int k, double value, double margin) {
  const fx_size_t *size = &c->use.fx->size[k];
  int n;
  const fx_param_t *param = &fx_use_params(&c->use, &n)[size->param];
  const double least = c->least[k];
  return value - margin <= param->max && (size->sign > 0 ? value + margin > least : value + margin >= least);
}

bool judge_is_possible(const judge_t *j, const choice_t *choice) {
  const candidate_t *c = &j->c->candidate[choice->of[choice->n - 1]];
  const verdict_t v = judge_last(j, choice);
  for (int k = 0; k < c->n; k++)
    if (!can_be(c, k, v.value[k], 2.0 * v.stderr_[k])) return false;
  return true;
}

bool judge_allows(const judge_t *j, const choice_t *choice, const verdict_t *v) {
  const candidate_t *c = &j->c->candidate[choice->of[choice->n - 1]];
  double largest = 0.0; // in parts of what is typical
  if (!j->nominal && c->use.fx->only_beside_nominal) return false;
  for (int k = 0; k < c->n; k++) {
    if (!can_be(c, k, v->value[k], 0.0)) return false;
    largest = fmax(largest, fabs(v->value[k]) / candidate_typical(c, k));
  }
  return largest > SELECT_LEAST && v->p * j->c->n < SELECT_ALPHA && v->over_nominal > SELECT_NOMINAL;
}
