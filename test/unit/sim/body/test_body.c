// test_body.c - six degrees of freedom in their surroundings: flight, integrators, repeatability.
#include "body/body.h"
#include "rig/turned.h"
#include "rig/vehicle6.h"
#include <string.h>

TEST(body_in_free_fall_falls_as_it_should_and_feels_nothing) {
  const model_t m = vehicle6(HUGE_VAL);
  for (int k = 0; k < 2; k++) {
    ROW("kind %d", k);
    body_start_t start = {.pos_w_m = {1.0, 2.0, 50.0}, .vel_w_mps = {0.5, -0.5, 1.0}};
    start.q_wb = turned_about(d3(1.0, 0.0, 0.0), 0.7);
    body_t b;
    if (!CHECK_OK(body_open(&b, &m, vehicle6_kinds[k], 0.002, &start))) continue;
    vehicle6_fly(&b, 0.0, 500);
    CHECK_NEAR(b.y[RIGID_POS_M], 1.5, 1e-9);
    CHECK_NEAR(b.y[RIGID_POS_M + 1], 1.5, 1e-9);
    CHECK_NEAR(b.y[RIGID_POS_M + 2], 50.0 + 1.0 - 0.5 * 9.81, 1e-9);
    CHECK_NEAR(b.y[RIGID_VEL_MPS + 2], 1.0 - 9.81, 1e-9);
    CHECK_NEAR(d3_norm(body_specific_force_b_mps2(&b)), 0.0, 1e-12);
    CHECK(body_ceiling_gap_m(&b, 0) > 1e9);
    body_close(&b);
  }
}

// The same loop on both: height and climb to thrust.
static double law_N(double z_m, double climb_mps, double t_s) {
  return WEIGHT_N * (1.0 + 6.0 * (0.44 + 0.03 * sin(2.0 * t_s) - z_m) - 2.0 * climb_mps);
}

// The vertical axis by itself: height, climb and thrust (thesis eq. A.3), by Runge-Kutta.
static void rates_of(const double y[3], double command_N, double dydt[3]) {
  const double ratio = 1.0 + 0.44 * exp(-80.0 * (0.5 - y[0])) + 0.44 * exp(-80.0 * y[0]);
  dydt[0] = y[1];
  dydt[1] = ratio * y[2] / MASS_KG - 9.81;
  dydt[2] = 16.0 * (command_N - y[2]);
}

static void move(double y[3], double command_N, double h) {
  static const double at[] = {0.0, 0.5, 0.5, 1.0}, share[] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
  double k[3] = {0.0, 0.0, 0.0}, sum[3] = {0.0, 0.0, 0.0};
  for (int stage = 0; stage < 4; stage++) {
    double x[3];
    for (int i = 0; i < 3; i++) x[i] = y[i] + at[stage] * h * k[i];
    rates_of(x, command_N, k);
    for (int i = 0; i < 3; i++) sum[i] += share[stage] * k[i];
  }
  for (int i = 0; i < 3; i++) y[i] += h * sum[i];
}

TEST(body_that_stays_level_flies_as_the_equations_of_the_vertical_axis_do) {
  for (int k = 0; k < 4; k++) {
    ROW("kind %d, held %d", k / 2, k % 2);
    model_t m = vehicle6(0.5);
    vehicle6_add(&m, "ceiling");
    vehicle6_add(&m, "ground");
    body_start_t start = vehicle6_start(&m, 0.35, 1.0);
    start.vertical_only = k % 2;
    body_t b;
    if (!CHECK_OK(body_open(&b, &m, vehicle6_kinds[k / 2], 0.002, &start))) continue;
    double apart_m = 0.0, top_m = 0.0, y[3] = {0.35, 0.0, WEIGHT_N};
    for (int t = 0; t < 5000; t++) {
      const double z_m = b.y[RIGID_POS_M + 2] + body_rotor_z_m(&m);
      apart_m = fmax(apart_m, fabs(z_m - y[0]));
      top_m = fmax(top_m, z_m);
      const double f = 0.25 * law_N(z_m, b.y[RIGID_VEL_MPS + 2], t * TICK_S);
      const double command_N[ROTORS] = {f, f, f, f};
      body_tick(&b, command_N, TICK_S);
      move(y, law_N(y[0], y[1], t * TICK_S), TICK_S);
    }
    CHECK_NEAR(apart_m, 0.0, 1e-10);
    CHECK(top_m > 0.47 && b.ceiling_contacts == 0);
    CHECK(vehicle6_tilt_rad(&b) < 1e-7);
    body_close(&b);
  }
}

TEST(body_hovers_where_it_is) {
  const model_t m = vehicle6(HUGE_VAL);
  const body_start_t start = vehicle6_start(&m, 1.0, 1.0);
  body_t b;
  if (!CHECK_OK(body_open(&b, &m, INTEGRATE_SUNDIALS, 0.002, &start))) return;
  vehicle6_fly(&b, 1.0, 5000);
  CHECK_NEAR(d3_norm(d3_sub(d3_of(b.y), start.pos_w_m)), 0.0, 1e-12);
  CHECK_NEAR(d3_norm(d3_sub(body_specific_force_b_mps2(&b), d3(0.0, 0.0, 9.81))), 0.0, 1e-12);
  body_close(&b);
}

