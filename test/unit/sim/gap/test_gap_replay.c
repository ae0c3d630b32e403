// test_gap_replay.c - a replay with one effect more, from the kept one, against the whole replay.
#include "exam/flights.h"
#include "gap/2_predict/predict.h"
#include "rig/test.h"

#include <stdlib.h>
#include <string.h>

typedef struct {
  gap_flight_t flight;
  model_t vehicle;
  grid_t grid;
  path_t path;
  double *room, *base[CHANNELS], *with[CHANNELS], *whole[CHANNELS];
} case_t;

static case_t *flown(void) {
  case_t *const c = calloc(1, sizeof *c);
  why_t why;
  if (!c) abort();
  CHECK_OK(exam_vehicle(&c->vehicle, &why));
  const exam_flight_t job = {.truth = &c->vehicle, .seed = 71};
  CHECK_OK(exam_fly(&job, &c->flight, &why));
  CHECK_OK(grid_make(&c->grid, &c->flight, 0, c->flight.n, &c->vehicle, &why));
  const size_t n = (size_t)c->grid.n;
  c->room = calloc(3 * CHANNELS * n, sizeof(double));
  if (!c->room) abort();
  for (size_t ch = 0; ch < CHANNELS; ch++) {
    c->base[ch] = c->room + 3 * ch * n;
    c->with[ch] = c->base[ch] + n;
    c->whole[ch] = c->with[ch] + n;
  }
  return c;
}

static void drop(case_t *c) {
  grid_free(&c->grid);
  gap_flight_free(&c->flight);
  free(c->room);
  free(c);
}

// Every effect of the table beside the model's, and in the place of the model's own.
static void compare_all(case_t *c, const model_t *m) {
  why_t why;
  const size_t bytes = (size_t)c->grid.n * sizeof(double);
  CHECK_OK(replay_keep(&c->grid, m, &c->path, c->base, &why));
  for (int i = 0; i < 2 * fx_count; i++) {
    fx_use_t more = fx_use(fx_table[i / 2]);
    if (i % 2 && more.fx->n_kind == 0) continue;
    if (i % 2) more.p[fx_use_kind(&more)] = more.fx->kind[more.fx->n_kind - 1];
    model_t with = *m;
    ROW("%d effects, %s, kind %d", m->n_fx, more.fx->name, i % 2);
    CHECK_OK(model_add_fx(&with, &more, &why));
    CHECK_OK(replay(&c->grid, &with, c->whole, &why));
    CHECK_OK(replay_with(&c->grid, &c->path, &more, c->with, &why));
    for (int ch = 0; ch < CHANNELS; ch++) CHECK(memcmp(c->with[ch], c->whole[ch], bytes) == 0);
  }
  path_free(&c->path);
}

// Which of a call's arguments is drawn first is the compiler's to choose: clang's flights were others.
TEST(exam_draws_in_one_order_whatever_compiles_it) {
  case_t *const c = flown();
  double sum[3] = {0.0};
  for (int i = 0; i < 100; i++)
    for (int k = 0; k < 3; k++) sum[k] += c->flight.v[SIG_AX + k][i];
  CHECK_NEAR(sum[0], 0.123352498, 1e-6);
  CHECK_NEAR(sum[1], -3.75141425, 1e-6);
  CHECK_NEAR(sum[2], 904.700899, 1e-6);
  drop(c);
}

// A measured curve that says 1 everywhere: nothing changes but that the vehicle's points are looked at one by
// one.
static fx_use_t one_everywhere(void) {
  fx_use_t one = fx_use(fx_find("ceiling"));
  fx_use_form(&one, curve_find("table"));
  one.points = (curve_points_t){2, {0.0, 1e6}, {1.0, 1.0}};
  return one;
}

TEST(gap_replay_with_one_effect_more_is_the_whole_replay_to_the_bit) {
  static const char *const beside[] = {"delay",  "ceiling",     "battery_sag", "wind",
                                       "ground", "rotor_drag",  "cg_offset",   "imu_misalignment",
                                       "mass",   "tof_latency", "ceiling_rpm", "inertia"};
  case_t *const c = flown();
  model_t m = c->vehicle;
  why_t why;
  const fx_use_t one = one_everywhere();
  compare_all(c, &m);
  CHECK_OK(model_add_fx(&m, &one, &why));
  compare_all(c, &m);
  m = c->vehicle;
  for (unsigned i = 0; i < sizeof beside / sizeof *beside; i++) {
    const fx_use_t use = fx_use(fx_find(beside[i]));
    CHECK_OK(model_add_fx(&m, &use, &why));
    if (i % 4 == 3) compare_all(c, &m);
  }
  for (int i = 0; i < fx_count; i++) {
    const fx_use_t use = fx_use(fx_table[i]);
    CHECK_OK(model_add_fx(&m, &use, &why)); // a model has room for all of them
  }
  compare_all(c, &m);
  drop(c);
}

