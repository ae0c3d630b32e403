// smooth.c - places without what of their errors lasts for a moment only.
#include "gap/2_predict/grid.h"

#include <math.h>
#include <stdlib.h>

// On each side. Errors that last for 30 to 60 ms fall to 0.35 to 0.45 in it, in half of it to 0.46 to 0.6; in
// twice as much the velocity's own errors begin to move the place (by 3 mm, of 0.03 m/s).
// gap_takes_errors_of_a_moment_out_of_places holds both.
#define SMOOTH_S 0.25

// What the velocity adds up to from the first point on; of n points that follow each other.
static void add_up(const grid_point_t *p, int n, d3_t *sum) {
  sum[0] = d3(0.0, 0.0, 0.0);
  for (int j = 1; j < n; j++) {
    const double half_s = 0.5 * (p[j].t_s - p[j - 1].t_s);
    sum[j] = d3_add(sum[j - 1], d3_scale(half_s, d3_add(p[j - 1].vel_w_mps, p[j].vel_w_mps)));
  }
}

// off[0..n-1]: the place less what the velocity adds up to. Its mean over as many points before as after, so
// that a velocity with a constant error does no harm.
static d3_t middle(const d3_t *off, int n, int j, int reach) {
  const int side = j < reach || n - 1 - j < reach ? (j < n - 1 - j ? j : n - 1 - j) : reach;
  d3_t sum = {0.0, 0.0, 0.0};
  for (int i = j - side; i <= j + side; i++) sum = d3_add(sum, off[i]);
  return d3_scale(1.0 / (2 * side + 1), sum);
}

// n points; room: twice as many.
static void smooth(grid_point_t *p, int n, int reach, d3_t *room) {
  d3_t *const off = room + n;
  add_up(p, n, room);
  for (int j = 0; j < n; j++) off[j] = d3_sub(p[j].seen_w_m, room[j]);
  for (int j = 0; j < n; j++) p[j].pos_w_m = d3_add(room[j], middle(off, n, j, reach));
}

// Of a velocity that was made of places nothing new is to be learned. Velocities are left as they are:
// smoothed by the accelerations they go with what the forces' residual holds, and a climb seems to need an
// inflow.
done_t grid_smooth(grid_t *g, why_t *why) {
  const int reach = (int)round(SMOOTH_S / g->period_s);
  if (!g->has_position || !g->has_velocity || g->velocity_made) return DONE;
  d3_t *const room = malloc((2 * (size_t)g->n + 1) * sizeof(d3_t));
  if (!room) return error_failed(why, "out of memory");
  for (int from = 0, to; from < g->n; from = to) {
    grid_point_t *const p = &g->point[from];
    for (to = from + 1; to < g->n && g->point[to].segment == p->segment && g->point[to].ok == p->ok;) to++;
    if (p->ok) smooth(p, to - from, reach, room);
  }
  free(room);
  return DONE;
}
