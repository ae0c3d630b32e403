// select_shape.c - the shapes of what is named, between the values that were tried.
#include "gap/select_shape.h"

#include "gap/7_verify.h"
#include "gap/lines.h"
#include <math.h>
#include <nlopt.h>

enum { SHAPE, SIZE, BOTH }; // the variables, over what is typical of each

typedef struct {
  const candidates_t *c;
  candidate_t *own;
  set_t *s;
  const model_t *base;
  color_t color[CHANNELS];
  double unit[BOTH], low[BOTH], high[BOTH];
  bool failed;
  why_t why;
} polish_t;

static double *number(polish_t *p, int i) {
  const fx_t *const fx = p->own->use.fx;
  return &p->own->use.p[i == SHAPE ? fx->shape_param : fx->size[0].param];
}

// The white sum of squares that shape and size leave.
static double left_with(unsigned n, const double *x, double *gradient, void *data) {
  polish_t *const p = data;
  model_t m;
  double left = HUGE_VAL;
  (void)n;
  (void)gradient;
  for (int i = 0; i < BOTH; i++) *number(p, i) = x[i] * p->unit[i];
  if (candidates_model(p->c, p->base, &m, &p->why) != ST_OK ||
      verify_left(p->s, &m, p->color, &left, &p->why) != ST_OK)
    p->failed = true;
  return left;
}

// Between its neighbours, which lost; at an end of the list as far again.
static void take_bounds(polish_t *p) {
  const fx_t *const fx = p->own->use.fx;
  int n, at = 0;
  const fx_param_t *const param = fx_use_params(&p->own->use, &n);
  while (at < fx->n_shape - 1 && fx->shape[at] < *number(p, SHAPE)) at++;
  const double here = fx->shape[at];
  double below = 0.0, above = HUGE_VAL;
  if (at > 0) below = fx->shape[at - 1];
  if (at < fx->n_shape - 1) above = fx->shape[at + 1];
  if (at == 0) below = here * here / above;
  if (at == fx->n_shape - 1) above = here * here / below;
  p->unit[SHAPE] = here;
  p->low[SHAPE] = fmax(below, param[fx->shape_param].min) / here;
  p->high[SHAPE] = fmin(above, param[fx->shape_param].max) / here;
  const fx_size_t *const size = &fx->size[0];
  p->unit[SIZE] = candidate_typical(p->own, 0);
  p->low[SIZE] = fmax(size->sign > 0 ? 0.0 : -HUGE_VAL, param[size->param].min) / p->unit[SIZE];
  p->high[SIZE] = param[size->param].max / p->unit[SIZE];
}

static status_t take_colors(polish_t *p, why_t *why) {
  model_t m;
  lines_t l = {.r = {NULL}};
  TRY(candidates_model(p->c, p->base, &m, why));
  status_t status = lines_make(&l, p->s, why);
  if (status == ST_OK) status = residual_of(p->s, &m, l.r, why);
  for (int ch = 0; ch < CHANNELS && status == ST_OK; ch++)
    p->color[ch] = residual_has(p->s, ch) ? color_fit(set_rows(p->s, ch), l.r[ch]) : (color_t){.used = false};
  lines_free(&l);
  return status;
}

static status_t search(polish_t *p, double x[BOTH], why_t *why) {
  static const double step[BOTH] = {0.1, 0.1}, enough[BOTH] = {1e-3, 1e-3};
  double least;
  const double start[BOTH] = {x[SHAPE], x[SIZE]}, before = left_with(BOTH, start, NULL, p);
  nlopt_opt opt = nlopt_create(NLOPT_LN_BOBYQA, BOTH);
  if (!opt) return error_failed(why, "out of memory");
  nlopt_set_min_objective(opt, left_with, p);
  nlopt_set_lower_bounds(opt, p->low);
  nlopt_set_upper_bounds(opt, p->high);
  nlopt_set_initial_step(opt, step);
  nlopt_set_xtol_abs(opt, enough);
  nlopt_set_maxeval(opt, SHAPE_TRIES);
  const nlopt_result result = nlopt_optimize(opt, x, &least);
  nlopt_destroy(opt);
  if ((result < 0 && result != NLOPT_ROUNDOFF_LIMITED) || !(least < before))
    x[SHAPE] = start[SHAPE], x[SIZE] = start[SIZE];
  return ST_OK;
}

// By second differences; both steps are far within what white rows can tell apart.
static void take_errors(polish_t *p, const double x[BOTH], named_t *named) {
  double at[3][3], H[BOTH][BOTH];
  const double h = 0.02;
  named->shape_stderr = (double)NAN;
  for (int i = 0; i < BOTH; i++)
    if (!(x[i] - h > p->low[i] && x[i] + h < p->high[i])) return;
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++)
      at[i][k] = left_with(BOTH, (double[]){x[SHAPE] + (i - 1) * h, x[SIZE] + (k - 1) * h}, NULL, p);
  H[0][0] = (at[2][1] - 2.0 * at[1][1] + at[0][1]) / (2.0 * h * h);
  H[1][1] = (at[1][2] - 2.0 * at[1][1] + at[1][0]) / (2.0 * h * h);
  H[0][1] = (at[2][2] - at[2][0] - at[0][2] + at[0][0]) / (8.0 * h * h);
  const double determinant = H[0][0] * H[1][1] - H[0][1] * H[0][1];
  if (!(H[1][1] > 0.0) || !(determinant > 0.0)) return;
  const double squares = named->stderr_[0] * named->stderr_[0] - named->beside[0] * named->beside[0];
  const double robust = sqrt(fmax(squares, 0.0) * H[1][1]) / p->unit[SIZE];
  named->shape_stderr = robust * p->unit[SHAPE] * sqrt(H[1][1] / determinant);
  named->stderr_[0] = hypot(robust * p->unit[SIZE] * sqrt(H[0][0] / determinant), named->beside[0]);
}

static bool is_free(const fx_t *fx, const candidate_t *c) {
  int n;
  return fx->n_shape > 1 && fx->n_size == 1 && !fx_is_number(&fx_use_params(&c->use, &n)[fx->shape_param]);
}

static status_t polish(polish_t *p, named_t *named, why_t *why) {
  take_bounds(p);
  TRY(take_colors(p, why));
  double x[BOTH];
  for (int i = 0; i < BOTH; i++) x[i] = fmin(fmax(*number(p, i) / p->unit[i], p->low[i]), p->high[i]);
  TRY(search(p, x, why));
  take_errors(p, x, named);
  (void)left_with(BOTH, x, NULL, p);
  named->value[0] = *number(p, SIZE);
  return p->failed ? error_failed(why, "%s", p->why.text) : ST_OK;
}

status_t select_shapes(candidates_t *c, set_t *s, const model_t *base, found_t *found, why_t *why) {
  for (int i = 0; i < found->n; i++) {
    candidate_t *const own = &c->candidate[found->named[i].candidate];
    polish_t p = {.c = c, .own = own, .s = s, .base = base};
    if (is_free(own->use.fx, own)) TRY(polish(&p, &found->named[i], why));
  }
  return ST_OK;
}
