// grid_motors.c - the thrusts with which the motors follow the commands.
//
// A command holds until the next row of the log. Where rows miss commands, it runs along a line to the next
// one (of 500 commands a second, one that held for a row of 100 a second would be 5 ms late). A row that is
// an instant has the thrust before its own command acts (without a lag: with it); a row that is a mean has
// the mean over its hold.
#include "gap/2_predict/holds.h"

#include "base/wide.h"
#include "body/points.h"
#include <math.h>
#include <stdlib.h>

// By sample, of every rotor. A point takes them `shift` samples before its own (the delay).
typedef struct {
  four_t *thrust_N, *rise_Nps;
  double shift;
} history_t;

// Shares of the distance to a command that are left after a hold, while a rotor speeds up or slows down.
typedef struct {
  double up, down;
} keep_t;

static keep_t keep_of(const lag_t *lag, double rate_Hz) {
  return (keep_t){exp(-1.0 / (rate_Hz * lag->up_s)), exp(-1.0 / (rate_Hz * lag->down_s))};
}

WIDE_INLINE void choose(const four_bits_t *holds, double a, double b, four_t *to) {
  const four_t all_a = {a, a, a, a}, all_b = {b, b, b, b};
  *to = (four_t)((*holds & (four_bits_t)all_a) | (~*holds & (four_bits_t)all_b));
}

// Moves every rotor on from one row to the next; if rows are means, the command holds. now: the number that
// follows the command (lag_follows), at this row and then at the next.
WIDE_INLINE void go_on(const lag_t *lag, const keep_t *left, double rate_Hz, bool mean,
                       const four_t *command_N, const four_t *next_N, four_t *now, four_t *thrust_N,
                       four_t *rise_Nps) {
  const bool in_speed = lag->in_speed;
  const four_t start = *now;
  four_t to = *command_N, next = *next_N, tau_s, keep;
  for (int k = 0; in_speed && k < ROTORS; k++) {
    to[k] = lag_follows(lag, to[k]);
    next[k] = lag_follows(lag, next[k]);
  }
  const four_bits_t speeds_up = to > start;
  choose(&speeds_up, lag->up_s, lag->down_s, &tau_s);
  choose(&speeds_up, left->up, left->down, &keep);
  const four_t off = start - to, behind = (next - to) * rate_Hz * tau_s; // the lag behind a line
  const four_t end = next - behind + keep * (off + behind), rise = (to - start) / tau_s;
  const four_t now_N = in_speed ? start * start : start, end_N = in_speed ? end * end : end;
  *now = end;
  if (!mean) {
    *thrust_N = now_N;
    *rise_Nps = in_speed ? 2.0 * start * rise : rise;
    return;
  }
  // Means over the hold of to + off exp(-t / tau), and of its square.
  const four_t once = tau_s * rate_Hz * (1.0 - keep), twice = 0.5 * tau_s * rate_Hz * (1.0 - keep * keep);
  *thrust_N = in_speed ? to * to + 2.0 * to * off * once + off * off * twice : to + off * once;
  *rise_Nps = (end_N - now_N) * rate_Hz;
}

// mean: each command holds, and the mean over its hold is computed.
WIDE_INLINE void follow_all(const grid_t *g, const lag_t *lag, bool mean, const history_t *h) {
  const int *segment = g->flight->segment ? g->flight->segment + g->from : NULL;
  const keep_t left = keep_of(lag, g->flight->rate_Hz);
  const double rate_Hz = g->flight->rate_Hz;
  const bool none = lag_is_none(lag), along = g->by_speeds || (!mean && grid_is_slow(g));
  four_t now = {0.0};
  for (int i = 0; i < g->samples; i++) {
    const bool last = i + 1 == g->samples || (segment && segment[i] != segment[i + 1]);
    double *const *const c = g->command_N;
    const int j = i + (along && !last);
    const four_t command_N = {c[0][i], c[1][i], c[2][i], c[3][i]};
    const four_t next_N = {c[0][j], c[1][j], c[2][j], c[3][j]};
    if (none) {
      h->thrust_N[i] = command_N;
      h->rise_Nps[i] = g->by_speeds && !last ? (next_N - command_N) * rate_Hz : (four_t){0.0};
      continue;
    }
    if (i == 0 || (segment && segment[i] != segment[i - 1]))
      for (int k = 0; k < ROTORS; k++) now[k] = lag_follows(lag, command_N[k]);
    go_on(lag, &left, rate_Hz, mean, &command_N, &next_N, &now, &h->thrust_N[i], &h->rise_Nps[i]);
  }
}

