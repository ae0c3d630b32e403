// smooth.c - smooths short-lived errors out of positions and velocities.
#include "gap/2_predict/grid.h"

#include "base/lsq_blocks.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Half-width of the window. It reduces errors that last for 30 to 60 ms to 0.35 to 0.45 of their size, half
// of it only to 0.46 to 0.6. With twice as much the velocity's own errors begin to move the position (by 3
// mm, for 0.03 m/s). Test of both: gap_takes_errors_of_a_moment_out_of_places.
#define SMOOTH_S 0.25

// Integrates the velocity from the first point on, over n points that follow each other.
static void add_up(const grid_point_t *p, int n, d3_t *sum) {
  sum[0] = d3(0.0, 0.0, 0.0);
  for (int j = 1; j < n; j++) {
    const double half_s = 0.5 * (p[j].t_s - p[j - 1].t_s);
    sum[j] = d3_add(sum[j - 1], d3_scale(half_s, d3_add(p[j - 1].vel_w_mps, p[j].vel_w_mps)));
  }
}

// Returns the mean of off about point j. off[0..n-1]: the position less the integral of the velocity. As many
// points before as after count, so that a constant error of the velocity does no harm.
static d3_t middle(const d3_t *off, int n, int j, int reach) {
  const int side = j < reach || n - 1 - j < reach ? (j < n - 1 - j ? j : n - 1 - j) : reach;
  d3_t sum = {0.0, 0.0, 0.0};
  for (int i = j - side; i <= j + side; i++) sum = d3_add(sum, off[i]);
  return d3_scale(1.0 / (2 * side + 1), sum);
}

// Smooths the positions of n points; room: twice as many.
static void smooth(grid_point_t *p, int n, int reach, d3_t *room) {
  d3_t *const off = room + n;
  add_up(p, n, room);
  for (int j = 0; j < n; j++) off[j] = d3_sub(p[j].seen_w_m, room[j]);
  for (int j = 0; j < n; j++) p[j].pos_w_m = d3_add(room[j], middle(off, n, j, reach));
}

// Returns the end (exclusive) of the run of points from `from` on, of one segment and alike in `ok`.
static int run_end(const grid_t *g, int from) {
  const grid_point_t *const p = &g->point[from];
  int to = from + 1;
  while (to < g->n && g->point[to].segment == p->segment && g->point[to].ok == p->ok) to++;
  return to;
}

// --- velocities -------------------------------------------------------------------------------------------
//
// Logged is x = v + u, a velocity and its error. The estimate is nearest to v in the mean square (Wiener) and
// leaves constants and slopes as they are:
//
//   v^ = x(0) + sum over k of g_k s_k(x),   s_k(x) = x(k) + x(-k) - 2 x(0)
//   (E s(v) s(v)' + E s(u) s(u)') g = d,    d_k = -E u(0) s_k(u) = E (u(k) - u(0))^2
//
// where u is stationary and uncorrelated with v. The integral of the accelerations gives s(v), and x less
// that integral gives s(u): both are free of slopes, such as a constant error of an acceleration makes. They
// give d, too: E s_k(u)^2 = 4 d_k - d_2k, and d_2k is d_k where u is no longer correlated. The accelerations
// themselves do not enter the estimate: they would bring the forces' residual into it, and a climb would seem
// to need an inflow.
//
// If an effect is multiplied by a velocity that is mostly error, least squares find only a part of it, and
// take the rest for noise: in a hover, a twentieth of the flapping was found (test:
// large_flapping_is_named_in_a_hover_and_its_size_is_right).

// Relative error of s(v), squared: the integral of the accelerations is known to 3 %, because of their scale
// and of the integration. Without it, a flight without errors is smoothed by the rounding of its numbers.
// Test: gap_takes_as_much_of_a_moment_out_of_velocities_as_their_errors_ask_for.
#define SCALE_ERROR 1e-3

// Points on each side: SMOOTH_S of more than 10 ms each.
enum { REACH_MOST = 26 };

typedef struct {
  int reach, windows;
  double G[(REACH_MOST + 1) * (REACH_MOST + 1)], squares[REACH_MOST]; // sums of products; squares of s(u)
} changes_t;

// way: integral of the accelerations from the first of n points on; off: the velocity less that. Axis by
// axis, `all` numbers each.
static void tell_apart(const grid_point_t *p, int n, int all, double *way, double *off) {
  d3_t sum = {0.0, 0.0, 0.0}, before = sum;
  for (int j = 0; j < n; j++) {
    const d3_t now = grid_acc_w_mps2(&p[j]);
    if (j) sum = d3_add(sum, d3_scale(0.5 * (p[j].t_s - p[j - 1].t_s), d3_add(before, now)));
    before = now;
    double v[3], x[3];
    d3_put(v, sum);
    d3_put(x, p[j].seen_w_mps);
    for (int axis = 0; axis < 3; axis++) {
      way[axis * all + j] = v[axis];
      off[axis * all + j] = x[axis] - v[axis];
    }
  }
}