TEST(accelerometer_feels_where_it_sits) {
  model_t m = vehicle6(HUGE_VAL);
  m.frame.imu_m[0] = 0.01;
  const body_start_t start = {.pos_w_m = {0.0, 0.0, 5.0}, .rate_b_radps = {0.0, 0.0, 3.0}};
  body_t b;
  if (!CHECK_OK(body_open(&b, &m, INTEGRATE_RK4, 0.002, &start))) return;
  const d3_t f = body_specific_force_b_mps2(&b);
  CHECK_NEAR(f.x, -9.0 * 0.01, 1e-12); // towards the axis
  CHECK_NEAR(f.z, 0.0, 1e-12);
  body_close(&b);
}

#define TICKS 5000

#define START_M 20.0
#define GAP_M   0.05

// A flight that turns about all axes, never upside down for long, in wind: down from a ceiling, slowly at
// first.
static void command(int t, double command_N[ROTORS]) {
  const double s = t * TICK_S, f = 0.985 * WEIGHT_N / 4.0;
  for (int i = 0; i < ROTORS; i++) {
    const double phase = 0.7 * i;
    command_N[i] =
        f * (1.0 - 0.05 * sin(3.0 * s) + 0.004 * sin(7.0 * s + phase) - 0.02 * sin(1.3 * s) * (i % 2));
  }
}

static model_t windy(void) {
  model_t m = vehicle6(START_M + GAP_M);
  vehicle6_add(&m, "ceiling");
  vehicle6_add(&m, "rotor_drag")->p[1] = 0.0; // above the centre of mass it makes an unstable vehicle of it
  vehicle6_add(&m, "body_drag");
  vehicle6_add(&m, "wind")->p[3] = 2e-3;
  return m;
}

static bool fly(integrate_kind_t kind, double step_s, uint64_t seed, double y[RIGID_N]) {
  const model_t m = windy();
  body_start_t start = vehicle6_start(&m, START_M, 1.0);
  start.seed = seed;
  body_t b;
  if (!CHECK_OK(body_open(&b, &m, kind, step_s, &start))) return false;
  double command_N[ROTORS], near_s = 0.0;
  for (int t = 0; t < TICKS; t++) {
    command(t, command_N);
    body_tick(&b, command_N, TICK_S);
    near_s += body_thrust_ratio(&b, 0) > 1.005 ? TICK_S : 0.0;
  }
  CHECK(near_s > 0.2 && b.ceiling_contacts == 0);
  memcpy(y, b.y, sizeof b.y);
  body_close(&b);
  return true;
}

TEST(body_flies_the_same_way_through_both_integrators) {
  double y[3][RIGID_N];
  for (int k = 0; k < 2; k++)
    if (!fly(vehicle6_kinds[k], 0.002, 1, y[k])) return;
  if (!fly(INTEGRATE_REFERENCE, 0.002, 1, y[2])) return;
  CHECK_NEAR(d3_norm(d3_sub(d3_of(y[0]), d3_of(y[1]))), 0.0, 1e-9);
  CHECK_NEAR(d3_norm(d3_sub(d3_of(y[0]), d3_of(y[2]))), 0.0, 1e-6); // what 2 ms steps cost, over 10 s
  CHECK(d3_norm(d3_of(y[0])) > 1.0 && fabs(y[0][RIGID_Q_WB]) < 0.9999);
}

TEST(the_same_seed_gives_the_same_bits_and_another_does_not) {
  double y[3][RIGID_N];
  if (!fly(INTEGRATE_SUNDIALS, 0.002, 5, y[0]) || !fly(INTEGRATE_SUNDIALS, 0.002, 5, y[1])) return;
  if (!fly(INTEGRATE_SUNDIALS, 0.002, 6, y[2])) return;
  CHECK(memcmp(y[0], y[1], sizeof y[0]) == 0);
  CHECK(memcmp(y[0], y[2], sizeof y[0]) != 0);
}

TEST(two_vehicles_in_one_process_do_not_influence_each_other) {
  const model_t m = windy();
  static body_t b[2];
  double command_N[ROTORS], alone[2][RIGID_N];
  for (int k = 0; k < 2; k++) {
    if (!fly(vehicle6_kinds[k], 0.002, (uint64_t)k + 1, alone[k])) return;
    body_start_t start = vehicle6_start(&m, START_M, 1.0);
    start.seed = (uint64_t)k + 1;
    if (!CHECK_OK(body_open(&b[k], &m, vehicle6_kinds[k], 0.002, &start))) return;
  }
  for (int t = 0; t < TICKS; t++)
    for (int k = 0; k < 2; k++) {
      command(t, command_N);
      body_tick(&b[k], command_N, TICK_S);
    }
  for (int k = 0; k < 2; k++) {
    CHECK(memcmp(b[k].y, alone[k], sizeof alone[k]) == 0);
    body_close(&b[k]);
  }
}

TEST(body_refuses_a_model_that_cannot_fly) {
  const body_start_t start = {.pos_w_m = {0.0, 0.0, 1.0}};
  body_t b;
  for (int i = 0; i < 4; i++) {
    ROW("%d", i);
    model_t m = vehicle6(HUGE_VAL);
    if (i == 0) m.frame.inertia_kgm2[1] = 0.0;
    if (i == 1) m.mass_kg = (double)NAN;
    if (i == 2) m.frame.kf_Ns2 = 0.0;
    CHECK_STATUS(BAD_INPUT, body_open(&b, &m, INTEGRATE_RK4, i == 3 ? 0.0 : 0.002, &start));
    CHECK(b.integrate == NULL && b.random == NULL);
  }
}
