// smooth.c - places and velocities without what of their errors lasts for a moment only.
#include "gap/2_predict/grid.h"

#include <math.h>
#include <stdlib.h>

// On each side. Errors that last for 30 to 60 ms fall to 0.35 to 0.45 in it, in half of it to 0.46 to 0.6; in
// twice as much a velocity's own errors begin to move the place (by 3 mm, of 0.03 m/s, without
// accelerations). gap_takes_errors_of_a_moment_out_of_places_and_velocities holds both.
#define SMOOTH_S 0.25

typedef d3_t (*look_t)(const grid_point_t *p);

static d3_t place(const grid_point_t *p) {
  return p->seen_w_m;
}

static d3_t velocity(const grid_point_t *p) {
  return p->seen_w_mps;
}

static d3_t better_velocity(const grid_point_t *p) {
  return p->vel_w_mps;
}

static d3_t acceleration(const grid_point_t *p) {
  const axes_t axes = axes_of(p->q_wb);
  return d3_sub(axes_to_world(&axes, p->acc_b_mps2), d3(0.0, 0.0, G_MPS2));
}

// What the rate adds up to from the first point on; of n points that follow each other.
static void add_up(const grid_point_t *p, int n, look_t rate, d3_t *sum) {
  sum[0] = d3(0.0, 0.0, 0.0);
  for (int j = 1; j < n; j++) {
    const double half_s = 0.5 * (p[j].t_s - p[j - 1].t_s);
    sum[j] = d3_add(sum[j - 1], d3_scale(half_s, d3_add(rate(&p[j - 1]), rate(&p[j]))));
  }
}

// off[0..n-1]: what is measured less what its rate adds up to. Its mean over as many points before as after,
// so that a rate with a constant error does no harm.
static d3_t middle(const d3_t *off, int n, int j, int reach) {
  const int side = j < reach || n - 1 - j < reach ? (j < n - 1 - j ? j : n - 1 - j) : reach;
  d3_t sum = {0.0, 0.0, 0.0};
  for (int i = j - side; i <= j + side; i++) sum = d3_add(sum, off[i]);
  return d3_scale(1.0 / (2 * side + 1), sum);
}

// n values, without; room: twice as many, of which the first get them.
static void smooth(const grid_point_t *p, int n, int reach, look_t value, look_t rate, d3_t *room) {
  d3_t *const off = room + n;
  add_up(p, n, rate, room);
  for (int j = 0; j < n; j++) off[j] = d3_sub(value(&p[j]), room[j]);
  for (int j = 0; j < n; j++) room[j] = d3_add(room[j], middle(off, n, j, reach));
}

// Of a velocity that was made of places, or an acceleration of velocities, nothing new is to be learned.
done_t grid_smooth(grid_t *g, why_t *why) {
  const bool places = g->has_position && g->has_velocity && !g->velocity_made;
  const bool velocities =
      g->has_velocity && !g->velocity_made && g->has_force && !g->acceleration_made && g->has_attitude;
  const int reach = (int)round(SMOOTH_S / g->period_s);
  d3_t *const room = malloc((2 * (size_t)g->n + 1) * sizeof(d3_t));
  if (!room) return error_failed(why, "out of memory");
  for (int from = 0, to; from < g->n; from = to) {
    grid_point_t *const p = &g->point[from];
    for (to = from + 1; to < g->n && g->point[to].segment == p->segment && g->point[to].ok == p->ok;) to++;
    if (!p->ok) continue;
    if (velocities) smooth(p, to - from, reach, velocity, acceleration, room);
    for (int j = 0; velocities && j < to - from; j++) p[j].vel_w_mps = room[j];
    if (places) smooth(p, to - from, reach, place, better_velocity, room);
    for (int j = 0; places && j < to - from; j++) p[j].pos_w_m = room[j];
  }
  free(room);
  return DONE;
}