// Adds the products of a window; v, u: at its middle.
static void add_window(changes_t *c, const double *v, const double *u) {
  double of_v[REACH_MOST], of_u[REACH_MOST];
  const int n = c->reach;
  for (int k = 0; k < n; k++) {
    of_v[k] = v[k + 1] + v[-k - 1] - 2.0 * v[0];
    of_u[k] = u[k + 1] + u[-k - 1] - 2.0 * u[0];
    c->squares[k] += of_u[k] * of_u[k];
    for (int i = 0; i <= k; i++) c->G[k * (n + 1) + i] += of_v[k] * of_v[i] + of_u[k] * of_u[i];
  }
  c->windows++;
}

// The weights g, by axis.
typedef struct {
  double of[3][REACH_MOST];
} weights_t;

// Finds the weights g. False: the flight is too short.
static bool weights_of(changes_t *c, double g[REACH_MOST]) {
  const int n = c->reach;
  int order[REACH_MOST];
  for (int k = n - 1; k >= 0; k--) {
    const int twice = 2 * k + 1; // of k + 1
    double *const d = &c->G[k * (n + 1) + n];
    *d = twice < n ? (c->squares[k] + c->G[twice * (n + 1) + n]) / 4.0 : c->squares[k] / 3.0;
    for (int i = 0; i < k; i++) c->G[i * (n + 1) + k] = c->G[k * (n + 1) + i];
    c->G[k * (n + 2)] *= 1.0 + SCALE_ERROR;
    order[k] = k;
  }
  if (c->windows <= 2 * n) return false;
  lsq_solve_products(c->G, n + 1, order, n, NULL, g, NULL);
  return true;
}

// Returns the smoothed velocity. Near the end of a run, both sides have as many points as the shorter one.
static d3_t weighted(const grid_point_t *p, int n, int j, int reach, const weights_t *g) {
  const d3_t here = p[j].seen_w_mps;
  double v[3];
  d3_put(v, here);
  for (int k = 1; k <= reach && k <= j && k < n - j; k++) {
    double s[3];
    d3_put(s, d3_sub(d3_add(p[j + k].seen_w_mps, p[j - k].seen_w_mps), d3_scale(2.0, here)));
    for (int axis = 0; axis < 3; axis++) v[axis] += g->of[axis][k - 1] * s[axis];
  }
  return d3_of(v);
}

// Smooths all velocities; room: six numbers a point.
static void smooth_velocities(grid_t *grid, int reach, double *room) {
  changes_t c[3];
  weights_t g = {.of = {{0.0}}};
  const int all = grid->n;
  memset(c, 0, sizeof c);
  for (int axis = 0; axis < 3; axis++) c[axis].reach = reach < REACH_MOST ? reach : REACH_MOST;
  for (int from = 0, to; from < all; from = to) {
    double *const way = room + from, *const off = room + 3 * all + from;
    to = run_end(grid, from);
    if (!grid->point[from].ok) continue;
    tell_apart(&grid->point[from], to - from, all, way, off);
    for (int axis = 0; axis < 3; axis++)
      for (int j = c->reach; j + c->reach < to - from; j++)
        add_window(&c[axis], way + axis * all + j, off + axis * all + j);
  }
  for (int axis = 0; axis < 3; axis++)
    if (!weights_of(&c[axis], g.of[axis])) return;
  for (int from = 0, to; from < all; from = to) {
    grid_point_t *const p = &grid->point[from];
    to = run_end(grid, from);
    for (int j = 0; p->ok && j < to - from; j++) p[j].vel_w_mps = weighted(p, to - from, j, c->reach, &g);
  }
}

// --- both -------------------------------------------------------------------------------------------------

// A velocity that was differentiated from positions says nothing new about them: nothing is smoothed.
done_t grid_smooth(grid_t *g, why_t *why) {
  const int reach = (int)round(SMOOTH_S / g->period_s);
  if (!g->has_position || !g->has_velocity || g->velocity_made) return DONE;
  d3_t *const room = malloc((2 * (size_t)g->n + 1) * sizeof(d3_t));
  if (!room) return error_failed(why, "out of memory");
  for (int from = 0, to; from < g->n; from = to) {
    to = run_end(g, from);
    if (g->point[from].ok) smooth(&g->point[from], to - from, reach, room);
  }
  if (g->has_force && !g->acceleration_made && g->has_attitude) smooth_velocities(g, reach, &room->x);
  free(room);
  return DONE;
}
