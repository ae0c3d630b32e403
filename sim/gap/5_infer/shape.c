// shape.c - refines the shapes of named effects between the values tried.
#include "gap/5_infer/shape.h"

#include "base/lsq_blocks.h"
#include "gap/2_predict/lines.h"
#include <math.h>
#include <nlopt.h>
#include <string.h>

enum { SHAPE, SIZE, MOST = SIZE + FX_SIZE_MAX }; // the variables, over what is typical of each: shape, sizes

typedef struct {
  chosen_t *chosen;
  fx_use_t *use; // among the chosen
  const candidate_t *own;
  set_t *s;
  const model_t *base;
  color_t color[CHANNELS];
  int n;
  double unit[MOST], low[MOST], high[MOST];
  bool failed;
  why_t why;
} polish_t;

static double *number(polish_t *p, int i) {
  const fx_t *const fx = p->use->fx;
  return &p->use->p[i == SHAPE ? fx->shape_param : fx->size[i - SIZE].param];
}

// Returns the white sum of squares that this shape and these sizes leave.
static double left_with(unsigned n, const double *x, double *gradient, void *data) {
  polish_t *const p = data;
  model_t m;
  double left = HUGE_VAL;
  (void)n;
  (void)gradient;
  for (int i = 0; i < p->n; i++) *number(p, i) = x[i] * p->unit[i];
  if (chosen_model(p->chosen, p->base, &m, &p->why) != DONE ||
      whiten_left(p->s, &m, p->color, &left, &p->why) != DONE)
    p->failed = true;
  return left;
}

// Bounds the shape by its neighbours, which fitted less well; at an end of the list by the same ratio again.
static void take_bounds(polish_t *p) {
  const fx_t *const fx = p->own->use.fx;
  int n, at = 0;
  const fx_param_t *const param = fx_use_params(&p->own->use, &n);
  const double *const shape = p->own->shape;
  const int end = p->own->n_shape - 1;
  while (at < end && shape[at] < *number(p, SHAPE)) at++;
  const double here = shape[at];
  const double below = at > 0 ? shape[at - 1] : shape[0] * shape[0] / shape[1];
  const double above = at < end ? shape[at + 1] : shape[end] * shape[end] / shape[end - 1];
  p->unit[SHAPE] = here;
  p->low[SHAPE] = fmax(below, param[fx->shape_param].min) / here;
  p->high[SHAPE] = fmin(above, param[fx->shape_param].max) / here;
  for (int k = 0; k < fx->n_size; k++) {
    const fx_size_t *const size = &fx->size[k];
    double *const unit = &p->unit[SIZE + k];
    *unit = p->own->typical[k];
    p->low[SIZE + k] = fmax(size->sign > 0 ? 0.0 : -HUGE_VAL, param[size->param].min) / *unit;
    p->high[SIZE + k] = param[size->param].max / *unit;
  }
}

static done_t take_colors(polish_t *p, why_t *why) {
  model_t m;
  lines_t l = {.r = {NULL}};
  TRY(chosen_model(p->chosen, p->base, &m, why));
  done_t status = lines_make(&l, p->s, why);
  if (status == DONE) status = residual_of(p->s, &m, l.r, why);
  for (int ch = 0; ch < CHANNELS && status == DONE; ch++)
    p->color[ch] = residual_has(p->s, ch) ? color_fit(set_rows(p->s, ch), l.r[ch]) : (color_t){.used = false};
  lines_free(&l);
  return status;
}

static done_t minimise(polish_t *p, double x[MOST], why_t *why) {
  double least, start[MOST], step[MOST], enough[MOST];
  for (int i = 0; i < p->n; i++) {
    start[i] = x[i];
    enough[i] = 1e-4;
    step[i] = fmin(0.1, 0.25 * (p->high[i] - p->low[i])); // the bounds of a voltage are narrow
  }
  const double before = left_with((unsigned)p->n, start, NULL, p);
  nlopt_opt opt = nlopt_create(NLOPT_LN_BOBYQA, (unsigned)p->n);
  if (!opt) return error_failed(why, "out of memory");
  nlopt_set_min_objective(opt, left_with, p);
  nlopt_set_lower_bounds(opt, p->low);
  nlopt_set_upper_bounds(opt, p->high);
  nlopt_set_initial_step(opt, step);
  nlopt_set_xtol_abs(opt, enough);
  const nlopt_result result = nlopt_optimize(opt, x, &least);
  nlopt_destroy(opt);
  if ((result < 0 && result != NLOPT_ROUNDOFF_LIMITED) || !(least < before)) memcpy(x, start, sizeof start);
  return DONE;
}

