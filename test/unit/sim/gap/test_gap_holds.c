// test_gap_holds.c - turning as differences of rates show it, of rotors that follow within a row or later.
#include "gap/2_predict/lines.h"
#include "gap/2_predict/residual.h"
#include "rig/splitmix.h"
#include "rig/test.h"
#include "vehicle/model_file.h"

#include <math.h>
#include <stdlib.h>

#define MOST   4000
#define FINE_S 2e-5
#define SPAN_S 8.0
#define ROLL_N 0.002 // about what a rotor gives in a hover

static double v[SIG_COUNT][MOST], t_s[MOST];

// A roll by commands that jump from row to row, integrated finely; rows are instants, before the command
// acts.
static void roll(gap_flight_t *f, const model_t *m, double rate_Hz) {
  splitmix_t draw = {7};
  double thrust_N = 0.0, radps = 0.0;
  *f = (gap_flight_t){.n = (int)(SPAN_S * rate_Hz), .rate_Hz = rate_Hz, .command_Hz = rate_Hz, .t_s = t_s};
  for (int i = SIG_GX; i <= SIG_GZ; i++) f->v[i] = v[i];
  for (int i = SIG_F1; i <= SIG_F4; i++) f->v[i] = v[i];
  const double hover_N = 0.25 * m->mass_kg * G_MPS2;
  for (int i = 0; i < f->n; i++) {
    const double more_N = splitmix_normal(&draw, ROLL_N) - 0.1 * m->frame.inertia_kgm2[0] * radps;
    if (i == 0) thrust_N = more_N; // it was there long enough
    t_s[i] = i / rate_Hz;
    v[SIG_GX][i] = radps;
    for (int k = 0; k < ROTORS; k++)
      v[SIG_F1 + k][i] = hover_N + (m->frame.rotor_y_m[k] > 0.0 ? more_N : -more_N);
    const int steps = (int)round(1.0 / (rate_Hz * FINE_S));
    const double keep = m->motor_tau_s > 0.0 ? exp(-1.0 / (rate_Hz * steps * m->motor_tau_s)) : 0.0;
    for (int k = 0; k < steps; k++) {
      const double now_N = more_N + keep * (thrust_N - more_N);
      radps += 0.5 * (m->motor_tau_s > 0.0 ? thrust_N + now_N : 2.0 * more_N) * ROTORS *
               fabs(m->frame.rotor_y_m[0]) / m->frame.inertia_kgm2[0] / (rate_Hz * steps);
      thrust_N = now_N;
    }
  }
}

// Rms of what is left of the turning, over the turning's.
static double left_of(const gap_flight_t *f, const model_t *m) {
  grid_t *const grid = calloc(1, sizeof *grid);
  set_t set;
  why_t why;
  lines_t left = {.r = {NULL}}, measured = {.r = {NULL}};
  double sum = 0.0, all = 0.0;
  if (!grid) abort();
  CHECK_OK(grid_make(grid, f, 0, f->n, m, &why));
  grid->command_Hz = f->command_Hz;
  CHECK_OK(set_make(&set, grid, 1, &why));
  CHECK_OK(lines_make(&left, &set, &why));
  CHECK_OK(lines_make(&measured, &set, &why));
  CHECK_OK(residual_of(&set, m, left.r, &why));
  CHECK_OK(residual_measured(&set, measured.r, &why));
  CHECK(set.smooth.n > 100);
  for (int i = 0; i < set.smooth.n; i++) {
    sum += left.r[CH_WX][i] * left.r[CH_WX][i];
    all += measured.r[CH_WX][i] * measured.r[CH_WX][i];
  }
  lines_free(&left);
  lines_free(&measured);
  set_free(&set);
  return sqrt(sum / all);
}

TEST(gap_turning_is_that_of_commands_that_hold_whatever_the_lag) {
  static const struct {
    double rate_Hz, tau_s, most;
  } rows[] = {
      {50.0, 0.0, 1e-5},   {100.0, 0.0, 1e-5},  {125.0, 0.0, 1e-5},   {150.0, 0.0, 1e-5},
      {240.0, 0.0, 1e-5},  {50.0, 0.005, 1e-4}, {100.0, 0.005, 1e-4}, {100.0, 0.03, 1e-4},
      {100.0, 0.09, 1e-4}, {200.0, 0.04, 1e-4}, {100.0, 0.11, 0.02},  {500.0, 0.03, 0.02},
  };
  model_t m;
  why_t why;
  CHECK_OK(model_builtin("cf21_legacy", &m, &why));
  m.n_fx = 0;
  m.frame.rotor_inertia_kgm2 = 0.0;
  m.frame.motor_delay_s = 0.0;
  m.motor_down_over_up = 0.0;
  m.lag_in_speed = false;
  for (unsigned i = 0; i < sizeof rows / sizeof *rows; i++) {
    gap_flight_t flight;
    ROW("%g Hz, lag %g s", rows[i].rate_Hz, rows[i].tau_s);
    m.motor_tau_s = rows[i].tau_s;
    roll(&flight, &m, rows[i].rate_Hz);
    const double left = left_of(&flight, &m);
    CHECK_NEAR(left, 0.0, rows[i].most);
  }
}