// Gusts ask for the points in their order, a loss from a time on parts eight points.
TEST(gap_replay_of_eight_points_has_the_bits_of_each_alone) {
  static const struct {
    const char *name;
    int param;
    double value;
  } row[] = {{"wind", 3, 0.01}, {"motor_damage", 2, 3.003}, {"mass", 1, 2.0}, {"delay", 0, 0.013}};
  case_t *const c = flown();
  const fx_use_t one = one_everywhere();
  const int rows = sizeof row / sizeof *row;
  const int all = fx_count + rows;
  for (int k = 0; k < 2 * all; k++) {
    const int i = k % all;
    fx_use_t more = fx_use(i < fx_count ? fx_table[i] : fx_find(row[i - fx_count].name));
    if (i >= fx_count) more.p[row[i - fx_count].param] = row[i - fx_count].value;
    if (more.fx == one.fx) continue;
    ROW("%s %d, lag in speed %d", more.fx->name, i, k >= all);
    model_t with = c->vehicle, alone;
    why_t why;
    with.lag_in_speed = k >= all;
    model_drop_fx(&with, one.fx);
    CHECK_OK(model_add_fx(&with, &more, &why));
    alone = with;
    CHECK_OK(model_add_fx(&alone, &one, &why));
    CHECK_OK(replay(&c->grid, &with, c->with, &why));
    CHECK_OK(replay(&c->grid, &alone, c->whole, &why));
    for (int ch = 0; ch < CHANNELS; ch++)
      CHECK(memcmp(c->with[ch], c->whole[ch], (size_t)c->grid.n * sizeof(double)) == 0);
  }
  drop(c);
}

// Of a lag in speed of which all goes with the square of it (plant/lag.h), by many small steps.
static void follow_wave(const lag_t *lag, double omega, double rate_Hz, int n, double thrust_N[]) {
  const int steps = 500;
  const double steady = sqrt(lag->steady_N);
  double speed = sqrt(0.1);
  for (int i = 0; i < n * steps; i++) {
    if (i % steps == 0) thrust_N[i / steps] = speed * speed;
    const double u = sqrt(0.1 + 0.05 * sin(omega * i / steps / rate_Hz));
    speed += (u * u - speed * speed) / (2.0 * steady * lag->up_s) / steps / rate_Hz;
  }
}

// Rotors with a lag follow a wave that is commanded all the time and logged 50 times a second.
TEST(gap_follows_commands_along_lines_where_rows_miss_them) {
  static const struct {
    const char *what;
    double command_Hz, least, most; // rms error over the wave's amplitude
    bool squared;
  } row[] = {{"nobody said how often", 0.0, 0.0, 0.01, false},
             {"500 a second", 500.0, 0.0, 0.01, false},
             {"500 a second, followed with the square of the speed", 500.0, 0.0, 0.01, true},
             {"every command is there, and holds for 20 ms", 50.0, 0.05, 0.1, false}};
  enum { N = 400 };
  const double rate_Hz = 50.0, omega = 12.0, tau_s = 0.03;
  static double command_N[N];
  static grid_point_t point[N];
  gap_flight_t flight = {.rate_Hz = rate_Hz};
  for (int i = 0; i < N; i++) command_N[i] = 0.1 + 0.05 * sin(omega * i / rate_Hz);
  for (unsigned k = 0; k < sizeof row / sizeof *row; k++) {
    grid_t g = {.flight = &flight, .samples = N, .every = 1, .n = N, .point = point};
    ROW("%s", row[k].what);
    g.command_Hz = row[k].command_Hz;
    for (int r = 0; r < ROTORS; r++) g.command_N[r] = command_N;
    const lag_t lag = {tau_s, tau_s, row[k].squared, row[k].squared, row[k].squared, 0.08};
    static double followed_N[N];
    if (row[k].squared) follow_wave(&lag, omega, rate_Hz, N, followed_N);
    const lagged_t *const m = grid_motors(&g, &lag, 0.0);
    double sum = 0.0;
    CHECK(m != NULL);
    for (int i = N / 2; m && i < N; i++) {
      const double is = sin(omega * i / rate_Hz - atan(omega * tau_s)) / hypot(1.0, omega * tau_s);
      const double want_N = row[k].squared ? followed_N[i] : 0.1 + 0.05 * is;
      const double error = (m->thrust_N[0][i] - want_N) / 0.05;
      sum += error * error / (N - N / 2);
    }
    CHECK(sqrt(sum) >= row[k].least && sqrt(sum) <= row[k].most);
    for (int i = 0; i < GRID_MOTORS; i++) free(g.motors[i].thrust_N[0]);
  }
}
