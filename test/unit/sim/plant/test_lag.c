// test_lag.c - how a rotor follows its command: in the plant by its integrator, and in a replay row by row.
#include "gap/2_predict/grid.h"
#include "rig/vehicle6.h"

#include <stdlib.h>

typedef struct {
  const char *what;
  double tau_s, down_over_up;
  bool in_speed;
  double square[2]; // up, down
} kind_t;

static const kind_t KIND[] = {
    {"in thrust", 0.05, 1.0, false, {0.0, 0.0}},
    {"in thrust, slower down", 0.05, 1.6, false, {0.0, 0.0}},
    {"in speed", 0.05, 1.0, true, {0.0, 0.0}},
    {"in speed, faster down", 0.05, 0.5, true, {0.0, 0.0}},
    {"in speed, down by its square", 0.05, 0.8, true, {0.0, 1.0}},
    {"in speed, part of it by its square", 0.05, 1.0, true, {0.7, 0.3}},
    {"none that is there", 0.0, 1.0, true, {0.0, 1.0}},
};
#define KINDS (sizeof KIND / sizeof *KIND)

#define STEADY_N (0.25 * WEIGHT_N) // of a rotor

static bool is_squared(const kind_t *k) {
  return k->square[0] + k->square[1] > 0.0;
}

// By many small steps of dOm/dt = a (u - Om) + b (u^2 - Om^2), in roots of thrusts.
static double after_squared_N(const kind_t *k, double from_N, double to_N, double t_s) {
  const bool up = to_N > from_N;
  const double u = sqrt(to_N), tau_s = up ? k->tau_s : k->tau_s * k->down_over_up, q = k->square[up ? 0 : 1];
  const double a = (1.0 - q) / tau_s, b = q / (2.0 * sqrt(STEADY_N) * tau_s);
  const int steps = 20000;
  double speed = sqrt(from_N);
  for (int i = 0; i < steps; i++) {
    const double h = t_s / steps, now = a * (u - speed) + b * (u * u - speed * speed);
    const double half = speed + 0.5 * h * now;
    speed += h * (a * (u - half) + b * (u * u - half * half));
  }
  return speed * speed;
}

// The thrust t_s after a step.
static double after_N(const kind_t *k, double from_N, double to_N, double t_s) {
  if (!(k->tau_s > 0.0)) return to_N;
  if (is_squared(k)) return after_squared_N(k, from_N, to_N, t_s);
  const double gone = exp(-t_s / (to_N > from_N ? k->tau_s : k->tau_s * k->down_over_up));
  if (!k->in_speed) return to_N + gone * (from_N - to_N);
  const double speed = sqrt(to_N) + gone * (sqrt(from_N) - sqrt(to_N));
  return speed * speed;
}

static model_t with_lag(const kind_t *k) {
  model_t m = vehicle6(HUGE_VAL);
  m.motor_tau_s = k->tau_s;
  m.motor_down_over_up = k->down_over_up;
  m.lag_in_speed = k->in_speed;
  for (int i = 0; i < 2; i++) m.lag_square[i] = k->square[i];
  return m;
}

TEST(rotors_follow_a_step_up_and_down_as_their_lag_says) {
  for (size_t i = 0; i < KINDS; i++)
    for (int kind = 0; kind < 2; kind++) {
      ROW("%s, integrator %d", KIND[i].what, kind);
      const model_t m = with_lag(&KIND[i]);
      const body_start_t start = vehicle6_start(&m, 5.0, 1.0);
      const double hover_N = 0.25 * WEIGHT_N;
      body_t b;
      if (!CHECK_OK(body_open(&b, &m, vehicle6_kinds[kind], 0.001, &start))) continue;
      vehicle6_fly(&b, 1.5, 20);
      const double up_N = after_N(&KIND[i], hover_N, 1.5 * hover_N, 20 * TICK_S);
      CHECK_NEAR(b.y[RIGID_THRUST_N], up_N, 1e-6 * hover_N);
      vehicle6_fly(&b, 0.4, 20);
      CHECK_NEAR(b.y[RIGID_THRUST_N], after_N(&KIND[i], up_N, 0.4 * hover_N, 20 * TICK_S), 1e-6 * hover_N);
      body_close(&b);
    }
}

TEST(a_rotor_that_stands_starts_and_one_that_stops_does_not_turn_back) {
  const model_t m = with_lag(&(kind_t){"", 0.05, 1.0, true, {0.0, 0.0}});
  const body_start_t start = vehicle6_start(&m, 5.0, 0.0);
  body_t b;
  if (!CHECK_OK(body_open(&b, &m, INTEGRATE_RK4, 0.001, &start))) return;
  vehicle6_fly(&b, 1.0, 250);
  CHECK_NEAR(b.y[RIGID_THRUST_N], 0.25 * WEIGHT_N, 1e-3 * WEIGHT_N);
  vehicle6_fly(&b, 0.0, 250);
  CHECK_NEAR(b.y[RIGID_THRUST_N], 0.0, 1e-6 * WEIGHT_N); // a step may go past 0 by that
  body_close(&b);
}

