// slow_errors.c - errors of the estimates that last for a while, by comparing each with the rate that it
// should have.
//
// Over k points an estimate x with rate r misses  e_k = x(k) - x(0) - sum r dt  by the change of its error.
// For an error of first order, var e_k = 2 sd^2 (1 - rho^k): two spans tell sd and rho.
#include "gap/3_feedback/slow_errors.h"

#include <math.h>

#define LONG 5 // points of the longer span

typedef struct {
  double sum[2]; // of squares over 1 and over LONG points
  int n;
} spans_t;

// A miss over each span, three axes.
static void spans_add(spans_t *s, d3_t one, d3_t more) {
  const double miss[2] = {d3_dot(one, one), d3_dot(more, more)};
  for (int i = 0; i < 2; i++) s->sum[i] += miss[i] / 3.0;
  s->n++;
}

static slow_t solve(const spans_t *s, double period_s, double most) {
  if (s->n < 50) return (slow_t){0.0, 0.0};
  const double one = s->sum[0] / s->n, more = s->sum[1] / s->n, ratio = more > 0.0 ? one / more : 1.0;
  double low = 0.0, high = 0.98;
  for (int i = 0; i < 30; i++) {
    const double rho = 0.5 * (low + high);
    if ((1.0 - rho) / (1.0 - pow(rho, LONG)) > ratio)
      low = rho;
    else
      high = rho;
  }
  return (slow_t){fmin(sqrt(0.5 * more / (1.0 - pow(low, LONG))), most), -period_s / log(fmax(low, 1e-3))};
}

static d3_t acc_w(const grid_point_t *p) {
  const axes_t a = axes_of(p->q_wb);
  return d3_sub(axes_to_world(&a, p->acc_b_mps2), d3(0.0, 0.0, G_MPS2));
}

static d3_t up_b(const grid_point_t *p) {
  const axes_t a = axes_of(p->q_wb);
  return axes_up_b(&a);
}

static d3_t up_rate(const grid_point_t *p) {
  return d3_cross(up_b(p), p->rate_b_radps);
}

static d3_t position(const grid_point_t *p) {
  return p->pos_w_m;
}
static d3_t velocity(const grid_point_t *p) {
  return p->vel_w_mps;
}

typedef d3_t (*look_t)(const grid_point_t *p);

static d3_t miss(const grid_point_t *p, int k, double period_s, look_t value, look_t rate) {
  d3_t sum = {0.0, 0.0, 0.0};
  for (int i = 0; i < k; i++)
    sum = d3_add(sum, d3_scale(0.5 * period_s, d3_add(rate(p + i), rate(p + i + 1))));
  return d3_sub(d3_sub(value(p + k), value(p)), sum);
}

static bool together(const grid_point_t *p) {
  for (int i = 0; i <= LONG; i++)
    if (!p[i].ok || p[i].segment != p->segment) return false;
  return true;
}

static slow_t error_of(const grid_t *g, look_t value, look_t rate, double most) {
  spans_t s = {.n = 0};
  for (int j = 0; j + LONG < g->n; j++)
    if (together(g->point + j))
      spans_add(&s, miss(g->point + j, 1, g->period_s, value, rate),
                miss(g->point + j, LONG, g->period_s, value, rate));
  return solve(&s, g->period_s, most);
}

void slow_errors(const grid_t *g, slow_t *pos_m, slow_t *vel_mps, slow_t *angle_rad) {
  const slow_t none = {0.0, 0.0};
  const bool turns = g->has_attitude && g->has_rates;
  *pos_m = g->has_position && g->has_velocity ? error_of(g, position, velocity, 0.02) : none;
  *vel_mps = g->has_velocity && g->has_force && g->has_attitude ? error_of(g, velocity, acc_w, 0.1) : none;
  *angle_rad = turns ? error_of(g, up_b, up_rate, 0.02) : none;
  angle_rad->sd *= sqrt(1.5); // the length of `up` cannot be wrong: two axes of three
}
