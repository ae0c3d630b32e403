// holds.c - commands that hold, as a difference of two points sees them.
#include "gap/2_predict/holds.h"

#include <math.h>

// Rows that the slower of both lags takes: at three Simpson's rule errs by 3 % of a turning that jumps from
// row to row, at so many by 1 %, and less than one cannot be seen beside noise (test_gap_holds.c).
#define ROWS_OF_LAG 10.0

bool holds_matter(const grid_t *g, const lag_t *lag) {
  const bool hold = !g->by_speeds && !g->flight->rows_are_means && !grid_is_slow(g);
  return hold && fmax(lag->up_s, lag->down_s) * g->flight->rate_Hz < ROWS_OF_LAG;
}

// Of holds that begin at this sample; the neighbour's beyond the ends.
static double hold_of(const four_t *hold_N, double shift, int rotor, int i, int samples) {
  const double at = fmin(fmax(i - shift, 0.0), samples - 1.0);
  const int low = (int)at, next = low + 1 < samples ? low + 1 : low;
  return hold_N[low][rotor] + (at - low) * (hold_N[next][rotor] - hold_N[low][rotor]);
}

// The mean that a difference of the points beside one sees: each is a mean of samples, so that holds in the
// middle are seen by all pairs of them. first: the sample with which the point before begins.
static double seen(const grid_t *g, const four_t *hold_N, double shift, int rotor, int first) {
  const int every = g->every, holds = 3 * every - 1;
  double sum = 0.0;
  for (int r = 0; r < holds; r++) {
    const int pairs = (int)fmin(fmin(r + 1, every), holds - r);
    sum += pairs * hold_of(hold_N, shift, rotor, first + r, g->samples);
  }
  return sum / (2.0 * every * every);
}

static bool inside(const grid_t *g, int j) {
  const grid_point_t *const p = g->point;
  return j > 0 && j + 1 < g->n && p[j - 1].segment == p[j].segment && p[j + 1].segment == p[j].segment;
}

// (x[j-1] + 4 x[j] + x[j+1]) / 6 = d[j] between the ends of a segment, where x is 0; d becomes x.
static void undo_simpson(const grid_t *g, double *d, double *room) {
  for (int j = 0; j < g->n; j++) {
    const bool in = inside(g, j), before = in && inside(g, j - 1);
    const double pivot = 4.0 - (before ? room[j - 1] : 0.0);
    room[j] = in ? 1.0 / pivot : 0.0;
    d[j] = in ? (6.0 * d[j] - (before ? d[j - 1] : 0.0)) / pivot : 0.0;
  }
  for (int j = g->n - 2; j > 0; j--)
    if (inside(g, j)) d[j] -= room[j] * d[j + 1];
}

void holds_fit(const grid_t *g, const four_t *hold_N, double shift, lagged_t *motors, double *room) {
  for (int k = 0; k < ROTORS; k++) {
    double *const later_N = motors->later_N[k];
    const double *const at = motors->thrust_N[k];
    for (int j = 0, i = 0; j < g->n; j++, i += g->every) {
      i = grid_begins(g, i);
      later_N[j] = 0.0;
      if (!inside(g, j)) continue;
      const double by_instants = (at[j - 1] + 4.0 * at[j] + at[j + 1]) / 6.0;
      later_N[j] = seen(g, hold_N, shift, k, i - g->every) - by_instants;
    }
    undo_simpson(g, later_N, room);
  }
}

void holds_add(const grid_t *g, const rigid_t *r, const lagged_t *motors, double *const out[CHANNELS]) {
  if (!motors->later_N[0]) return;
  for (int k = 0; k < ROTORS; k++) {
    const double scale = r->thrust_scale[k], x = scale * r->rotor_y_m[k] * r->per_inertia.x,
                 y = -scale * r->rotor_x_m[k] * r->per_inertia.y,
                 z = -scale * r->torque_scale[k] * r->spin[k] * r->torque_ratio_m * r->per_inertia.z;
    const double lift = g->acceleration_made ? scale * r->per_mass : 0.0;
    for (int j = 0; j < g->n; j++) {
      const double later_N = motors->later_N[k][j];
      out[CH_FZ][j] += lift * later_N;
      out[CH_WX][j] += x * later_N;
      out[CH_WY][j] += y * later_N;
      out[CH_WZ][j] += z * later_N;
    }
  }
}
