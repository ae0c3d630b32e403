// score.c - how well a choice of candidates explains the rows.
#include "gap/5_infer/score.h"

#include "base/lsq_blocks.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Share of the sum of squares of a group of channels, and of what a name takes from the other groups, that
// the name may add to the group. The others' errors add as much, and so do those of the signals that the
// name depends on: moments under a ceiling depend on the tilt, so the tilt's errors show in the turning
// (4.9 % more of it in users' set 26255, where the ceiling takes 96 % of the forces' squares; 6.5 % in
// 28725, and 3 % of what it takes). In users 24000, 25500 and 26200, 240 sets each, 0.01 misses eight names
// that 0.05 finds, and tells two more wrong ones; a bound of 0.1 of what is taken instead misses an inertia
// (26212), no bound tells a wrong name (26399).
#define HARM 0.05
// How large a number may be, over its typical size: the ridge holds back a number that a half-flight does
// not show.
#define FAR 10.0

done_t score_make(score_t *j, const candidates_t *c, const gram_t *g, const nominal_t *nominal, why_t *why) {
  *j = (score_t){
      .c = c, .g = g, .nominal = nominal, .ridge = calloc(2 * (size_t)c->columns + 2, sizeof(double))};
  if (!j->ridge) return error_failed(why, "out of memory");
  j->color_ridge = j->ridge + c->columns + 1;
  for (int i = 0; i < c->n; i++)
    for (int k = 0; k < c->candidate[i].n; k++) {
      const double typical = FAR * c->candidate[i].typical[k];
      const int column = c->candidate[i].first + k;
      j->ridge[column] = 1.0 / (typical * typical);
      j->color_ridge[column] = c->candidate[i].use.fx->control_makes ? 1e30 : j->ridge[column];
    }
  return DONE;
}

