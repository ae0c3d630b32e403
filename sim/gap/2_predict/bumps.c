// bumps.c - points at which something solid pushes.
//
// Places err by a centimetre or two, so a vehicle that touches a ceiling may be told to be clear of it. A
// bump is no part of any model of air; a few rows of it outweigh all that a ceiling effect does in a flight.
#include "gap/2_predict/grid.h"

#include <math.h>

#define NEAR_M      0.03 // of any part of the vehicle from floor or ceiling
#define SHARE       0.5  // of the weight: ground and ceiling effects give a third
#define SHARE_ALONE 0.1  // the same, at a rotor: what pushes at one edge turns more than it lifts

static double mean_of(const double *v, int n) {
  double sum = 0.0;
  for (int i = 0; i < n; i++) sum += v[i] / n;
  return sum;
}

// What it is lifted with beyond its command, m/s2.
static double lifted_mps2(const grid_t *g, const model_t *m, const grid_point_t *p, int sample) {
  double thrust_N = 0.0;
  for (int k = 0; k < ROTORS; k++) thrust_N += mean_of(g->command_N[k] + sample, g->every);
  return p->acc_b_mps2.z - thrust_N / m->mass_kg;
}

// What it is turned with about x or y beyond its command, from the sample before the point to the one behind.
static double turned_radps2(const grid_t *g, const model_t *m, int axis, int sample) {
  const int before = sample - 1, behind = sample + g->every;
  const int *const segment = g->flight->segment;
  if (before < 0 || behind >= g->samples) return 0.0;
  if (segment && segment[g->from + before] != segment[g->from + behind]) return 0.0;
  const double *const rate_radps = g->flight->v[SIG_GX + axis] + g->from;
  double command_radps2 = 0.0;
  for (int i = sample; i < behind; i++) command_radps2 += grid_turns(g, m, axis, i) / g->every;
  const double span_s = (behind - before) * g->period_s / g->every;
  return (rate_radps[behind] - rate_radps[before]) / span_s - command_radps2;
}

bool grid_bumps(const grid_t *g, const model_t *m, const grid_point_t *p, int sample) {
  if (!g->has_position || !(p->clear_m < NEAR_M)) return false;
  if (g->has_force && fabs(lifted_mps2(g, m, p, sample)) > SHARE * G_MPS2) return true;
  const double arm_m[2] = {fabs(m->frame.rotor_y_m[0]), fabs(m->frame.rotor_x_m[0])};
  const bool told = g->has_rates && g->has_moments && !grid_misses_commands(g);
  for (int axis = 0; axis < 2 && told; axis++) {
    const double most_radps2 = SHARE_ALONE * m->mass_kg * G_MPS2 * arm_m[axis] / m->frame.inertia_kgm2[axis];
    if (fabs(turned_radps2(g, m, axis, sample)) > most_radps2) return true;
  }
  return false;
}
