// slow_errors.c - errors of the estimates that last for a while, found by comparing each estimate with its
// rate.
//
// Over k points an estimate x with rate r misses e_k = x(k) - x(0) - sum r dt, the change of its error. For a
// first-order error var e_k = 2 sd^2 (1 - rho^k): two spans tell sd and rho.
#include "gap/3_feedback/slow_errors.h"

#include <math.h>

#define LONG           5    // points of the longer span
#define SPANS_MIN      50   // of each length, to tell their spread
#define POS_MOST_M     0.02 // more is no error of an estimate but motion that its rate lacks
#define VEL_MOST_MPS   0.1
#define ANGLE_MOST_RAD 0.02

typedef struct {
  double sum[2][3]; // sums of squares over 1 and over LONG points, by axis
  int n;
} spans_t;

static void spans_add(spans_t *s, d3_t one, d3_t more) {
  const double miss[2][3] = {{one.x, one.y, one.z}, {more.x, more.y, more.z}};
  for (int i = 0; i < 2; i++)
    for (int k = 0; k < 3; k++) s->sum[i][k] += miss[i][k] * miss[i][k];
  s->n++;
}

// one, more: mean squares over the short and the long span.
static void solve(double one, double more, double period_s, double most, double *sd, double *tau_s) {
  const double ratio = more > 0.0 ? one / more : 1.0;
  double low = 0.0, high = 0.98;
  for (int i = 0; i < 30; i++) {
    const double rho = 0.5 * (low + high);
    if ((1.0 - rho) / (1.0 - pow(rho, LONG)) > ratio)
      low = rho;
    else
      high = rho;
  }
  *sd = fmin(sqrt(0.5 * more / (1.0 - pow(low, LONG))), most);
  *tau_s = -period_s / log(fmax(low, 1e-3));
}

static slow_t solve_axes(const spans_t *s, const grid_t *g, const double white[3], double most) {
  slow_t slow = {{0.0}, {0.0}};
  for (int k = 0; s->n >= SPANS_MIN && k < 3; k++) {
    const double own = 2.0 * white[k] * white[k];
    const double one = s->sum[0][k] / s->n - own, more = s->sum[1][k] / s->n - own;
    if (one > 0.0 && more > 0.0) solve(one, more, g->period_s, most, &slow.sd[k], &slow.tau_s[k]);
  }
  return slow;
}

static d3_t up_b(const grid_point_t *p) {
  const axes_t a = axes_of(p->q_wb);
  return axes_up_b(&a);
}

static d3_t up_rate(const grid_point_t *p) {
  return d3_cross(up_b(p), p->rate_b_radps);
}

static d3_t position(const grid_point_t *p) {
  return p->seen_w_m;
}
static d3_t velocity(const grid_point_t *p) {
  return p->seen_w_mps;
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

static spans_t misses(const grid_t *g, look_t value, look_t rate) {
  spans_t s = {.n = 0};
  for (int j = 0; j + LONG < g->n; j++)
    if (together(g->point + j))
      spans_add(&s, miss(g->point + j, 1, g->period_s, value, rate),
                miss(g->point + j, LONG, g->period_s, value, rate));
  return s;
}

// `up` has length 1, so its error lies along two axes, not three: each axis gets half the sum of all three.
static spans_t of_two_axes(spans_t s) {
  for (int i = 0; i < 2; i++) {
    const double mean = 0.5 * (s.sum[i][0] + s.sum[i][1] + s.sum[i][2]);
    for (int k = 0; k < 3; k++) s.sum[i][k] = mean;
  }
  return s;
}

void slow_errors(const grid_t *g, const white_error_t *white, slow_t *pos_m, slow_t *vel_mps,
                 slow_t *angle_rad) {
  spans_t s = {.n = 0};
  const bool own = g->has_velocity && !g->velocity_made; // else it shows no errors of the place
  if (g->has_position && own) s = misses(g, position, velocity);
  *pos_m = solve_axes(&s, g, white->pos_m, POS_MOST_M);
  s.n = 0;
  if (own && g->has_force && !g->acceleration_made && g->has_attitude)
    s = misses(g, velocity, grid_acc_w_mps2);
  *vel_mps = solve_axes(&s, g, white->vel_mps, VEL_MOST_MPS);
  s.n = 0;
  if (g->has_attitude && g->has_rates) s = of_two_axes(misses(g, up_b, up_rate));
  *angle_rad = solve_axes(&s, g, white->angle_rad, ANGLE_MOST_RAD);
}
