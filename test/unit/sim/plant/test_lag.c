// test_lag.c - how a rotor follows its command: in the plant by its integrator, and in a replay row by row.
#include "gap/2_predict/grid.h"
#include "rig/vehicle6.h"

#include <stdlib.h>

typedef struct {
  const char *what;
  double tau_s, down_over_up;
  bool in_speed;
} kind_t;

static const kind_t KIND[] = {
    {"in thrust", 0.05, 1.0, false},        {"in thrust, slower down", 0.05, 1.6, false},
    {"in speed", 0.05, 1.0, true},          {"in speed, faster down", 0.05, 0.5, true},
    {"none that is there", 0.0, 1.0, true},
};
#define KINDS (sizeof KIND / sizeof *KIND)

// The thrust t_s after a step, in closed form.
static double after_N(const kind_t *k, double from_N, double to_N, double t_s) {
  if (!(k->tau_s > 0.0)) return to_N;
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
  const model_t m = with_lag(&(kind_t){"", 0.05, 1.0, true});
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

static void replay_step(const kind_t *k, bool means, bool by_speeds, double delay_s, double thrust_N[ROWS]) {
  gap_flight_t flight = {.rate_Hz = 1.0 / ROW_S, .rows_are_means = means};
  grid_point_t point[ROWS] = {{.t_s = 0.0}};
  double command_N[ROWS];
  grid_t g = {.flight = &flight, .samples = ROWS, .every = 1, .period_s = ROW_S, .n = ROWS, .point = point};
  g.command_Hz = 1.0 / ROW_S; // every command is there
  g.by_speeds = by_speeds;
  for (int i = 0; i < ROWS; i++) command_N[i] = i < STEP_AT ? 0.05 : 0.09;
  for (int r = 0; r < ROTORS; r++) g.command_N[r] = command_N;
  const lag_t lag = {k->tau_s, k->tau_s * k->down_over_up, k->in_speed};
  const lagged_t *const m = grid_motors(&g, &lag, delay_s);
  for (int i = 0; CHECK(m != NULL) && i < ROWS; i++) thrust_N[i] = m->thrust_N[2][i];
  free(g.motors[0].thrust_N[0]);
}

// By hand, in small steps over the hold of a row.
static double mean_N(const kind_t *k, int row) {
  double sum = 0.0;
  for (int i = 0; i < 1000; i++)
    sum += row < STEP_AT ? 0.05 : after_N(k, 0.05, 0.09, (row - STEP_AT + (i + 0.5) / 1000.0) * ROW_S);
  return sum / 1000.0;
}

TEST(a_row_that_is_an_instant_has_the_thrust_before_its_command_and_a_mean_that_of_its_hold) {
  for (size_t i = 0; i < KINDS; i++) {
    double thrust_N[ROWS] = {0.0};
    replay_step(&KIND[i], false, false, 0.0, thrust_N);
    for (int row = 0; row < ROWS; row++) {
      ROW("%s, instant %d", KIND[i].what, row);
      const double t_s = (row - STEP_AT) * ROW_S;
      CHECK_NEAR(thrust_N[row], row < STEP_AT ? 0.05 : after_N(&KIND[i], 0.05, 0.09, t_s), 1e-12);
    }
    replay_step(&KIND[i], true, false, 0.0, thrust_N);
    for (int row = 0; row < ROWS; row++) {
      ROW("%s, mean %d", KIND[i].what, row);
      CHECK_NEAR(thrust_N[row], mean_N(&KIND[i], row), 1e-7);
    }
  }
}

// Of a log with rotor speeds alone a lag of the file was taken once more, and told as motor_lag.
TEST(rotor_speeds_that_were_measured_have_their_lag_and_delay_behind_them) {
  for (size_t i = 0; i < KINDS; i++) {
    double thrust_N[ROWS] = {0.0};
    replay_step(&KIND[i], false, true, 0.02, thrust_N);
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
  replay_step(&KIND[2], false, false, 0.0, none_N);
  for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
    replay_step(&KIND[2], false, false, row[i].delay_s, moved_N);
    for (int k = 3; k < ROWS - 3; k++) {
      ROW("delay %g s, row %d", row[i].delay_s, k);
      CHECK_NEAR(moved_N[k], none_N[k - row[i].rows], 1e-12);
    }
  }
  replay_step(&KIND[2], false, false, 0.005, moved_N);
  CHECK_NEAR(moved_N[12], 0.5 * (none_N[11] + none_N[12]), 1e-12);
}
