// test_gap_holds.c - turning as differences of rates show it, of rotors that follow within a row or later.
#include "gap/2_predict/lines.h"
#include "gap/2_predict/predict.h"
#include "gap/2_predict/residual.h"
#include "rig/splitmix.h"
#include "rig/test.h"
#include "vehicle/model_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MOST   4000
#define FINE_S 2e-5
#define SPAN_S 8.0
#define JUMP_N 0.002 // of each command, for roll and for yaw

typedef struct {
  const char *what;
  double rate_Hz, tau_s, delay_s, rotor_inertia_kgm2;
  bool split;  // by a gap in time, in the middle
  double most; // rms that is left, over that of the turning
} case_t;

// No more than is logged: the test of long logs counts what all tests keep.
static double rate_radps[3][MOST], thrust_N[ROTORS][MOST], t_s[MOST];
static int segment[MOST];

static void command(const model_t *m, double roll_N, double yaw_N, double to_N[ROTORS]) {
  for (int k = 0; k < ROTORS; k++)
    to_N[k] = 0.25 * m->mass_kg * G_MPS2 + copysign(roll_N, m->frame.rotor_y_m[k]) -
              copysign(yaw_N, m->frame.rotor_spin[k]);
}

// The rates after a short while of commands that hold; rotors lag in thrust.
static void turn(const model_t *m, const double to_N[ROTORS], double keep, double span_s,
                 double now_N[ROTORS], double radps[3]) {
  const frame_t *const f = &m->frame;
  for (int k = 0; k < ROTORS; k++) {
    const double end_N = to_N[k] + keep * (now_N[k] - to_N[k]);
    const double mean_N = keep > 0.0 ? 0.5 * (now_N[k] + end_N) : to_N[k];
    const double spin_up = f->rotor_inertia_kgm2 * (sqrt(end_N / f->kf_Ns2) - sqrt(now_N[k] / f->kf_Ns2));
    radps[0] += f->rotor_y_m[k] * mean_N * span_s / f->inertia_kgm2[0];
    radps[2] -= f->rotor_spin[k] * (f->torque_ratio_m * mean_N * span_s + spin_up) / f->inertia_kgm2[2];
    now_N[k] = end_N;
  }
}

// Commands that jump from row to row, finely integrated; rows are instants, before the command acts. What is
// commanded reaches the rotors `late` rows later.
static void fly(gap_flight_t *f, const model_t *m, const case_t *c) {
  const int late = (int)lround(c->delay_s * c->rate_Hz), steps = (int)lround(1.0 / (c->rate_Hz * FINE_S));
  const double span_s = 1.0 / (c->rate_Hz * steps), keep = c->tau_s > 0.0 ? exp(-span_s / c->tau_s) : 0.0;
  splitmix_t draw = {7};
  double now_N[ROTORS], radps[3] = {0.0};
  *f = (gap_flight_t){.n = (int)(SPAN_S * c->rate_Hz),
                      .rate_Hz = c->rate_Hz,
                      .command_Hz = c->rate_Hz,
                      .t_s = t_s,
                      .segment = segment};
  for (int k = 0; k < 3; k++) f->v[SIG_GX + k] = rate_radps[k];
  for (int k = 0; k < ROTORS; k++) f->v[SIG_F1 + k] = thrust_N[k];
  for (int i = 0; i < f->n; i++) {
    double told_N[ROTORS], to_N[ROTORS];
    segment[i] = c->split && i >= f->n / 2;
    t_s[i] = i / c->rate_Hz + segment[i];
    if (i == 0 || (c->split && i == f->n / 2)) memset(radps, 0, sizeof radps);
    command(m, splitmix_normal(&draw, JUMP_N), splitmix_normal(&draw, JUMP_N), told_N);
    for (int k = 0; k < ROTORS; k++) {
      const int from = i - late < 0 ? 0 : i - late;
      thrust_N[k][i] = told_N[k];
      to_N[k] = segment[from] == segment[i] ? thrust_N[k][from] : thrust_N[k][f->n / 2];
      if (i == 0 || segment[i] != segment[i - 1]) now_N[k] = to_N[k]; // it was there long enough
    }
    for (int k = 0; k < 3; k++) rate_radps[k][i] = radps[k];
    for (int k = 0; k < steps; k++) turn(m, to_N, keep, span_s, now_N, radps);
  }
}

// Rms of what is left of the turning about an axis, over the turning's.
static double left_of(set_t *set, const model_t *m, int ch) {
  why_t why;
  lines_t left = {.r = {NULL}}, measured = {.r = {NULL}};
  double sum = 0.0, all = 0.0;
  CHECK_OK(lines_make(&left, set, &why));
  CHECK_OK(lines_make(&measured, set, &why));
  CHECK_OK(residual_of(set, m, left.r, &why));
  CHECK_OK(residual_measured(set, measured.r, &why));
  CHECK(set->smooth.n > 100);
  for (int i = 0; i < set->smooth.n; i++) {
    sum += left.r[ch][i] * left.r[ch][i];
    all += measured.r[ch][i] * measured.r[ch][i];
  }
  lines_free(&left);
  lines_free(&measured);
  return sqrt(sum / all);
}

