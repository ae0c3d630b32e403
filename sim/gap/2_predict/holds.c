// holds.c - corrects predictions of differences between two points for commands that hold.
#include "gap/2_predict/holds.h"

#include "base/wide.h"
#include <math.h>
#include <stdlib.h>

bool holds_known(const grid_t *g) {
  return !g->by_speeds && !g->flight->rows_are_means && !grid_is_slow(g);
}

// given: the rotors' impulses up to the beginning of each sample, newton times samples. All rotors are
// computed side by side, here and below, because each sample of a single one waits for the sample before.
typedef struct {
  const four_t *hold_N;
  four_t *given;
} impulse_t;

// Adds the impulses at an instant of the segment first..last (samples). Thrusts at its ends hold beyond them.
WIDE_INLINE void add_given(const impulse_t *p, int first, int last, double at, four_t *sum) {
  const int i = at < first ? first : at < last ? (int)at : last;
  *sum += p->given[i] + (at - i) * p->hold_N[i];
}

static void add_up(const impulse_t *p, int samples) {
  four_t sum = {0.0};
  for (int i = 0; i < samples; i++) {
    p->given[i] = sum;
    sum += p->hold_N[i];
  }
}

static bool inside(const grid_t *g, int j) {
  const grid_point_t *const p = g->point;
  return j > 0 && j + 1 < g->n && p[j - 1].segment == p[j].segment && p[j + 1].segment == p[j].segment;
}

// Solves (x[j-1] + 4 x[j] + x[j+1]) / 6 = d[j] between the ends of a segment, where x is 0; d becomes x.
static void undo_simpson(const grid_t *g, four_t *d, double *room) {
  for (int j = 0; j < g->n; j++) {
    const bool in = inside(g, j), before = in && inside(g, j - 1);
    const double pivot = 4.0 - (before ? room[j - 1] : 0.0);
    room[j] = in ? 1.0 / pivot : 0.0;
    if (before)
      d[j] = (6.0 * d[j] - d[j - 1]) * room[j];
    else
      d[j] = in ? 6.0 * d[j] * room[j] : (four_t){0.0};
  }
  for (int j = g->n - 2; j > 0; j--)
    if (inside(g, j)) d[j] -= room[j] * d[j + 1];
}

// All rotors at a point: thrust, its root, and its rate of change over the root, the integral of which is
// twice the root.
typedef struct {
  four_t thrust_N, root, rise;
} instant_t;

static instant_t instant_of(const grid_t *g, const lagged_t *m, int j) {
  instant_t at;
  for (int k = 0; k < ROTORS; k++) {
    at.thrust_N[k] = m->thrust_N[k][j];
    at.root[k] = sqrt(fmax(at.thrust_N[k], g->slowest_N));
    at.rise[k] = m->rise_Nps[k][j] / at.root[k];
  }
  return at;
}

// Finds how much the impulses (given: by point) and the roots of the thrusts grow over the span, less what
// Simpson's rule makes of three instants.
static void find_later(const grid_t *g, const lagged_t *m, const four_t *given, four_t *later,
                       four_t *later_root) {
  instant_t before, here = instant_of(g, m, 0), next = here;
  for (int j = 0; j < g->n; j++) {
    before = here, here = next;
    if (j + 1 < g->n) next = instant_of(g, m, j + 1);
    later[j] = later_root[j] = (four_t){0.0};
    if (!inside(g, j)) continue;
    later[j] = (given[j + 1] - given[j - 1]) / (2.0 * g->every) -
               (before.thrust_N + 4.0 * here.thrust_N + next.thrust_N) / 6.0;
    later_root[j] =
        (next.root - before.root) / g->period_s - (before.rise + 4.0 * here.rise + next.rise) / 6.0;
  }
}

// Finds the impulses by point: means over its samples, because its rates are such means.
WIDE_COPIES static void give(const grid_t *g, const impulse_t *p, double shift, four_t *given) {
  for (int j = 0, i = 0, first = 0, last = -1; j < g->n; j++, i += g->every) {
    i = grid_begins(g, i);
    if (i > last) first = i, last = grid_segment_end(g, i);
    four_t sum = {0.0};
    for (int k = i; k < i + g->every; k++) add_given(p, first, last, k - shift, &sum);
    given[j] = sum / (double)g->every;
  }
}

bool holds_fit(const grid_t *g, const four_t *hold_N, double shift, lagged_t *motors) {
  const size_t points = (size_t)g->n + 1;
  four_t *const room = aligned_alloc(sizeof(four_t), (3 * points + (size_t)g->samples) * sizeof *room);
  if (!room) return false;
  four_t *const given = room, *const later = room + points, *const later_root = room + 2 * points;
  const impulse_t p = {hold_N, room + 3 * points};
  add_up(&p, g->samples);
  give(g, &p, shift, given);
  if (g->n > 0) find_later(g, motors, given, later, later_root);
  undo_simpson(g, later, (double *)given); // `given` is only room from here on
  undo_simpson(g, later_root, (double *)given);
  for (int k = 0; k < ROTORS; k++)
    for (int j = 0; j < g->n; j++) {
      motors->later_N[k][j] = later[j][k];
      motors->later_rootNps[k][j] = later_root[j][k];
    }
  free(room);
  return true;
}

// Adds the weighted sum of the four rotors' numbers at each point.
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
    spin_up[k] = turns * r->half_I_per_kf / r->per_root_kf; // times the rate of change over the root
  }
  if (g->acceleration_made) add_weighted(g->n, later_N, lift, out[CH_FZ]);
  add_weighted(g->n, later_N, x, out[CH_WX]);
  add_weighted(g->n, later_N, y, out[CH_WY]);
  add_weighted(g->n, later_N, z, out[CH_WZ]);
  if (r->rotor_inertia_kgm2 > 0.0)
    add_weighted(g->n, (const double *const *)motors->later_rootNps, spin_up, out[CH_WZ]);
}
