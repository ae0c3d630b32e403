// test_effects.c - the published curves at points that are known, and what every curve must be.
#include "effects/fx.h"
#include "model.h"
#include "test.h"
#include "vehicle6.h"

#include <string.h>

static double ratio_of(const char *form, double distance_over_radius) {
  const curve_t *curve = curve_find(form);
  if (!CHECK(curve != NULL)) return (double)NAN;
  double p[FX_PARAM_MAX];
  for (int i = 0; i < curve->n_param; i++) p[i] = curve->param[i].nominal;
  const curve_points_t points = {.n = 3, .x = {0.1, 0.5, 1.0}, .ratio = {4.37, 1.21, 1.0}};
  return curve->ratio(p, &points, 0.0225 * distance_over_radius, 0.0225);
}

TEST(curves_have_their_published_values) {
  static const struct {
    const char *form;
    double distance_over_radius, ratio, tol;
  } row[] = {
      // thesis: "10 % at 2 cm", below 5 % at 7 and 10 cm; errata E2
      {"exponential", 0.02 / 0.0225, 1.0888, 5e-5},
      {"exponential", 0.07 / 0.0225, 1.00163, 5e-6},
      {"exponential", 0.10 / 0.0225, 1.00015, 5e-6},
      {"exponential", 0.0, 1.44, 1e-12},
      // errata E2: eq. 1 at 2 and 3 cm
      {"cheeseman-bennett", 0.02 / 0.0225, 1.0859, 5e-5},
      {"cheeseman-bennett", 0.03 / 0.0225, 1.0364, 5e-5},
      {"cheeseman-bennett", 0.5, 1.3333, 5e-5},
      {"cheeseman-bennett", 0.25, 1.6, 1e-12}, // singular: the clip
      {"cheeseman-bennett", 0.0, 1.6, 1e-12},
      {"square-root", 0.1, 2.337, 5e-4},
      {"square-root", 0.25, 1.366, 5e-4},
      {"square-root", 0.5, 1.112, 5e-4},
      {"square-root", 1.0, 1.030, 5e-4},
      {"square-root", 2.0, 1.0078, 5e-5},
      {"square-root", 0.0, 2.337, 5e-4}, // not measured nearer than 0.1 R
      {"linear", 0.0, 1.1651, 1e-12},
      {"linear", 2.0, 1.0905, 1e-12},
      {"linear", 4.42, 1.0, 3e-4},
      {"linear", 9.0, 1.0, 1e-12},
      {"table", 0.05, 4.37, 1e-12},
      {"table", 0.3, 2.79, 1e-12},
      {"table", 0.75, 1.105, 1e-12},
      {"table", 7.0, 1.0, 1e-12},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s at %g R", row[i].form, row[i].distance_over_radius);
    CHECK_NEAR(ratio_of(row[i].form, row[i].distance_over_radius), row[i].ratio, row[i].tol);
  }
}

TEST(four_rotors_feel_the_ground_more_than_one_and_from_farther) {
  // thesis eq. 3.3 with all but the first image removed is eq. 3.1.
  const curve_t *curve = curve_find("four-rotor");
  if (!CHECK(curve != NULL)) return;
  const double far_apart[] = {1e6, 1e6, 0.0, 1.6}, crazyflie[] = {0.065, 0.092, 2.0, 1.6};
  for (int i = 1; i <= 8; i++) {
    ROW("%d R", i);
    const double d_m = 0.0225 * i;
    CHECK_NEAR(curve->ratio(far_apart, NULL, d_m, 0.0225), ratio_of("cheeseman-bennett", i), 1e-12);
    CHECK(curve->ratio(crazyflie, NULL, d_m, 0.0225) > ratio_of("cheeseman-bennett", i));
  }
  // By hand at z = R = 0.12 m, d = 0.35, b = 0.495, Kb = 2: 1/(1 - 1/16 - 0.0217 - 0.0048 - 0.0469).
  const double big[] = {0.35, 0.495, 2.0, 5.0}, R = 0.12, z = 0.12;
  const double want = 1.0 / (1.0 - 0.0625 - R * R * z / pow(0.35 * 0.35 + 4 * z * z, 1.5) -
                             R * R / 2 * z / pow(2 * 0.35 * 0.35 + 4 * z * z, 1.5) -
                             2 * R * R * z / pow(0.495 * 0.495 + 4 * z * z, 1.5) * 2.0);
  CHECK_NEAR(curve->ratio(big, NULL, z, R), want, 1e-12);
}