// Returns half of the second derivative over variables i and k, by steps far below what white rows tell
// apart.
static double curvature(polish_t *p, const double x[MOST], int i, int k) {
  const double h = 0.02;
  double sum = 0.0;
  for (int a = -1; a <= 1; a += 2)
    for (int b = -1; b <= 1; b += 2) {
      double at[MOST];
      memcpy(at, x, sizeof at);
      at[i] += a * (i == k ? 0.5 * h : h), at[k] += b * (i == k ? 0.5 * h : h);
      sum += a * b * left_with((unsigned)p->n, at, NULL, p);
    }
  return i == k ? sum / (2.0 * h * h) : sum / (8.0 * h * h);
}

static void take_errors(polish_t *p, const double x[MOST], named_t *named) {
  double G[(MOST + 1) * (MOST + 1)] = {0.0}, b[MOST], inverse[MOST * MOST];
  const int n = p->n, size = n + 1, column[MOST] = {0, 1, 2, 3};
  named->shape_stderr = (double)NAN;
  for (int i = 0; i < n; i++)
    if (!(x[i] - 0.02 > p->low[i] && x[i] + 0.02 < p->high[i])) return;
  for (int i = 0; i < n; i++)
    for (int k = 0; k < n; k++) G[i * size + k] = curvature(p, x, i, k);
  lsq_solve_products(G, size, column, n, NULL, b, inverse);
  for (int i = 0; i < n; i++)
    if (!(G[i * (size + 1)] > 0.0) || !(inverse[i * (n + 1)] > 0.0)) return;
  double robust = 0.0; // largest ratio of a size's robust error to that by its curvature alone
  for (int k = 0; k < n - SIZE; k++) {
    const int i = SIZE + k;
    const double squares = named->stderr_[k] * named->stderr_[k] - named->beside[k] * named->beside[k];
    const double own = sqrt(fmax(squares, 0.0) * G[i * (size + 1)]) / p->unit[i];
    named->stderr_[k] = hypot(own * p->unit[i] * sqrt(inverse[i * (n + 1)]), named->beside[k]);
    robust = fmax(robust, own);
  }
  named->shape_stderr =
      hypot(robust * p->unit[SHAPE] * sqrt(inverse[0]), x[SHAPE] * p->unit[SHAPE] * named->shape_beside);
}

static done_t polish(polish_t *p, named_t *named, why_t *why) {
  take_bounds(p);
  TRY(take_colors(p, why));
  double x[MOST] = {0.0};
  for (int i = 0; i < p->n; i++) x[i] = fmin(fmax(*number(p, i) / p->unit[i], p->low[i]), p->high[i]);
  TRY(minimise(p, x, why));
  take_errors(p, x, named);
  (void)left_with((unsigned)p->n, x, NULL, p);
  for (int k = 0; k < p->n - SIZE; k++) named->value[k] = *number(p, SIZE + k);
  return p->failed ? error_failed(why, "%s", p->why.text) : DONE;
}

static bool has_shape(const candidate_t *c) {
  return !c->in_file && c->n_shape >= 2 && !candidate_is_numbered(c);
}

done_t shapes_refine(const candidates_t *c, set_t *s, const model_t *base, found_t *found, why_t *why) {
  for (int i = 0; i < found->n; i++) {
    const candidate_t *const own = &c->candidate[found->named[i].candidate];
    polish_t p = {.chosen = &found->chosen, .own = own, .s = s, .base = base, .n = SIZE + own->n};
    if (!has_shape(own)) continue;
    p.use = chosen_take(&found->chosen, c, found->named[i].candidate);
    TRY(polish(&p, &found->named[i], why));
  }
  return DONE;
}
