// grid_motors.c - what the motors made of the commands.
#include "gap/2_predict/grid.h"

#include "base/pair.h"
#include <math.h>
#include <stdlib.h>

// One number of every rotor.
typedef double forces_t[ROTORS];

// Command and thrust by sample; the thrust is wanted `shift` samples before.
typedef struct {
  forces_t *command_N, *thrust_N;
  double shift, per_tau;
} history_t;

// Adds what the thrusts were at sample i - shift, and how fast they rose.
static void look_back(const history_t *h, int first, int i, pair_t thrust_N[2], pair_t rise_Nps[2]) {
  const double at = fmax((double)i - h->shift, (double)first);
  const int low = (int)at;
  const double share = at - low;
  for (int k = 0; k < 2; k++) {
    const pair_t thrust = pair_of(h->thrust_N[low] + 2 * k);
    rise_Nps[k] += (pair_of(h->command_N[low] + 2 * k) - thrust) * h->per_tau;
    thrust_N[k] += share > 0.0 ? thrust + share * (pair_of(h->thrust_N[low + 1] + 2 * k) - thrust) : thrust;
  }
}

// A command holds until the next sample; it was there long enough at the start of a segment.
static void lag(const grid_t *g, double tau_s, const history_t *h) {
  const int *segment = g->flight->segment ? g->flight->segment + g->from : NULL;
  const double share = 1.0 - exp(-1.0 / (g->flight->rate_Hz * tau_s));
  pair_t f[2] = {{0.0, 0.0}, {0.0, 0.0}};
  for (int i = 0; i < g->samples; i++) {
    const bool starts = i == 0 || (segment && segment[i] != segment[i - 1]);
    for (int k = 0; k < 2; k++) {
      const pair_t command = pair_of(h->command_N[i] + 2 * k);
      if (starts) f[k] = command;
      pair_put(h->thrust_N[i] + 2 * k, f[k]);
      f[k] += share * (command - f[k]);
    }
  }
}

static void average(const grid_t *g, const history_t *h, lagged_t *m) {
  const gap_flight_t *f = g->flight;
  int i = 0, first = 0;
  for (int j = 0; j < g->n; j++) {
    // As take_points has walked.
    while (f->segment && f->segment[g->from + i] != f->segment[g->from + i + g->every - 1]) i++;
    if (j > 0 && g->point[j].segment != g->point[j - 1].segment) first = i;
    pair_t thrust_N[2] = {{0.0, 0.0}, {0.0, 0.0}}, rise_Nps[2] = {{0.0, 0.0}, {0.0, 0.0}};
    for (int k = i; k < i + g->every; k++) look_back(h, first, k, thrust_N, rise_Nps);
    for (int k = 0; k < ROTORS; k++) {
      m->thrust_N[k][j] = thrust_N[k / 2][k % 2] / g->every;
      m->rise_Nps[k][j] = rise_Nps[k / 2][k % 2] / g->every;
    }
    i += g->every;
  }
}

static void follow(const grid_t *g, forces_t *room, lagged_t *m) {
  const history_t h = {room, room + g->samples, m->delay_s * g->flight->rate_Hz, 1.0 / m->tau_s};
  for (int i = 0; i < g->samples; i++)
    for (int k = 0; k < ROTORS; k++) h.command_N[i][k] = g->command_N[k][i];
  lag(g, m->tau_s, &h);
  average(g, &h, m);
}

const lagged_t *grid_motors(grid_t *g, double tau_s, double delay_s) {
  for (int i = 0; i < GRID_MOTORS; i++)
    if (g->motors[i].thrust_N[0] && g->motors[i].tau_s == tau_s && g->motors[i].delay_s == delay_s)
      return &g->motors[i];
  lagged_t *const m = &g->motors[g->motors_used++ % GRID_MOTORS];
  const size_t n = (size_t)g->n;
  if (!m->thrust_N[0]) m->thrust_N[0] = malloc(2 * ROTORS * (n + 1) * sizeof(double));
  forces_t *const room = malloc(2 * (size_t)g->samples * sizeof *room);
  if (!m->thrust_N[0] || !room) {
    free(room);
    return NULL;
  }
  m->tau_s = tau_s;
  m->delay_s = delay_s;
  for (int k = 0; k < ROTORS; k++) {
    m->thrust_N[k] = m->thrust_N[0] + (size_t)k * n;
    m->rise_Nps[k] = m->thrust_N[0] + (size_t)(ROTORS + k) * n;
  }
  follow(g, room, m);
  free(room);
  return m;
}