TEST(every_curve_is_finite_falls_with_distance_and_ends_at_one) {
  for (int c = 0; c < curve_count; c++) {
    ROW("%s", curve_table[c]->name);
    double before = (double)INFINITY;
    for (double x = 0.0; x < 60.0; x = x * 1.05 + 1e-3) {
      const double ratio = ratio_of(curve_table[c]->name, x);
      CHECK(isfinite(ratio) && ratio >= 1.0 && ratio <= before + 1e-12);
      before = ratio;
    }
    CHECK_NEAR(before, 1.0, 3e-4); // at 60 R; the four rotors are felt from farthest
    CHECK_NEAR(ratio_of(curve_table[c]->name, (double)INFINITY), 1.0, 1e-9); // no such surface
  }
}

TEST(every_effect_and_curve_is_described_and_within_its_ranges) {
  CHECK(fx_count >= 2);
  for (int i = 0; i < fx_count + curve_count; i++) {
    const fx_t *fx = i < fx_count ? fx_table[i] : NULL;
    const curve_t *curve = fx ? NULL : curve_table[i - fx_count];
    const char *name = fx ? fx->name : curve->name, *brief = fx ? fx->brief : curve->brief;
    ROW("%s", name);
    CHECK(strlen(brief) > 10);
    const int n = fx ? fx->n_param : curve->n_param;
    for (int k = 0; k < n; k++) {
      const fx_param_t *p = fx ? &fx->param[k] : &curve->param[k];
      CHECK(p->min < p->max && p->nominal >= p->min && p->nominal <= p->max);
    }
    if (fx && fx->surface)
      CHECK(curve_find(fx->form_initial) && (curve_find(fx->form_initial)->surfaces & fx->surface));
  }
}

TEST(model_replaces_an_effect_of_the_same_name) {
  model_t m = {.n_fx = 0};
  why_t why;
  fx_use_t use = fx_use(fx_find("ceiling"));
  CHECK_OK(model_add_fx(&m, &use, &why));
  use.p[0] = 0.6;
  CHECK_OK(model_add_fx(&m, &use, &why));
  CHECK(m.n_fx == 1 && m.fx[0].p[0] == 0.6);
  use = fx_use(fx_find("ground"));
  CHECK_OK(model_add_fx(&m, &use, &why));
  CHECK(m.n_fx == 2 && m.fx[1].fx == fx_find("ground"));
}

// --- six degrees of freedom: sign and size against numbers by hand
// -------------------------------------------

// Specific force and angular acceleration that one effect adds, after the first tick has begun.
typedef struct {
  d3_t acc_b_mps2, turn_b_radps2;
} felt_t;

