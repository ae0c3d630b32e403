// both_ways.c - measured by predicted, and predicted by measured.
#include "gap/5_infer/both_ways.h"

#include <math.h>

static double mean(const rows_t *r, const double *v) {
  double sum = 0.0;
  int n = 0;
  for (int i = 0; i < r->n; i++) {
    if (!color_reaches(r, i)) continue;
    sum += v[i];
    n++;
  }
  return n ? sum / n : 0.0;
}

// Sums over the rows that have two rows before them.
static both_t sums_of(const rows_t *r, const double *y, const double *p) {
  const double y_mean = mean(r, y), p_mean = mean(r, p);
  both_t s = {.n = 0};
  for (int i = 0; i < r->n; i++) {
    if (!color_reaches(r, i)) continue;
    s.yy += (y[i] - y_mean) * (y[i] - y_mean);
    s.pp += (p[i] - p_mean) * (p[i] - p_mean);
    s.yp += (y[i] - y_mean) * (p[i] - p_mean);
    s.n++;
  }
  return s;
}

typedef struct {
  double from, to, stderr_; // standard error of the lower end
} interval_t;

static interval_t interval_of(const slope_t *s, int n) {
  const double left = fmax(s->pp - s->yp * s->yp / s->yy, 0.0);
  return (interval_t){s->yp / s->yy - 1.0, s->pp / s->yp - 1.0,
                      SCORE_CLUSTER * sqrt(left / s->yy / fmax(n - 2, 1.0))};
}

// True if slow and fast turning may have one scale, up to the least difference that is named. Slow rows count
// as many as whitened ones though they are correlated: a slow disturbance may withdraw a real inertia, but
// with a smaller count one whose scales differ by half would be named.
static bool are_one(const both_t *b, double typical) {
  const slope_t white = {b->yy, b->pp, b->yp};
  if (b->n == 0 || !(b->yp > 0.0 && b->slow.yp > 0.0)) return true;
  const interval_t fast = interval_of(&white, b->n), slow = interval_of(&b->slow, b->n);
  const double margin = SCORE_ERRORS * hypot(fast.stderr_, slow.stderr_) + SELECT_LEAST * typical;
  return fast.from - margin < slow.to && slow.from - margin < fast.to;
}

// The colour is that of what the plain slope leaves, fitted once. Slope and colour in turn may end at another
// slope, of rows in which nothing slow is left, least of all the turning.
both_t both_ways_of(const rows_t *r, const double *measured, const double *residual, double typical,
                    double *left, double *room) {
  for (int i = 0; i < r->n; i++) left[i] = measured[i] - residual[i];
  const both_t plain = sums_of(r, measured, left); // a scale left in the rows would set their colour
  const double slope = plain.yp / plain.yy;
  for (int i = 0; i < r->n; i++) left[i] = (1.0 - slope) * measured[i] - residual[i];
  const double off = mean(r, left);
  for (int i = 0; i < r->n; i++) left[i] -= off;
  const color_t color = color_fit(r, left);
  if (!color.used) return (both_t){.n = 0};
  for (int i = 0; i < r->n; i++) left[i] = measured[i] - residual[i];
  color_whiten(&color, r, left, room);
  color_whiten(&color, r, measured, left);
  both_t white = sums_of(r, left, room);
  white.slow = (slope_t){plain.yy, plain.pp, plain.yp};
  white.apart = !are_one(&white, typical);
  return white;
}

static double reverse(const both_t *b) {
  return b->yp / b->yy - 1.0;
}

// The standard error together with half of the interval.
static double error(const both_t *b, double stderr_) {
  return hypot(stderr_, 0.5 * (b->pp / b->yp - b->yp / b->yy));
}

// The share of the variance of either that the other does not explain, 1 - r^2.
static double unlike(const both_t *b) {
  return 1.0 - b->yp * b->yp / (b->yy * b->pp);
}

// The end of the interval nearer to 0, if it surely is not 0: the lower of a larger k, the upper of a
// smaller.
static double sure_larger(const both_t *b, double stderr_) {
  return reverse(b) > SCORE_ERRORS * error(b, stderr_) ? reverse(b) : 0.0;
}

static double sure_smaller(const both_t *b, double stderr_) {
  const double forward = b->pp / b->yp - 1.0;
  return forward < -SCORE_ERRORS * hypot(stderr_, unlike(b)) ? forward : 0.0;
}

