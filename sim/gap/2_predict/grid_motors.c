// grid_motors.c - what the motors made of the commands.
//
// A command holds until the next row of the log. A row that is a sample has the thrust of its instant, before
// its own command acts (without a lag: with it); a row that is a mean has the mean over its hold.
#include "gap/2_predict/grid.h"

#include "base/pair.h"
#include "body/points.h"
#include <math.h>
#include <stdlib.h>

// One number of every rotor.
typedef double forces_t[ROTORS];

// By sample; they are wanted `shift` samples before.
typedef struct {
  forces_t *thrust_N, *rise_Nps;
  double shift;
} history_t;

// A rotor and what it does in one row's hold.
typedef struct {
  double thrust_N, rise_Nps, end; // end: what follows, when the hold is over
} hold_t;

// What a hold leaves of a distance, while the rotor speeds up and while it slows down.
typedef struct {
  double up, down;
} keep_t;

static keep_t keep_of(const lag_t *lag, double rate_Hz) {
  return (keep_t){exp(-1.0 / (rate_Hz * lag->up_s)), exp(-1.0 / (rate_Hz * lag->down_s))};
}

static hold_t hold(const lag_t *lag, const keep_t *left, double rate_Hz, bool mean, double start,
                   double command_N) {
  const double to = lag_follows(lag, command_N), tau_s = lag_s(lag, start, to);
  if (lag_is_none(lag)) return (hold_t){command_N, 0.0, to};
  const double keep = to > start ? left->up : left->down, off = start - to;
  const double end = to + keep * off, rise = (to - start) / tau_s;
  const double now_N = lag_thrust_N(lag, start), end_N = lag_thrust_N(lag, end);
  if (!mean) return (hold_t){now_N, lag->in_speed ? 2.0 * start * rise : rise, end};
  // Of to + off exp(-t / tau), and of its square.
  const double once = tau_s * rate_Hz * (1.0 - keep), twice = 0.5 * tau_s * rate_Hz * (1.0 - keep * keep);
  const double mean_N = lag->in_speed ? to * to + 2.0 * to * off * once + off * off * twice : to + off * once;
  return (hold_t){mean_N, (end_N - now_N) * rate_Hz, end};
}

// A command was there long enough at the start of a segment. All rotors side by side: of one alone each hold
// waits for the one before.
static void follow(const grid_t *g, const lag_t *lag, const history_t *h) {
  const int *segment = g->flight->segment ? g->flight->segment + g->from : NULL;
  const keep_t left = keep_of(lag, g->flight->rate_Hz);
  const double rate_Hz = g->flight->rate_Hz;
  const bool means = g->flight->rows_are_means;
  double now[ROTORS] = {0.0};
  for (int i = 0; i < g->samples; i++) {
    const bool starts = i == 0 || (segment && segment[i] != segment[i - 1]);
    for (int k = 0; k < ROTORS; k++) {
      const double command_N = g->command_N[k][i];
      if (starts) now[k] = lag_follows(lag, command_N);
      const hold_t row = hold(lag, &left, rate_Hz, means, now[k], command_N);
      h->thrust_N[i][k] = row.thrust_N;
      h->rise_Nps[i][k] = row.rise_Nps;
      now[k] = row.end;
    }
  }
}

static pair_t between(forces_t *v, int low, double share, int k) {
  const pair_t a = pair_of(v[low] + 2 * k);
  return share > 0.0 ? a + share * (pair_of(v[low + 1] + 2 * k) - a) : a;
}

// Adds what the thrusts were at sample i - shift of the samples first..last, and how fast they rose.
static void look_back(const history_t *h, int first, int last, int i, pair_t thrust_N[2],
                      pair_t rise_Nps[2]) {
  const double at = fmin(fmax((double)i - h->shift, (double)first), (double)last);
  const int low = (int)at;
  for (int k = 0; k < 2; k++) {
    thrust_N[k] += between(h->thrust_N, low, at - low, k);
    rise_Nps[k] += between(h->rise_Nps, low, at - low, k);
  }
}