static felt_t felt_with(const model_t *m, const body_start_t *start) {
  felt_t felt = {{(double)NAN, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  body_t b;
  if (!CHECK_OK(body_open(&b, m, INTEGRATE_RK4, 0.002, start))) return felt;
  felt = (felt_t){body_specific_force_b_mps2(&b), body_angular_acc_b_radps2(&b)};
  body_close(&b);
  return felt;
}

static felt_t felt(const model_t *with, const body_start_t *start) {
  model_t without = *with;
  without.n_fx = 0;
  const felt_t a = felt_with(with, start), b = felt_with(&without, start);
  return (felt_t){d3_sub(a.acc_b_mps2, b.acc_b_mps2), d3_sub(a.turn_b_radps2, b.turn_b_radps2)};
}

static void check_d3(d3_t got, double x, double y, double z, double tol) {
  CHECK_NEAR(got.x, x, tol);
  CHECK_NEAR(got.y, y, tol);
  CHECK_NEAR(got.z, z, tol);
}

TEST(rotor_drag_and_body_drag_push_against_the_velocity_through_the_air) {
  model_t m = vehicle6(HUGE_VAL);
  body_start_t start = vehicle6_start(&m, 5.0, 1.0);
  start.vel_w_mps = d3(3.0, -4.0, 12.0);
  vehicle6_add(&m, "rotor_drag");
  // 0.0329 x 9.81 / 4 N over 2e-8 x (22.5/23.55)^4: four rotors at 2200.38 rad/s
  const double sum_radps = 4.0 * sqrt(0.0806873 / (2e-8 * pow(22.5 / 23.55, 4.0)));
  check_d3(felt(&m, &start).acc_b_mps2, -1e-6 * sum_radps * 3.0 / MASS_KG, 1e-6 * sum_radps * 4.0 / MASS_KG,
           0.0, 1e-5);
  // Turned by 90 degrees to the left: body x looks along world y.
  start.q_wb = dq_about(d3(0.0, 0.0, 1.0), 1.57079632679489662);
  check_d3(felt(&m, &start).acc_b_mps2, 1e-6 * sum_radps * 4.0 / MASS_KG, 1e-6 * sum_radps * 3.0 / MASS_KG,
           0.0, 1e-5);
  start.q_wb = dq_about(d3(0.0, 0.0, 1.0), 0.0);
  m.n_fx = 0;
  vehicle6_add(&m, "body_drag"); // 2e-3 x 13 m/s x (3, -4, 12) / 0.0329 kg
  check_d3(felt(&m, &start).acc_b_mps2, -2.370821, 3.161094, -9.483283, 1e-6);
  fx_use_t *wind = vehicle6_add(&m, "wind"); // the air moves along: nothing but its own 3 mN
  wind->p[5] = 3.0, wind->p[6] = -4.0, wind->p[7] = 12.0;
  check_d3(felt(&m, &start).acc_b_mps2, 3e-3 / MASS_KG, 0.0, 0.0, 1e-9);
}

TEST(wind_pushes_in_the_world_whatever_the_vehicle_looks_at) {
  model_t m = vehicle6(HUGE_VAL);
  body_start_t start = vehicle6_start(&m, 5.0, 1.0);
  fx_use_t *wind = vehicle6_add(&m, "wind");
  wind->p[0] = 0.0, wind->p[1] = 0.01;
  check_d3(felt(&m, &start).acc_b_mps2, 0.0, 0.303951, 0.0, 1e-6);
  start.q_wb = dq_about(d3(0.0, 0.0, 1.0), 1.57079632679489662);
  check_d3(felt(&m, &start).acc_b_mps2, 0.303951, 0.0, 0.0, 1e-6);
}

TEST(gusts_have_the_spread_and_the_memory_they_say) {
  model_t m = vehicle6(HUGE_VAL);
  fx_use_t *wind = vehicle6_add(&m, "wind");
  wind->p[0] = 0.0, wind->p[3] = 4e-3, wind->p[4] = 0.05;
  body_start_t start = vehicle6_start(&m, 5.0, 1.0);
  body_t b;
  if (!CHECK_OK(body_open(&b, &m, INTEGRATE_RK4, 0.002, &start))) return;
  enum { N = 200000 };
  double sum = 0.0, square = 0.0, lagged = 0.0, past[25] = {0.0};
  for (int t = 0; t < N; t++) {
    vehicle6_fly(&b, 1.0, 1);
    const double f = b.plant.force_w_N.x;
    sum += f, square += f * f, lagged += f * past[t % 25];
    past[t % 25] = f;
  }
  // 400 s are 8,000 correlation times: 1 % of the spread each
  CHECK_NEAR(sum / N, 0.0, 2e-4);
  CHECK_NEAR(sqrt(square / N), 4e-3, 1.2e-4);
  CHECK_NEAR(lagged / square, exp(-1.0), 0.04);
  body_close(&b);
}

TEST(side_wall_pulls_and_turns_the_top_towards_itself) {
  model_t m = vehicle6(HUGE_VAL);
  vehicle6_add(&m, "sidewall"); // at y = 1 m: 5 mN, 20 uN m, 50 mm
  body_start_t start = vehicle6_start(&m, 5.0, 1.0);
  for (int side = -1; side <= 1; side += 2) {
    ROW("side %d", side);
    start.pos_w_m.y = 1.0 - side * 0.1;
    const felt_t f = felt(&m, &start); // exp(-2) = 0.1353353
    check_d3(f.acc_b_mps2, 0.0, side * 0.1353353 * 5e-3 / MASS_KG, 0.0, 1e-8);
    check_d3(f.turn_b_radps2, -side * 0.1353353 * 2e-5 / 16.8e-6, 0.0, 0.0, 1e-7);
  }
}

TEST(a_damaged_motor_and_a_centre_of_mass_elsewhere_turn_the_vehicle) {
  model_t m = vehicle6(HUGE_VAL);
  const body_start_t start = vehicle6_start(&m, 5.0, 1.0);
  const double f = WEIGHT_N / 4.0, torque_m = m.frame.torque_ratio_m;
  vehicle6_add(&m, "motor_damage"); // rotor 1, front right, loses 6 %
  felt_t got = felt(&m, &start);
  check_d3(got.acc_b_mps2, 0.0, 0.0, -0.06 * 9.81 / 4.0, 1e-9);
  check_d3(got.turn_b_radps2, 0.06 * f * 0.0325 / 16.8e-6, 0.06 * f * 0.0325 / 16.8e-6,
           0.06 * f * torque_m / 29.8e-6, 1e-9);
  m.n_fx = 0;
  fx_use_t *cg = vehicle6_add(&m, "cg_offset"); // M = T (-dy, dx)
  cg->p[0] = 1.5e-3, cg->p[1] = -0.5e-3;
  got = felt(&m, &start);
  check_d3(got.turn_b_radps2, WEIGHT_N * 0.5e-3 / 16.8e-6, WEIGHT_N * 1.5e-3 / 16.8e-6, 0.0, 1e-9);
  // The accelerometer stays where it was, (-1.5, 0.5) mm from the axes that now turn.
  CHECK_NEAR(got.acc_b_mps2.z, WEIGHT_N / 16.8e-6 * (0.5e-3 * 0.5e-3 + 1.5e-3 * 1.5e-3), 1e-9);
}

TEST(a_payload_comes_and_goes) {
  model_t m = vehicle6(HUGE_VAL);
  fx_use_t *mass = vehicle6_add(&m, "mass");
  mass->p[0] = 0.00329, mass->p[1] = 0.1, mass->p[2] = 0.2; // 10 % more
  const body_start_t start = vehicle6_start(&m, 5.0, 1.0);
  body_t b;
  if (!CHECK_OK(body_open(&b, &m, INTEGRATE_RK4, 0.002, &start))) return;
  vehicle6_fly(&b, 1.0, 50);
  CHECK_NEAR(b.y[RIGID_VEL_MPS + 2], 0.0, 1e-12);
  vehicle6_fly(&b, 1.0, 50);
  CHECK_NEAR(b.y[RIGID_VEL_MPS + 2], -0.1 * (9.81 - 9.81 / 1.1), 1e-9);
  CHECK_NEAR(body_specific_force_b_mps2(&b).z, 9.81 / 1.1, 1e-9);
  vehicle6_fly(&b, 1.0, 50);
  CHECK_NEAR(b.y[RIGID_VEL_MPS + 2], -0.1 * (9.81 - 9.81 / 1.1), 1e-9);
  body_close(&b);
}

TEST(motor_damage_begins_when_it_is_told_to) {
  model_t m = vehicle6(HUGE_VAL);
  fx_use_t *damage = vehicle6_add(&m, "motor_damage");
  damage->p[0] = 3.0, damage->p[1] = 1.0, damage->p[2] = 0.05;
  const body_start_t start = vehicle6_start(&m, 5.0, 1.0);
  body_t b;
  if (!CHECK_OK(body_open(&b, &m, INTEGRATE_RK4, 0.002, &start))) return;
  vehicle6_fly(&b, 1.0, 25);
  CHECK_NEAR(b.y[RIGID_RATE_RADPS], 0.0, 1e-12);
  vehicle6_fly(&b, 1.0, 1);
  CHECK(b.y[RIGID_RATE_RADPS] < -0.1 && b.y[RIGID_RATE_RADPS + 1] < -0.1); // rear left sinks
  body_close(&b);
}

TEST(sag_lowers_the_thrust_with_the_voltage) {
  model_t m = vehicle6(HUGE_VAL);
  m.battery = (battery_param_t){.capacity_As = 1e9, .n = 2, .open_V = {3.0, 4.2}};
  vehicle6_add(&m, "battery_sag");
  body_start_t start = vehicle6_start(&m, 5.0, 1.0);
  start.discharged = 0.75; // 3.3 V: 1 - 0.6 (1 - 3.3/4.2) = 0.871429
  CHECK_NEAR(felt(&m, &start).acc_b_mps2.z, -0.128571 * 9.81, 1e-5);
}

TEST(motor_lag_and_delay_slow_the_thrust) {
  static const struct {
    const char *effect;
    int ticks;
    double done;                                 // share of the step
  } row[] = {{NULL, 50, 1.0 - 0.2018965},        // exp(-0.1 / 0.0625)
             {"motor_lag", 50, 1.0 - 0.3189066}, // exp(-0.1 / 0.0875)
             {"delay", 5, 0.0},
             {"delay", 6, 1.0 - 0.9685066}, // exp(-0.002 / 0.0625)
             {"delay", 55, 1.0 - 0.2018965}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s, %d ticks", row[i].effect ? row[i].effect : "none", row[i].ticks);
    model_t m = vehicle6(HUGE_VAL);
    if (row[i].effect) vehicle6_add(&m, row[i].effect);
    const body_start_t start = vehicle6_start(&m, 5.0, 1.0);
    const double f = WEIGHT_N / 4.0;
    body_t b;
    if (!CHECK_OK(body_open(&b, &m, INTEGRATE_RK4, 0.002, &start))) continue;
    vehicle6_fly(&b, 1.2, row[i].ticks);
    CHECK_NEAR((b.y[RIGID_THRUST_N + 1] / f - 1.0) / 0.2, row[i].done, 1e-6);
    body_close(&b);
  }
  model_t m = vehicle6(HUGE_VAL);
  m.frame.motor_delay_s = 0.004; // the vehicle file's and the effect's add
  vehicle6_add(&m, "delay");
  const body_start_t start = vehicle6_start(&m, 5.0, 1.0);
  body_t b;
  if (!CHECK_OK(body_open(&b, &m, INTEGRATE_RK4, 0.002, &start))) return;
  vehicle6_fly(&b, 1.2, 7);
  CHECK_NEAR(b.y[RIGID_THRUST_N], WEIGHT_N / 4.0, 1e-15);
  vehicle6_fly(&b, 1.2, 1);
  CHECK(b.y[RIGID_THRUST_N] > WEIGHT_N / 4.0 + 1e-4);
  body_close(&b);
}

TEST(every_effect_does_something) {
  for (int i = 0; i < fx_count; i++) {
    ROW("%s", fx_table[i]->name);
    CHECK(fx_table[i]->excess || fx_table[i]->load || fx_table[i]->tick);
  }
}