// At the start of a segment the rotors have settled at the command. All rotors are computed side by side,
// because each hold of a single one waits for the hold before.
WIDE_COPIES static void follow(const grid_t *g, const lag_t *lag, bool mean, const history_t *h) {
  if (mean)
    follow_all(g, lag, true, h);
  else
    follow_all(g, lag, false, h);
}

// --- a lag of which a part goes with the square of the speed ---------------------------------------------

// Rates in one direction: m = Om - u (roots of thrusts) changes by -m l - b m^2, l = a + 2 b u (plant/lag.h).
typedef struct {
  double a, b; // 1/s, and 1/s for each root of a newton
} rate_t;

static rate_t rate_of(const lag_t *lag, bool speeds_up) {
  const double tau_s = speeds_up ? lag->up_s : lag->down_s, q = speeds_up ? lag->up_square : lag->down_square;
  return (rate_t){(1.0 - q) / tau_s, 0.5 * q / (sqrt(lag->steady_N) * tau_s)};
}

// Keeps l above 0. The limit at l = 0, m / (1 + b m t), does not differ from the result.
static double not_zero(double l) {
  return fmax(l, 1e-6);
}

static double squared_at(double m, double l, double b, double t_s) {
  return m * exp(-l * t_s) / (1.0 - b * m * expm1(-l * t_s) / l);
}

// Returns the speed after a hold in which the command runs along a line. The rate of following is taken to be
// that in the middle of the hold.
static double along_line(rate_t rate, double hold_s, double to, double next, double start) {
  double end = start;
  for (int i = 0; i < 2; i++) { // the second time with the middle of the first result
    const double l = not_zero(rate.a + 0.5 * rate.b * (to + next + start + end));
    const double behind = (next - to) / (hold_s * l);
    end = next - behind + exp(-l * hold_s) * (start - to + behind);
  }
  return end;
}

// Moves one rotor on from one row to the next. now: as above. A mean is by Simpson's rule over two halves.
static void go_on_squared(const lag_t *lag, double hold_s, bool mean, double command_N, double next_N,
                          double *now, double *thrust_N, double *rise_Nps) {
  const double to = lag_follows(lag, command_N), next = lag_follows(lag, next_N), start = *now;
  const rate_t rate = rate_of(lag, to > start);
  const double m = start - to, l = not_zero(rate.a + 2.0 * rate.b * to);
  *now = next != to ? along_line(rate, hold_s, to, next, start) : to + squared_at(m, l, rate.b, hold_s);
  *thrust_N = start * start;
  *rise_Nps = -2.0 * start * m * (l + rate.b * m);
  if (!mean) return;
  double sum = start * start + *now * *now;
  for (int i = 1; i < 4; i++) {
    const double at = to + squared_at(m, l, rate.b, 0.25 * i * hold_s);
    sum += (i == 2 ? 2.0 : 4.0) * at * at;
  }
  *thrust_N = sum / 12.0;
  *rise_Nps = (*now * *now - start * start) / hold_s;
}

static bool segment_ends(const grid_t *g, int i) {
  const int *const segment = g->flight->segment ? g->flight->segment + g->from : NULL;
  return i + 1 == g->samples || (segment && segment[i] != segment[i + 1]);
}

static void follow_squared(const grid_t *g, const lag_t *lag, bool mean, const history_t *h) {
  const bool along = !mean && grid_is_slow(g);
  double now[ROTORS] = {0.0};
  for (int i = 0; i < g->samples; i++) {
    const bool begins = i == 0 || segment_ends(g, i - 1);
    for (int k = 0; k < ROTORS; k++) {
      const double command_N = g->command_N[k][i],
                   next_N = g->command_N[k][i + (along && !segment_ends(g, i))];
      double thrust_N, rise_Nps;
      if (begins) now[k] = lag_follows(lag, command_N);
      go_on_squared(lag, 1.0 / g->flight->rate_Hz, mean, command_N, next_N, &now[k], &thrust_N, &rise_Nps);
      h->thrust_N[i][k] = thrust_N;
      h->rise_Nps[i][k] = rise_Nps;
    }
  }
}

static void follow_lag(const grid_t *g, const lag_t *lag, bool mean, const history_t *h) {
  if (lag_is_squared(lag))
    follow_squared(g, lag, mean, h);
  else
    follow(g, lag, mean, h);
}

// --- the history of a model ------------------------------------------------------------------------------

// Adds the thrusts, and their rates of change, at sample i - shift, kept within the samples first..last.
WIDE_INLINE void look_back(const history_t *h, int first, int last, int i, four_t *thrust_N,
                           four_t *rise_Nps) {
  const double wanted = (double)i - h->shift, from = wanted > first ? wanted : first;
  const double at = from < last ? from : last;
  const int low = (int)at;
  const double share = at - low;
  const four_t *const thrust = h->thrust_N + low, *const rise = h->rise_Nps + low;
  *thrust_N += share > 0.0 ? thrust[0] + share * (thrust[1] - thrust[0]) : thrust[0];
  *rise_Nps += share > 0.0 ? rise[0] + share * (rise[1] - rise[0]) : rise[0];
}