static model_t vehicle_of(const case_t *c) {
  model_t m;
  why_t why;
  CHECK_OK(model_builtin("cf21_legacy", &m, &why));
  m.n_fx = 0;
  m.motor_tau_s = c->tau_s;
  m.motor_down_over_up = 0.0;
  m.lag_in_speed = false;
  m.frame.rotor_inertia_kgm2 = c->rotor_inertia_kgm2;
  m.frame.motor_delay_s = c->delay_s;
  return m;
}

static void open_set(set_t *set, const case_t *c, const model_t *m, gap_flight_t *flight) {
  why_t why;
  grid_t *const grid = calloc(1, sizeof *grid);
  if (!grid) abort();
  fly(flight, m, c);
  CHECK_OK(grid_make(grid, flight, 0, flight->n, m, &why));
  CHECK_OK(set_make(set, grid, 1, &why));
}

TEST(gap_turning_is_that_of_commands_that_hold_whatever_the_lag) {
  static const case_t cases[] = {
      {"no lag, 50 Hz", 50.0, 0.0, 0.0, 0.0, false, 1e-5},
      {"no lag, 125 Hz", 125.0, 0.0, 0.0, 0.0, false, 1e-5},
      {"no lag, 240 Hz", 240.0, 0.0, 0.0, 0.0, false, 1e-5},
      {"half a row", 100.0, 0.005, 0.0, 0.0, false, 1e-4},
      {"nine rows", 100.0, 0.09, 0.0, 0.0, false, 1e-4},
      {"nine rows of 500 Hz", 500.0, 0.018, 0.0, 0.0, false, 1e-4},
      {"eleven rows", 100.0, 0.11, 0.0, 0.0, false, 1e-4},
      {"eleven rows of 500 Hz", 500.0, 0.022, 0.0, 0.0, false, 1e-4},
      {"a delay", 100.0, 0.0, 0.02, 0.0, false, 1e-5},
      {"a delay, and a lag of a row", 100.0, 0.01, 0.02, 0.0, false, 1e-3},
      {"a gap in time", 125.0, 0.005, 0.0, 0.0, true, 1e-4},
      {"a gap in time, and a delay", 100.0, 0.0, 0.02, 0.0, true, 1e-5},
      {"heavy rotors, a lag of a row", 100.0, 0.01, 0.0, 3e-8, false, 1e-4},
      {"heavy rotors, a lag of six rows", 100.0, 0.06, 0.0, 3e-8, false, 1e-4},
      {"heavy rotors, eleven rows of 500 Hz", 500.0, 0.022, 0.0, 3e-8, false, 1e-4},
      {"heavy rotors, thirty rows of 500 Hz", 500.0, 0.06, 0.0, 3e-8, false, 1e-4},
  };
  for (unsigned i = 0; i < sizeof cases / sizeof *cases; i++) {
    const model_t m = vehicle_of(&cases[i]);
    gap_flight_t flight;
    set_t set;
    open_set(&set, &cases[i], &m, &flight);
    for (int ch = CH_WX; ch <= CH_WZ; ch += 2) {
      ROW("%s, %s", cases[i].what, gap_channel[ch]);
      CHECK_NEAR(left_of(&set, &m, ch), 0.0, cases[i].most);
    }
    set_free(&set);
  }
}

// However it is replayed: alone, from a kept one, with an effect that ticks.
TEST(gap_a_sensors_effect_leaves_the_turning_of_commands_that_hold) {
  static const case_t held = {"", 100.0, 0.005, 0.0, 0.0, false, 0.0};
  static const char *const ticks[] = {"battery_sag", "motor_damage", "thrust_curve", "ceiling"};
  for (unsigned i = 0; i < sizeof ticks / sizeof *ticks; i++) {
    ROW("%s", ticks[i]);
    model_t m = vehicle_of(&held);
    gap_flight_t flight;
    set_t set;
    path_t path;
    why_t why;
    fx_use_t use = fx_use(fx_find(ticks[i])), bias = fx_use(fx_find("accel_bias"));
    if (use.fx == fx_find("motor_damage")) use.p[2] = 3.0; // it begins in flight
    m.ceiling_m = 2.0;
    CHECK_OK(model_add_fx(&m, &use, &why));
    open_set(&set, &held, &m, &flight);
    const size_t n = (size_t)set.grid[0].n, bytes = n * sizeof(double);
    double *const room = calloc(2 * CHANNELS * n, sizeof *room), *base[CHANNELS], *with[CHANNELS];
    if (!room) abort();
    for (size_t ch = 0; ch < CHANNELS; ch++) base[ch] = room + ch * n, with[ch] = room + (CHANNELS + ch) * n;
    CHECK_OK(replay_keep(&set.grid[0], &m, &path, base, &why));
    CHECK_OK(replay_with(&set.grid[0], &path, &bias, with, &why));
    for (int ch = CH_WX; ch <= CH_WZ; ch++) CHECK(memcmp(base[ch], with[ch], bytes) == 0);
    path_free(&path);
    free(room);
    set_free(&set);
  }
}