void score_free(score_t *j) {
  free(j->ridge);
  j->ridge = NULL;
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

double score_left(const score_t *j, const choice_t *choice, double *halves) {
  const gram_t *g = j->g;
  const size_t n = (size_t)(g->size * g->size);
  int column[COLUMN_MAX];
  double b[COLUMN_MAX], sum = 0.0;
  const int columns = choice_columns(j->c, choice, column);
  for (int h = 0; h < g->n_half; h++) {
    lsq_solve_products(g->others + (size_t)h * n, g->size, column, columns, j->ridge, b, NULL);
    const double left = lsq_left(g->by_half + (size_t)h * n, g->size, column, columns, b);
    if (halves) halves[h] = left;
    sum += left;
  }
  return sum;
}

// Sets what a choice leaves of every group of channels, each half-flight explained by a fit to the others.
static void left_by_group(const score_t *j, const choice_t *choice, double left[GROUPS]) {
  const gram_t *g = j->g;
  const size_t n = (size_t)(g->size * g->size);
  int column[COLUMN_MAX];
  double b[COLUMN_MAX];
  const int columns = choice_columns(j->c, choice, column);
  for (int i = 0; i < GROUPS; i++) left[i] = 0.0;
  for (int h = 0; h < g->n_half; h++) {
    lsq_solve_products(g->others + (size_t)h * n, g->size, column, columns, j->ridge, b, NULL);
    for (int i = 0; i < GROUPS; i++)
      left[i] += lsq_left(g->by_group[i] + (size_t)h * n, g->size, column, columns, b);
  }
}

bool score_harms(const score_t *j, const choice_t *without, const choice_t *with) {
  double before[GROUPS], after[GROUPS];
  left_by_group(j, without, before);
  left_by_group(j, with, after);
  const double by_chance = -2.0 * log(SELECT_ALPHA); // a likelihood so small, in squares
  double taken = 0.0;
  for (int i = 0; i < GROUPS; i++) taken += fmax(before[i] - after[i], 0.0);
  for (int i = 0; i < GROUPS; i++)
    if (after[i] > before[i] + HARM * (before[i] + taken) + by_chance) return true;
  return false;
}

double score_fitted(const score_t *j, const choice_t *choice) {
  int column[COLUMN_MAX];
  double b[COLUMN_MAX];
  const int n = choice_columns(j->c, choice, column);
  return lsq_solve_products(j->g->total, j->g->size, column, n, NULL, b, NULL);
}

bool score_is_sure(const score_t *j, const choice_t *worse, const choice_t *better) {
  const int n = j->g->n_half;
  double *const a = calloc(2 * (size_t)n + 1, sizeof(double)), sum = 0.0, squares = 0.0;
  if (!a) return false;
  score_left(j, worse, a);
  score_left(j, better, a + n);
  for (int h = 0; h < n; h++) {
    const double less = a[h] - a[n + h];
    sum += less;
    squares += less * less;
  }
  free(a);
  return sum > SELECT_SURE * sqrt(squares);
}

// Returns the square of a weighted sum of columns.
static double squared(const double *G, int size, int n, const int *column, const double *b) {
  double sum = 0.0;
  for (int i = 0; i < n; i++)
    for (int k = 0; k < n; k++) sum += b[i] * b[k] * G[column[i] * size + column[k]];
  return fmax(sum, 0.0);
}

// Returns what is left of nominal flights along a weighted sum of columns, white, in standard errors (rms
// over the flights): 1 where that is noise alone.
static double made_along(const score_t *j, int n, const int *column, const double *b) {
  const int flights = j->nominal ? j->nominal->n : 0, size = j->g->size;
  double sum = 0.0;
  for (int f = 0; f < flights; f++) {
    const double *const G = j->nominal->total + (size_t)f * (size_t)(size * size);
    const double along = squared(G, size, n, column, b);
    double left = 0.0;
    for (int i = 0; i < n; i++) left += b[i] * G[column[i] * size + size - 1];
    sum += along > 0.0 ? left * left / along / flights : 0.0;
  }
  return sqrt(sum);
}

// The sums of squares that the two choices leave differ by D, their white fits by d. If the better choice is
// true, D is d^2 with a standard error of 2 d, or of 2 d times what nominal flights have along the
// difference, if feedback makes more than noise. Anything else in the rows, of norm u, moves D by 2 u d at
// most.
bool score_is_rival(const score_t *j, const choice_t *own, const choice_t *other, double unexplained) {
  const gram_t *g = j->g;
  int column[2 * COLUMN_MAX];
  double b[2 * COLUMN_MAX];
  const int n = choice_columns(j->c, own, column), m = choice_columns(j->c, other, column + n);
  const double left = lsq_solve_products(g->total, g->size, column, n, j->ridge, b, NULL);
  const double left_other = lsq_solve_products(g->total, g->size, column + n, m, j->ridge, b + n, NULL);
  for (int i = n; i < n + m; i++) b[i] = -b[i];
  const double apart = sqrt(squared(g->total, g->size, n + m, column, b));
  const double errors = fmax(SCORE_CLUSTER, made_along(j, n + m, column, b));
  return left_other - left < 2.0 * (SCORE_ERRORS * errors + unexplained) * apart;
}

// Estimates size k of the last candidate of a choice in each nominal flight, and the information that the
// flight holds about it. Returns the number of flights.
static int nominal_values(const score_t *j, const choice_t *choice,
                          double value[FX_SIZE_MAX][NOMINAL_FLIGHTS],
                          double holds[FX_SIZE_MAX][NOMINAL_FLIGHTS]) {
  int column[COLUMN_MAX];
  double b[COLUMN_MAX], inverse[COLUMN_MAX * COLUMN_MAX];
  const int n = choice_columns(j->c, choice, column), own = j->c->candidate[choice->of[choice->n - 1]].n;
  const int flights = j->nominal ? j->nominal->n : 0;
  for (int i = 0; i < flights; i++) {
    const size_t at = (size_t)i * (size_t)(j->nominal->size * j->nominal->size);
    lsq_solve_products(j->nominal->total + at, j->nominal->size, column, n, j->ridge, b, inverse);
    for (int k = 0; k < own; k++) value[k][i] = b[n - own + k];
    for (int k = 0; k < own; k++) holds[k][i] = 1.0 / inverse[(n - own + k) * (n + 1)];
  }
  return flights;
}

double score_rms(const double *value, const double *holds, int n) {
  double sum = 0.0, all = 0.0;
  for (int i = 0; i < n; i++) {
    const double weight = holds ? holds[i] : 1.0;
    sum += weight * value[i] * value[i];
    all += weight;
  }
  return all > 0.0 ? sqrt(sum / all) : 0.0;
}

// Returns what feedback is taken to make of size k where no nominal flight could be flown; 0 in a first
// look.
static double taken_to_be(const score_t *j, const candidate_t *c, int k) {
  return j->nominal ? SELECT_LEAST * c->typical[k] : 0.0;
}

static void nominal_rms(const score_t *j, const choice_t *choice, bool alike, double rms[FX_SIZE_MAX]) {
  const candidate_t *const own = &j->c->candidate[choice->of[choice->n - 1]];
  double value[FX_SIZE_MAX][NOMINAL_FLIGHTS], holds[FX_SIZE_MAX][NOMINAL_FLIGHTS];
  const int flights = nominal_values(j, choice, value, holds);
  for (int k = 0; k < own->n; k++)
    rms[k] = flights ? score_rms(value[k], alike ? NULL : holds[k], flights) : taken_to_be(j, own, k);
}

void score_nominal_error(const score_t *j, const choice_t *choice, double rms[FX_SIZE_MAX]) {
  nominal_rms(j, choice, false, rms);
}

void score_nominal_rms(const score_t *j, const choice_t *choice, double rms[FX_SIZE_MAX]) {
  nominal_rms(j, choice, true, rms);
}

void score_made(const candidate_t *c, int k, double *value, int flights) {
  double mean = 0.0;
  for (int i = 0; i < flights; i++) mean += value[i] / flights;
  for (int i = 0; i < flights && c->least[k] >= 0.0; i++) value[i] -= fmin(mean, 0.0);
}

// Leaves of what nominal flights make of size k, and of its number of flights, those that would show a size
// like this: one that hardly comes near a surface errs by more than the log can. Where fewer than half would,
// all stay.
static int that_would_show(double size, const double *holds, double *value, int flights) {
  int n = 0, would = 0;
  for (int i = 0; i < flights; i++) would += size * size * holds[i] > SCORE_ERRORS * SCORE_ERRORS;
  for (int i = 0; i < flights; i++)
    if (2 * would < flights || size * size * holds[i] > SCORE_ERRORS * SCORE_ERRORS) value[n++] = value[i];
  return n;
}

// Returns the last candidate's sizes over the bound of what feedback makes that could be taken for them, rms
// of those that are shown.
static double over_nominal(const score_t *j, const choice_t *choice, const double size[FX_SIZE_MAX]) {
  const candidate_t *const own = &j->c->candidate[choice->of[choice->n - 1]];
  double value[FX_SIZE_MAX][NOMINAL_FLIGHTS], holds[FX_SIZE_MAX][NOMINAL_FLIGHTS], sum = 0.0;
  const int flights = nominal_values(j, choice, value, holds);
  int shown = 0;
  for (int k = 0; k < own->n; k++) {
    if (!gram_shows(j->g, own->first + k)) continue;
    const int n = that_would_show(size[k], holds[k], value[k], flights);
    score_made(own, k, value[k], n);
    const double made = limits_nominal(n) * (n ? score_rms(value[k], NULL, n) : taken_to_be(j, own, k));
    sum += made > 0.0 ? size[k] * size[k] / (made * made) : 1e12;
    shown++;
  }
  return sqrt(sum / shown);
}

verdict_t score_last(const score_t *j, const choice_t *choice) {
  verdict_t v = {.p = 1.0};
  double b[COLUMN_MAX], V[COLUMN_MAX * COLUMN_MAX], value[FX_SIZE_MAX], own[FX_SIZE_MAX * FX_SIZE_MAX];
  const candidate_t *const c = &j->c->candidate[choice->of[choice->n - 1]];
  int column[COLUMN_MAX], at[FX_SIZE_MAX], shown = 0;
  const int n = choice_columns(j->c, choice, column);
  for (int k = 0; k < c->n; k++)
    if (gram_shows(j->g, c->first + k)) at[shown++] = n - c->n + k;
  if (!shown) return v;
  score_estimate(j, choice, b, V);
  for (int i = 0; i < shown; i++) {
    const int k = at[i] - (n - c->n);
    value[i] = v.value[k] = b[at[i]];
    v.stderr_[k] = sqrt(V[at[i] * (n + 1)]);
    for (int other = 0; other < shown; other++) own[i * shown + other] = V[at[i] * n + at[other]];
  }
  const double blocks = fmax(j->g->n_block - n, 2.0);
  v.p = lsq_f_above(lsq_wald(value, own, shown) / shown, shown, blocks);
  v.over_nominal = over_nominal(j, choice, v.value);
  return v;
}

// True if the effect can have this value, or one within `margin` of it, as size k of the candidate.
static bool can_be(const candidate_t *c, int k, double value, double margin) {
  const fx_size_t *size = &c->use.fx->size[k];
  int n;
  const fx_param_t *param = &fx_use_params(&c->use, &n)[size->param];
  const double least = c->least[k];
  return value - margin <= param->max && (size->sign > 0 ? value + margin > least : value + margin >= least);
}

bool score_is_possible(const score_t *j, const choice_t *choice) {
  const candidate_t *c = &j->c->candidate[choice->of[choice->n - 1]];
  const verdict_t v = score_last(j, choice);
  for (int k = 0; k < c->n; k++)
    if (!can_be(c, k, v.value[k], SCORE_ERRORS * v.stderr_[k])) return false;
  return true;
}

bool score_allows(const score_t *j, const choice_t *choice, const verdict_t *v) {
  const candidate_t *c = &j->c->candidate[choice->of[choice->n - 1]];
  double largest = 0.0; // in parts of what is typical
  for (int k = 0; k < c->n; k++) {
    if (!can_be(c, k, v->value[k], score_margin(c, v->stderr_[k]))) return false;
    largest = fmax(largest, fabs(v->value[k]) / c->typical[k]);
  }
  return largest > SELECT_LEAST && v->p * j->c->n < SELECT_ALPHA && v->over_nominal > 1.0;
}

// --- could one effect stand for another, and how large must it be to be seen? -----------------------------

// Returns the part, 0 to 1, that all m other columns can give of a weighted sum of own columns, after taking
// out what the first `beside` of them can give.
static double part_given(const gram_t *g, int n, const int *own, const double *number, int m,
                         const int *other, int beside) {
  double G[(COLUMN_MAX + 1) * (COLUMN_MAX + 1)] = {0.0}, at[COLUMN_MAX];
  int order[COLUMN_MAX];
  const int size = m + 1;
  for (int i = 0; i < n; i++) {
    const double *const row = g->total + own[i] * g->size;
    for (int k = 0; k < m; k++) G[k * size + m] += number[i] * row[other[k]];
  }
  G[size * size - 1] = squared(g->total, g->size, n, own, number);
  for (int i = 0; i < m; i++) {
    order[i] = i;
    G[m * size + i] = G[i * size + m];
    for (int k = 0; k < m; k++) G[i * size + k] = g->total[other[i] * g->size + other[k]];
  }
  const double all = lsq_solve_products(G, size, order, beside, NULL, at, NULL);
  return all > 0.0 ? 1.0 - lsq_solve_products(G, size, order, m, NULL, at, NULL) / all : 0.0;
}

double score_likeness(const score_t *j, const choice_t *choice, int own, const choice_t *with) {
  int column[COLUMN_MAX] = {0}, other[COLUMN_MAX], first = 0;
  double b[COLUMN_MAX];
  const int n = choice_columns(j->c, choice, column), m = choice_columns(j->c, with, other);
  lsq_solve_products(j->g->total, j->g->size, column, n, NULL, b, NULL);
  while (first < n && column[first] != j->c->candidate[own].first) first++;
  if (first == n) return 0.0; // `own` is not in the choice
  return part_given(j->g, j->c->candidate[own].n, column + first, b + first, m, other,
                    m - j->c->candidate[with->of[with->n - 1]].n);
}

double score_alike(const score_t *j, int column, int candidate) {
  const double one = 1.0;
  const choice_t nothing = {.n = 0}, alone = choice_with(&nothing, candidate);
  int other[COLUMN_MAX];
  const int m = choice_columns(j->c, &alone, other);
  return part_given(j->g, 1, &column, &one, m, other, 0);
}

// A number b takes b^2 / (A^-1)_kk from the sum of squares.
void score_least_gain(const score_t *j, const choice_t *choice, double gain, double size[FX_SIZE_MAX]) {
  int column[COLUMN_MAX];
  double b[COLUMN_MAX], inverse[COLUMN_MAX * COLUMN_MAX];
  const int n = choice_columns(j->c, choice, column), own = j->c->candidate[choice->of[choice->n - 1]].n;
  lsq_solve_products(j->g->total, j->g->size, column, n, NULL, b, inverse);
  for (int k = 0; k < own; k++) {
    const double v = inverse[(n - own + k) * (n + 1)];
    size[k] = isfinite(v) && v > 0.0 ? sqrt(gain * v) : HUGE_VAL;
  }
}
