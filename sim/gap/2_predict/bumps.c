// bumps.c - finds points at which something solid pushes.
//
// Positions err by a centimetre or two, so a vehicle that touches a ceiling may seem to be clear of it. A
// bump is no part of any model of air; a few rows of it outweigh all that a ceiling effect does in a flight.
#include "gap/2_predict/grid.h"

#include "base/nth.h"
#include <math.h>
#include <stdlib.h>

// Distance of any part of the vehicle from floor or ceiling below which it may touch: positions err by 1 cm
// or 2, and tilt moves an edge by as much.
#define NEAR_M 0.03
// A vehicle that touched is taken to touch until it is clear for sure: at one approach positions err by a
// centimetre, and for half a second in the same direction. One that its ceiling effect has drawn up rests
// there, and nothing pushes it beyond its lift. With this rule, of 26 data sets by others with a ceiling,
// five more name it and two no longer do.
#define SURE_M 0.01
#define SURE_S 0.5
// Share of the weight: ground and ceiling effects give a third at most, a bump at 0.2 m/s several weights.
#define LIFT_SHARE 0.5
// Share of the weight, at a rotor's arm: a push at one edge turns the vehicle more than it lifts it. The
// moments of a tilt under a ceiling are a tenth of this.
#define EDGE_SHARE 0.1

// Lift (m/s2) and turning about x and y (rad/s2) beyond those by the commands; NaN: not logged.
enum { LIFT, TURN_X, TURN_Y, PUSHES };

static double lifted_mps2(const grid_t *g, const model_t *m, const grid_point_t *p, int sample) {
  double thrust_N = 0.0;
  for (int k = 0; k < ROTORS; k++)
    for (int i = 0; i < g->every; i++) thrust_N += g->command_N[k][sample + i] / g->every;
  return g->has_force ? p->acc_b_mps2.z - thrust_N / m->mass_kg : (double)NAN;
}

// Returns the turning from the sample before the point to the one after it; NaN also if rows miss commands.
static double turned_radps2(const grid_t *g, const model_t *m, int axis, int sample) {
  const int before = sample - 1, behind = sample + g->every;
  const int *const segment = g->flight->segment;
  if (!g->has_rates || !g->has_moments || grid_misses_commands(g)) return (double)NAN;
  if (before < 0 || behind >= g->samples) return (double)NAN;
  if (segment && segment[g->from + before] != segment[g->from + behind]) return (double)NAN;
  const double *const rate_radps = g->flight->v[SIG_GX + axis] + g->from;
  double command_radps2 = 0.0;
  for (int i = sample; i < behind; i++) command_radps2 += grid_turns(g, m, axis, i) / g->every;
  const double span_s = (behind - before) * g->period_s / g->every;
  return (rate_radps[behind] - rate_radps[before]) / span_s - command_radps2;
}

// Finds the largest pushes, either way, that air can make.
static void find_most(const model_t *m, double most[PUSHES]) {
  const double weight_N = m->mass_kg * G_MPS2;
  double arm_m[2] = {0.0, 0.0}; // about x, y
  for (int k = 0; k < ROTORS; k++) {
    arm_m[0] = fmax(arm_m[0], fabs(m->frame.rotor_y_m[k]));
    arm_m[1] = fmax(arm_m[1], fabs(m->frame.rotor_x_m[k]));
  }
  most[LIFT] = LIFT_SHARE * G_MPS2;
  for (int i = 0; i < 2; i++) most[TURN_X + i] = EDGE_SHARE * weight_N * arm_m[i] / m->frame.inertia_kgm2[i];
}

static void find_pushes(const grid_t *g, const model_t *m, double *of[PUSHES]) {
  for (int j = 0, i = 0; j < g->n; j++, i += g->every) {
    i = grid_begins(g, i);
    of[LIFT][j] = lifted_mps2(g, m, &g->point[j], i);
    for (int axis = 0; axis < 2; axis++) of[TURN_X + axis][j] = turned_radps2(g, m, axis, i);
  }
}

// Returns the median of the numbers that are there: a load or another centre of mass pushes all the time.
static double median_of(const double *v, int n, double *room) {
  int finite = 0;
  for (int j = 0; j < n; j++)
    if (isfinite(v[j])) room[finite++] = v[j];
  return finite ? nth_smallest(room, finite, (finite - 1) / 2) : 0.0;
}

static bool is_high(const model_t *m, const grid_point_t *p) {
  return m->ceiling_m - p->pos_w_m.z <= p->pos_w_m.z;
}

// Leaves a point out. Those at or near the ceiling are counted, for a note; on the floor the vehicle lands.
static void leave_out(grid_t *g, const model_t *m, grid_point_t *p) {
  p->ok = false;
  if (!is_high(m, p)) return;
  if (g->bumps++ == 0 || p->t_s < g->bump_s) g->bump_s = p->t_s;
}

// Leaves out points that are still near a surface which the vehicle touched less than SURE_S before (way 1),
// or touches less than SURE_S later (-1). At the floor only before it was first clear, and after it last was:
// it lifts off and lands there, and in between no air holds it down. A point without a position ends nothing.
static void leave_out_beside(grid_t *g, const model_t *m, int way) {
  double touched_s = HUGE_VAL;
  int first = 0, last = g->n - 1;
  while (first < g->n && !(g->point[first].clear_m >= SURE_M)) first++;
  while (last >= 0 && !(g->point[last].clear_m >= SURE_M)) last--;
  for (int j = way > 0 ? 0 : g->n - 1; j >= 0 && j < g->n; j += way) {
    grid_point_t *const p = &g->point[j];
    if (p->clear_m >= SURE_M) touched_s = HUGE_VAL;
    if (p->touches && (is_high(m, p) || j < first || j > last)) touched_s = p->t_s;
    if (p->ok && fabs(p->t_s - touched_s) < SURE_S) leave_out(g, m, p);
  }
}

done_t grid_leave_out_bumps(grid_t *g, const model_t *m, why_t *why) {
  double most[PUSHES], usual[PUSHES], *of[PUSHES];
  const size_t n = (size_t)g->n;
  if (!g->has_position) return DONE;
  double *const room = malloc(((PUSHES + 1) * n + 1) * sizeof(double));
  if (!room) return error_failed(why, "out of memory");
  for (size_t k = 0; k < PUSHES; k++) of[k] = room + k * n;
  find_pushes(g, m, of);
  find_most(m, most);
  for (int k = 0; k < PUSHES; k++) usual[k] = median_of(of[k], g->n, room + PUSHES * n);
  for (int j = 0; j < g->n; j++) {
    grid_point_t *const p = &g->point[j];
    bool bumps = false;
    for (int k = 0; k < PUSHES; k++) bumps = bumps || fabs(of[k][j] - usual[k]) > most[k];
    p->touches = p->touches || (p->clear_m < NEAR_M && bumps);
    if (p->ok && p->touches) leave_out(g, m, p);
  }
  free(room);
  leave_out_beside(g, m, 1);
  leave_out_beside(g, m, -1);
  return DONE;
}