WIDE_COPIES static void average(const grid_t *g, const history_t *h, lagged_t *m) {
  int i = 0, first = 0, last = grid_segment_end(g, 0);
  for (int j = 0; j < g->n; j++) {
    i = grid_begins(g, i);
    if (j > 0 && g->point[j].segment != g->point[j - 1].segment) first = i;
    if (i > last) last = grid_segment_end(g, i);
    four_t thrust_N = {0.0}, rise_Nps = {0.0};
    for (int k = i; k < i + g->every; k++) look_back(h, first, last, k, &thrust_N, &rise_Nps);
    for (int k = 0; k < ROTORS; k++) {
      m->thrust_N[k][j] = thrust_N[k] / g->every;
      m->rise_Nps[k][j] = rise_Nps[k] / g->every;
    }
    i += g->every;
  }
}

bool grid_same_motors(const lag_t *a, double a_delay_s, const lag_t *b, double b_delay_s) {
  return a->up_s == b->up_s && a->down_s == b->down_s && a->in_speed == b->in_speed &&
         a->up_square == b->up_square && a->down_square == b->down_square && a->steady_N == b->steady_N &&
         a_delay_s == b_delay_s;
}

static bool is_of(const lagged_t *m, const lag_t *lag, double delay_s) {
  return m->thrust_N[0] && grid_same_motors(&m->lag, m->delay_s, lag, delay_s);
}

// Returns the motor history to be filled next. The first one is kept: it is that of the model alone, and is
// needed again and again.
static lagged_t *place_of(grid_t *g) {
  lagged_t *const first = &g->motors[0];
  const bool is_free = !first->thrust_N[0] || isnan(first->delay_s);
  lagged_t *const m = is_free ? first : &g->motors[1 + g->motors_used++ % (GRID_MOTORS - 1)];
  if (m->lent) *m = (lagged_t){.lent = false};
  return m;
}

const lagged_t *grid_motors(grid_t *g, const lag_t *commands_lag, double commands_delay_s) {
  const lag_t none = {.up_s = 0.0};
  const lag_t *const lag = g->by_speeds ? &none : commands_lag;
  const double delay_s = g->by_speeds ? 0.0 : commands_delay_s;
  for (int i = 0; i < GRID_MOTORS; i++)
    if (is_of(&g->motors[i], lag, delay_s)) return &g->motors[i];
  lagged_t *const m = place_of(g);
  const size_t n = (size_t)g->n;
  if (!m->thrust_N[0]) m->thrust_N[0] = malloc(4 * ROTORS * (n + 1) * sizeof(double));
  four_t *const room = aligned_alloc(sizeof(four_t), 2 * ((size_t)g->samples + 1) * sizeof *room);
  if (!m->thrust_N[0] || !room) {
    free(room);
    return NULL;
  }
  m->lag = *lag;
  m->delay_s = delay_s;
  for (int k = 0; k < ROTORS; k++) {
    m->thrust_N[k] = m->thrust_N[0] + (size_t)k * n;
    m->rise_Nps[k] = m->thrust_N[0] + (size_t)(ROTORS + k) * n;
    m->later_N[k] = holds_known(g) ? m->thrust_N[0] + (size_t)(2 * ROTORS + k) * n : NULL;
    m->later_rootNps[k] = m->later_N[k] ? m->later_N[k] + ROTORS * n : NULL;
  }
  const history_t h = {room, room + g->samples, delay_s * g->flight->rate_Hz};
  follow_lag(g, lag, g->flight->rows_are_means, &h);
  average(g, &h, m);
  if (m->later_N[0]) follow_lag(g, lag, true, &h);
  const bool fits = !m->later_N[0] || holds_fit(g, h.thrust_N, h.shift, m);
  free(room);
  if (!fits) m->delay_s = (double)NAN; // matches no request
  return fits ? m : NULL;
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

double grid_turns(const grid_t *g, const model_t *m, int axis, int sample) {
  const frame_t *const f = &m->frame;
  double moment_Nm = 0.0;
  for (int k = 0; k < ROTORS; k++) {
    const double arm_m[] = {f->rotor_y_m[k], -f->rotor_x_m[k], -f->rotor_spin[k] * f->torque_ratio_m};
    moment_Nm += arm_m[axis] * g->command_N[k][sample];
  }
  return moment_Nm / f->inertia_kgm2[axis];
}