double both_ways_least(const both_t *b) {
  if (!(b->yp > 0.0) || b->apart) return 0.0;
  const double left = fmax(b->pp - b->yp * b->yp / b->yy, 0.0);
  return sure_larger(b, SCORE_CLUSTER * sqrt(left / b->yy / fmax(b->n - 2, 1.0)));
}

double both_ways_agree(const both_t *b, double k, double stderr_) {
  if (!(b->yp > 0.0) || b->apart) return 0.0;
  const double end = k > 0.0 ? sure_larger(b, stderr_) : sure_smaller(b, stderr_);
  const double apart = SCORE_ERRORS * hypot(error(b, stderr_), CANDIDATES_MISFIT * (1.0 + k));
  return fabs(k) > fabs(end) - apart ? end : 0.0;
}

bool both_ways_stand(const both_t about[3], const scaled_t told[3]) {
  bool borne_out = false, one = true;
  for (int axis = 0; axis < 3; axis++) {
    borne_out = borne_out || both_ways_agree(&about[axis], told[axis].k, told[axis].stderr_) != 0.0;
    one = one && !(about[axis].apart && fabs(told[axis].k) > SCORE_ERRORS * told[axis].stderr_);
  }
  return borne_out && one;
}

// Sets about[k], by axis, from what the model with `others` predicts; n is 0 where the axis is not compared.
// typical: size of a scale.
static done_t look(both_t about[3], set_t *s, const model_t *base, const chosen_t *others, double typical,
                   why_t *why) {
  model_t m;
  lines_t measured = {.r = {NULL}}, left = {.r = {NULL}}, room = {.r = {NULL}};
  TRY(chosen_model(others, base, &m, why));
  done_t status = lines_make(&measured, s, why);
  if (status == DONE) status = lines_make(&room, s, why);
  if (status == DONE) status = residual_measured(s, measured.r, why);
  if (status == DONE) status = residual_lines(s, &m, &left, why);
  for (int k = 0; k < 3; k++) {
    const int ch = CH_WX + k;
    about[k] = (both_t){.n = 0};
    if (status == DONE && residual_has(s, ch) && !s->excluded[ch])
      about[k] =
          both_ways_of(set_rows(s, ch), measured.r[ch], left.r[ch], typical, room.r[CH_FX], room.r[CH_FY]);
  }
  lines_free(&measured);
  lines_free(&left);
  lines_free(&room);
  return status;
}

// A torque that is 1 + t times as large acts about z like an inertia that is 1 / (1 + t) times as large.
static scaled_t as_inertia(const fx_t *fx, const named_t *named, int axis) {
  if (fx->scales == FX_SCALES_INERTIA) return (scaled_t){named->value[axis], named->stderr_[axis]};
  const double scale = 1.0 + named->value[0];
  return axis == 2 ? (scaled_t){1.0 / scale - 1.0, named->stderr_[0] / (scale * scale)}
                   : (scaled_t){0.0, 0.0};
}

done_t both_ways(set_t *s, const model_t *base, const chosen_t *chosen, const fx_t *fx, const named_t *named,
                 bool *stands, why_t *why) {
  chosen_t others = *chosen;
  both_t about[3];
  chosen_drop(&others, named->candidate);
  TRY(look(about, s, base, &others, fx->param[fx->size[0].param].nominal, why));
  scaled_t told[3];
  for (int axis = 0; axis < 3; axis++) told[axis] = as_inertia(fx, named, axis);
  *stands = both_ways_stand(about, told);
  return DONE;
}

done_t both_ways_take(chosen_t *chosen, const candidates_t *c, set_t *s, const model_t *base, why_t *why) {
  both_t about[3];
  int which = -1;
  for (int i = 0; i < c->n; i++)
    if (c->candidate[i].use.fx->scales == FX_SCALES_INERTIA && !c->candidate[i].barred) which = i;
  if (which < 0 || chosen_use(chosen, which) || chosen->n >= NAMED_MAX) return DONE;
  TRY(look(about, s, base, chosen, c->candidate[which].typical[0], why));
  double k[3];
  for (int i = 0; i < 3; i++) k[i] = both_ways_least(&about[i]);
  if (k[0] == 0.0 && k[1] == 0.0 && k[2] == 0.0) return DONE;
  fx_use_t *const use = chosen_take(chosen, c, which);
  for (int i = 0; i < 3; i++) fx_use_resize(use, i, candidate_possible(&c->candidate[which], i, k[i]));
  return DONE;
}
