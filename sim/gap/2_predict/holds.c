// holds.c - commands that hold, as a difference of two points sees them.
#include "gap/2_predict/holds.h"

#include "base/wide.h"
#include <math.h>
#include <stdlib.h>

bool holds_known(const grid_t *g) {
  return g->quick && !g->by_speeds && !g->flight->rows_are_means && !grid_is_slow(g);
}

// Of one rotor: what its thrust has given up to the beginning of each sample, in newton times samples.
typedef struct {
  const four_t *hold_N;
  double *given;
  int rotor;
} impulse_t;

// At an instant among the samples first..last of a segment; what holds at its ends held before and behind.
static double given_at(const impulse_t *p, int first, int last, double at) {
  const int i = at < first ? first : at < last ? (int)at : last;
  return p->given[i] + (at - i) * p->hold_N[i][p->rotor];
}

static void add_up(impulse_t *p, int samples) {
  double sum = 0.0;
  for (int i = 0; i < samples; i++) {
    p->given[i] = sum;
    sum += p->hold_N[i][p->rotor];
  }
}

// What a mean of a point's samples has been given, as its rates are one.
static double given_to(const grid_t *g, const impulse_t *p, int first, int last, int i, double shift) {
  double sum = 0.0;
  for (int k = i; k < i + g->every; k++) sum += given_at(p, first, last, k - shift);
  return sum / g->every;
}

static bool inside(const grid_t *g, int j) {
  const grid_point_t *const p = g->point;
  return j > 0 && j + 1 < g->n && p[j - 1].segment == p[j].segment && p[j + 1].segment == p[j].segment;
}

static double by_simpson(const double *v, int j) {
  return (v[j - 1] + 4.0 * v[j] + v[j + 1]) / 6.0;
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

// given: by point. What it and the thrusts at the points' instants grow by over the span, less what Simpson's
// rule makes of the instants.
static void fit_one(const grid_t *g, const double *given, int k, lagged_t *m, double *room) {
  const double *const at_N = m->thrust_N[k], *const rise_Nps = m->rise_Nps[k];
  for (int j = 0; j < g->n; j++) {
    const bool in = inside(g, j);
    m->later_N[k][j] = in ? (given[j + 1] - given[j - 1]) / (2.0 * g->every) - by_simpson(at_N, j) : 0.0;
    m->later_rootNps[k][j] =
        in ? (at_N[j + 1] - at_N[j - 1]) / (2.0 * g->period_s) - by_simpson(rise_Nps, j) : 0.0;
  }
  undo_simpson(g, m->later_N[k], room);
  undo_simpson(g, m->later_rootNps[k], room);
  for (int j = 0; j < g->n; j++) m->later_rootNps[k][j] /= sqrt(fmax(at_N[j], g->slowest_N));
}

bool holds_fit(const grid_t *g, const four_t *hold_N, double shift, lagged_t *motors) {
  const size_t points = (size_t)g->n + 1;
  double *const room = malloc((2 * points + (size_t)g->samples) * sizeof *room);
  if (!room) return false;
  double *const given = room + points;
  for (int k = 0; k < ROTORS; k++) {
    impulse_t p = {hold_N, given + points, k};
    add_up(&p, g->samples);
    for (int j = 0, i = 0, first = 0, last = -1; j < g->n; j++, i += g->every) {
      i = grid_begins(g, i);
      if (i > last) first = i, last = grid_segment_end(g, i);
      given[j] = given_to(g, &p, first, last, i, shift);
    }
    fit_one(g, given, k, motors, room);
  }
  free(room);
  return true;
}

// Of each point, what the four rotors' numbers make with these weights.
WIDE_COPIES static void add_weighted(int n, const double *const by_rotor[ROTORS], const double weight[ROTORS],
                                     double *to) {
  const double *const a = by_rotor[0], *const b = by_rotor[1], *const c = by_rotor[2], *const d = by_rotor[3];
  for (int j = 0; j < n; j++)
    to[j] += weight[0] * a[j] + weight[1] * b[j] + weight[2] * c[j] + weight[3] * d[j];
}

void holds_add(const grid_t *g, const rigid_t *r, const lagged_t *motors, double *const out[CHANNELS]) {
  if (!motors->later_N[0]) return;
  const double *const *const later_N = (const double *const *)motors->later_N;
  double lift[ROTORS], x[ROTORS], y[ROTORS], z[ROTORS], spin_up[ROTORS];
  for (int k = 0; k < ROTORS; k++) {
    const double scale = r->thrust_scale[k], turns = -r->spin[k] * r->per_inertia.z;
    lift[k] = scale * r->per_mass;
    x[k] = scale * r->rotor_y_m[k] * r->per_inertia.x;
    y[k] = -scale * r->rotor_x_m[k] * r->per_inertia.y;
    z[k] = turns * scale * r->torque_scale[k] * r->torque_ratio_m;
    spin_up[k] = turns * r->half_I_per_kf / r->per_root_kf; // of a rise over the thrust's root
  }
  if (g->acceleration_made) add_weighted(g->n, later_N, lift, out[CH_FZ]);
  add_weighted(g->n, later_N, x, out[CH_WX]);
  add_weighted(g->n, later_N, y, out[CH_WY]);
  add_weighted(g->n, later_N, z, out[CH_WZ]);
  if (r->rotor_inertia_kgm2 > 0.0)
    add_weighted(g->n, (const double *const *)motors->later_rootNps, spin_up, out[CH_WZ]);
}