// --- in a replay: ten rows before a step of the command, ten after ----------------------------------------

#define ROWS    20
#define STEP_AT 10
#define ROW_S   0.01

typedef struct {
  double from_N, to_N;
} step_t;
static const step_t UP = {0.05, 0.09}, DOWN = {0.09, 0.05};

static void replay_step(const kind_t *k, step_t step, bool means, bool by_speeds, double delay_s,
                        double thrust_N[ROWS]) {
  gap_flight_t flight = {.rate_Hz = 1.0 / ROW_S, .rows_are_means = means};
  grid_point_t point[ROWS] = {{.t_s = 0.0}};
  double command_N[ROWS];
  grid_t g = {.flight = &flight, .samples = ROWS, .every = 1, .period_s = ROW_S, .n = ROWS, .point = point};
  g.command_Hz = 1.0 / ROW_S; // every command is there
  g.by_speeds = by_speeds;
  for (int i = 0; i < ROWS; i++) command_N[i] = i < STEP_AT ? step.from_N : step.to_N;
  for (int r = 0; r < ROTORS; r++) g.command_N[r] = command_N;
  const lag_t lag = {k->tau_s, k->tau_s * k->down_over_up, k->in_speed, k->square[0], k->square[1], STEADY_N};
  const lagged_t *const m = grid_motors(&g, &lag, delay_s);
  for (int i = 0; CHECK(m != NULL) && i < ROWS; i++) thrust_N[i] = m->thrust_N[2][i];
  free(g.motors[0].thrust_N[0]);
}

// By hand, in small steps over the hold of a row.
static double mean_N(const kind_t *k, step_t step, int row) {
  double sum = 0.0;
  if (row < STEP_AT) return step.from_N;
  const int parts = is_squared(k) ? 100 : 1000; // of which each takes small steps
  for (int i = 0; i < parts; i++)
    sum += after_N(k, step.from_N, step.to_N, (row - STEP_AT + (i + 0.5) / parts) * ROW_S);
  return sum / parts;
}

TEST(a_row_that_is_an_instant_has_the_thrust_before_its_command_and_a_mean_that_of_its_hold) {
  for (size_t i = 0; i < 2 * KINDS; i++) {
    const kind_t *const kind = &KIND[i % KINDS];
    const step_t step = i < KINDS ? UP : DOWN;
    double thrust_N[ROWS] = {0.0};
    replay_step(kind, step, false, false, 0.0, thrust_N);
    for (int row = 0; row < ROWS; row++) {
      ROW("%s, to %g N, instant %d", kind->what, step.to_N, row);
      const double t_s = (row - STEP_AT) * ROW_S;
      const double want_N = row < STEP_AT ? step.from_N : after_N(kind, step.from_N, step.to_N, t_s);
      CHECK_NEAR(thrust_N[row], want_N, is_squared(kind) ? 1e-10 : 1e-12); // by small steps
    }
    replay_step(kind, step, true, false, 0.0, thrust_N);
    for (int row = 0; row < ROWS; row++) {
      ROW("%s, to %g N, mean %d", kind->what, step.to_N, row);
      CHECK_NEAR(thrust_N[row], mean_N(kind, step, row), is_squared(kind) ? 1e-6 : 1e-7);
    }
  }
}

// Of a log with rotor speeds alone a lag of the file was taken once more, and told as motor_lag.
TEST(rotor_speeds_that_were_measured_have_their_lag_and_delay_behind_them) {
  for (size_t i = 0; i < KINDS; i++) {
    double thrust_N[ROWS] = {0.0};
    replay_step(&KIND[i], UP, false, true, 0.02, thrust_N);
    for (int row = 0; row < ROWS; row++) {
      ROW("%s, instant %d", KIND[i].what, row);
      CHECK(thrust_N[row] == (row < STEP_AT ? 0.05 : 0.09));
    }
  }
}

TEST(a_delay_and_a_late_log_move_the_thrust_by_whole_rows_and_parts) {
  static const struct {
    double delay_s;
    int rows; // later
  } row[] = {{0.0, 0}, {0.02, 2}, {-0.02, -2}};
  double none_N[ROWS] = {0.0}, moved_N[ROWS] = {0.0};
  replay_step(&KIND[2], UP, false, false, 0.0, none_N);
  for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
    replay_step(&KIND[2], UP, false, false, row[i].delay_s, moved_N);
    for (int k = 3; k < ROWS - 3; k++) {
      ROW("delay %g s, row %d", row[i].delay_s, k);
      CHECK_NEAR(moved_N[k], none_N[k - row[i].rows], 1e-12);
    }
  }
  replay_step(&KIND[2], UP, false, false, 0.005, moved_N);
  CHECK_NEAR(moved_N[12], 0.5 * (none_N[11] + none_N[12]), 1e-12);
}