static int last_of_segment(const grid_t *g, int i) {
  const int *segment = g->flight->segment;
  if (!segment) return g->samples - 1;
  while (i + 1 < g->samples && segment[g->from + i + 1] == segment[g->from + i]) i++;
  return i;
}

static void average(const grid_t *g, const history_t *h, lagged_t *m) {
  const gap_flight_t *f = g->flight;
  int i = 0, first = 0, last = last_of_segment(g, 0);
  for (int j = 0; j < g->n; j++) {
    // As take_points has walked.
    while (f->segment && f->segment[g->from + i] != f->segment[g->from + i + g->every - 1]) i++;
    if (j > 0 && g->point[j].segment != g->point[j - 1].segment) first = i;
    if (i > last) last = last_of_segment(g, i);
    pair_t thrust_N[2] = {{0.0, 0.0}, {0.0, 0.0}}, rise_Nps[2] = {{0.0, 0.0}, {0.0, 0.0}};
    for (int k = i; k < i + g->every; k++) look_back(h, first, last, k, thrust_N, rise_Nps);
    for (int k = 0; k < ROTORS; k++) {
      m->thrust_N[k][j] = thrust_N[k / 2][k % 2] / g->every;
      m->rise_Nps[k][j] = rise_Nps[k / 2][k % 2] / g->every;
    }
    i += g->every;
  }
}

bool grid_same_motors(const lag_t *a, double a_delay_s, const lag_t *b, double b_delay_s) {
  return a->up_s == b->up_s && a->down_s == b->down_s && a->in_speed == b->in_speed && a_delay_s == b_delay_s;
}

static bool is_of(const lagged_t *m, const lag_t *lag, double delay_s) {
  return m->thrust_N[0] && grid_same_motors(&m->lag, m->delay_s, lag, delay_s);
}

// The next one to be filled. The first stays: it is of the model alone, and what is asked for again and
// again.
static lagged_t *place_of(grid_t *g) {
  lagged_t *const first = &g->motors[0];
  if (!first->thrust_N[0] || isnan(first->delay_s)) return first;
  lagged_t *const m = &g->motors[1 + g->motors_used++ % (GRID_MOTORS - 1)];
  if (m->lent) *m = (lagged_t){.lent = false};
  return m;
}

const lagged_t *grid_motors(grid_t *g, const lag_t *lag, double delay_s) {
  for (int i = 0; i < GRID_MOTORS; i++)
    if (is_of(&g->motors[i], lag, delay_s)) return &g->motors[i];
  lagged_t *const m = place_of(g);
  const size_t n = (size_t)g->n;
  if (!m->thrust_N[0]) m->thrust_N[0] = malloc(2 * ROTORS * (n + 1) * sizeof(double));
  forces_t *const room = malloc(2 * (size_t)g->samples * sizeof *room);
  if (!m->thrust_N[0] || !room) {
    free(room);
    return NULL;
  }
  m->lag = *lag;
  m->delay_s = delay_s;
  for (int k = 0; k < ROTORS; k++) {
    m->thrust_N[k] = m->thrust_N[0] + (size_t)k * n;
    m->rise_Nps[k] = m->thrust_N[0] + (size_t)(ROTORS + k) * n;
  }
  const history_t h = {room, room + g->samples, delay_s * g->flight->rate_Hz};
  follow(g, lag, &h);
  average(g, &h, m);
  free(room);
  return m;
}

grid_t grid_lend(const grid_t *g) {
  grid_t lent = *g;
  lent.eight = NULL;
  for (int i = 0; i < GRID_MOTORS; i++) lent.motors[i].lent = lent.motors[i].thrust_N[0] != NULL;
  return lent;
}

void grid_give_back(grid_t *lent) {
  points_close(lent->eight);
  for (int i = 0; i < GRID_MOTORS; i++)
    if (!lent->motors[i].lent) free(lent->motors[i].thrust_N[0]);
}
