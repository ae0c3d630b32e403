// test_effects_body.c - effects in six degrees of freedom: sign and size against numbers by hand.
#include "effects/fx.h"
#include "rig/test.h"
#include "rig/turned.h"
#include "rig/vehicle6.h"
#include "vehicle/model.h"

// Specific force and angular acceleration that one effect adds, after the first tick has begun.
typedef struct {
  d3_t acc_b_mps2, turn_b_radps2;
} felt_t;

static felt_t felt_with(const model_t *m, const body_start_t *start) {
  felt_t felt = {{(double)NAN, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  body_t b;
  if (!CHECK_OK(body_open(&b, m, INTEGRATE_RK4, 0.002, start))) return felt;
  felt = (felt_t){body_specific_force_b_mps2(&b), vehicle6_angular_acc_b_radps2(&b)};
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
  start.q_wb = turned_about(d3(0.0, 0.0, 1.0), 1.57079632679489662);
  check_d3(felt(&m, &start).acc_b_mps2, 1e-6 * sum_radps * 4.0 / MASS_KG, 1e-6 * sum_radps * 3.0 / MASS_KG,
           0.0, 1e-5);
  start.q_wb = turned_about(d3(0.0, 0.0, 1.0), 0.0);
  m.n_fx = 0;
  vehicle6_add(&m, "body_drag"); // 2e-3 x 13 m/s x (3, -4, 12) / 0.0329 kg
  check_d3(felt(&m, &start).acc_b_mps2, -2.370821, 3.161094, -9.483283, 1e-6);
  double *const drag = m.fx[0].p; // 13 m/s in z as well: along each axis its own
  drag[0] = 0.0, drag[1] = 0.01, drag[2] = 0.02, drag[3] = 0.005;
  check_d3(felt(&m, &start).acc_b_mps2, -0.03 / MASS_KG, 0.08 / MASS_KG, -0.06 / MASS_KG, 1e-9);
  drag[0] = 2e-3;
  fx_use_t *wind = vehicle6_add(&m, "wind"); // the air moves along: nothing but its own 3 mN
  wind->p[5] = 3.0, wind->p[6] = -4.0, wind->p[7] = 12.0;
  check_d3(felt(&m, &start).acc_b_mps2, 3e-3 / MASS_KG, 0.0, 0.0, 1e-9);
}

TEST(drag_and_inflow_at_the_hubs_damp_turning_and_at_the_centre_of_mass_do_not) {
  const double arm_m = 0.0325, speed_radps = sqrt(0.25 * WEIGHT_N / vehicle6(HUGE_VAL).frame.kf_Ns2);
  // k Om v at each of four hubs, v = w r: the moment is 4 k Om w (x^2 + y^2) for yaw, 4 k Om w y^2 for roll.
  static const struct {
    const char *name;
    double k;
    d3_t rate_b_radps, per; // damped by so many arms squared
  } row[] = {
      {"rotor_drag", 1e-6, {0.0, 0.0, 2.0}, {0.0, 0.0, 2.0}},
      {"climb_inflow", 1.5e-6, {2.0, 0.0, 0.0}, {1.0, 0.0, 0.0}},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++)
    for (int arm = 0; arm <= 1; arm++) {
      ROW("%s, arm %d", row[i].name, arm);
      model_t m = vehicle6(HUGE_VAL);
      body_start_t start = vehicle6_start(&m, 5.0, 1.0);
      start.rate_b_radps = row[i].rate_b_radps;
      vehicle6_add(&m, row[i].name)->p[1] = arm;
      const d3_t got = felt(&m, &start).turn_b_radps2, rate = row[i].rate_b_radps, per = row[i].per;
      const double damped = -4.0 * arm * row[i].k * speed_radps * arm_m * arm_m;
      check_d3(got, damped * per.x * rate.x / 16.8e-6, damped * per.y * rate.y / 16.8e-6,
               damped * per.z * rate.z / 29.8e-6, 1e-9);
    }
  // A drag above the centre of mass tips the vehicle back.
  model_t m = vehicle6(HUGE_VAL);
  body_start_t start = vehicle6_start(&m, 5.0, 1.0);
  start.vel_w_mps = d3(1.0, 0.0, 0.0);
  vehicle6_add(&m, "rotor_drag");
  const double push_N = -4.0 * 1e-6 * speed_radps;
  check_d3(felt(&m, &start).turn_b_radps2, 0.0, push_N * body_rotor_z_m(&m) / 16.8e-6, 0.0, 1e-9);
}

// At 2 m/s forwards and 3 rad/s to the left the hubs on the right go at 2 + 3 y, those on the left at 2 - 3
// y.
TEST(translational_lift_at_the_hubs_lifts_the_rotors_that_advance) {
  const double arm_m = 0.0325, k = 0.02, v = 2.0, yaw = 3.0;
  for (int arm = 0; arm <= 1; arm++) {
    ROW("arm %d", arm);
    model_t m = vehicle6(HUGE_VAL);
    body_start_t start = vehicle6_start(&m, 5.0, 1.0);
    start.vel_w_mps = d3(v, 0.0, 0.0);
    start.rate_b_radps = d3(0.0, 0.0, yaw);
    fx_use_t *const lift = vehicle6_add(&m, "translational_lift");
    lift->p[0] = k, lift->p[1] = arm;
    const double turned = arm * yaw * arm_m; // of each hub, along x and y
    check_d3(felt(&m, &start).acc_b_mps2, 0.0, 0.0, k * (v * v + 2.0 * turned * turned) / MASS_KG, 1e-9);
    // Sums over the hubs of y F and -x F: the squares' cross terms, -2 v turned along x alone.
    check_d3(felt(&m, &start).turn_b_radps2, -2.0 * k * v * turned * arm_m / 16.8e-6, 0.0, 0.0, 1e-6);
  }
}

TEST(wind_pushes_in_the_world_whatever_the_vehicle_looks_at) {
  model_t m = vehicle6(HUGE_VAL);
  body_start_t start = vehicle6_start(&m, 5.0, 1.0);
  fx_use_t *wind = vehicle6_add(&m, "wind");
  wind->p[0] = 0.0, wind->p[1] = 0.01;
  check_d3(felt(&m, &start).acc_b_mps2, 0.0, 0.303951, 0.0, 1e-6);
  start.q_wb = turned_about(d3(0.0, 0.0, 1.0), 1.57079632679489662);
  check_d3(felt(&m, &start).acc_b_mps2, 0.303951, 0.0, 0.0, 1e-6);
}

TEST(wind_that_the_rotors_feel_pushes_in_their_plane) {
  model_t m = vehicle6(HUGE_VAL);
  body_start_t start = vehicle6_start(&m, 5.0, 1.0);
  fx_use_t *wind = vehicle6_add(&m, "wind");
  start.q_wb = turned_about(d3(0.0, 1.0, 0.0), 0.3); // nose down
  wind->p[0] = 0.01;
  check_d3(felt(&m, &start).acc_b_mps2, 0.303951 * cos(0.3), 0.0, 0.303951 * sin(0.3), 1e-6);
  wind->p[8] = 1.0;
  check_d3(felt(&m, &start).acc_b_mps2, 0.303951 * cos(0.3), 0.0, 0.0, 1e-6);
  wind->p[0] = 0.0, wind->p[2] = 0.01; // what lifts it acts as a whole
  check_d3(felt(&m, &start).acc_b_mps2, -0.303951 * sin(0.3), 0.0, 0.303951 * cos(0.3), 1e-6);
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

TEST(rotors_that_lean_turn_the_vehicle_about_z_and_do_nothing_else) {
  model_t m = vehicle6(HUGE_VAL);
  vehicle6_add(&m, "rotor_tilt"); // 0.3 mm of the thrust
  for (int i = 0; i < 2; i++) {
    const double weights = i ? 1.2 : 1.0;
    const body_start_t start = vehicle6_start(&m, 5.0, weights);
    const felt_t got = felt(&m, &start);
    check_d3(got.acc_b_mps2, 0.0, 0.0, 0.0, 1e-12);
    check_d3(got.turn_b_radps2, 0.0, 0.0, 3e-4 * weights * WEIGHT_N / 29.8e-6, 1e-9);
  }
}

// Rotor 1, front right, turns counter-clockwise, rotor 2, behind it, clockwise.
TEST(a_rotor_that_leans_pushes_its_hub_to_a_side_and_its_torque_leans_or_not) {
  static const struct {
    const char *what;
    double rotor, torque, weights, hub_x_m, spin;
  } row[] = {{"its torque leans", 1.0, 1.0, 1.0, 0.0325, 1.0},
             {"and does not", 1.0, 0.0, 1.0, 0.0325, 1.0},
             {"with more thrust", 1.0, 1.0, 1.2, 0.0325, 1.0},
             {"another rotor", 2.0, 1.0, 1.0, -0.0325, -1.0}};
  model_t m = vehicle6(HUGE_VAL);
  fx_use_t *const tilt = vehicle6_add(&m, "motor_tilt"); // 0.03 forwards
  tilt->p[2] = -0.01;                                    // and to the right
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    tilt->p[0] = row[i].rotor;
    tilt->p[3] = row[i].torque;
    const body_start_t start = vehicle6_start(&m, 5.0, row[i].weights);
    const double f = row[i].weights * WEIGHT_N / 4.0, f_x = 0.03 * f, f_y = -0.01 * f;
    const double up_m = body_rotor_z_m(&m), torque_m = row[i].torque * row[i].spin * m.frame.torque_ratio_m;
    const felt_t got = felt(&m, &start);
    check_d3(got.acc_b_mps2, f_x / WEIGHT_N * 9.81, f_y / WEIGHT_N * 9.81, 0.0, 1e-9);
    check_d3(got.turn_b_radps2, (-up_m * f_y - torque_m * f_x) / 16.8e-6,
             (up_m * f_x - torque_m * f_y) / 16.8e-6, (row[i].hub_x_m * f_y + 0.0325 * f_x) / 29.8e-6, 1e-9);
  }
}

TEST(a_weak_rotor_that_leans_pushes_less_and_its_torque_leans_as_far_as_it_is_there) {
  static const struct {
    const char *what;
    double torque, left; // of the weak rotor's torque
  } row[] = {{"its torque is less, too", 1.0, 0.94}, {"its torque stays", 0.0, 1.0}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    model_t m = vehicle6(HUGE_VAL);
    const body_start_t start = vehicle6_start(&m, 5.0, 1.0);
    vehicle6_add(&m, "motor_damage")->p[3] = row[i].torque; // rotor 1 loses 6 %
    const felt_t weak = felt(&m, &start);
    vehicle6_add(&m, "motor_tilt"); // 0.03 forwards
    const felt_t got = felt(&m, &start);
    const double f_x = 0.03 * WEIGHT_N / 4.0;
    CHECK_NEAR(got.acc_b_mps2.x - weak.acc_b_mps2.x, 0.94 * f_x / WEIGHT_N * 9.81, 1e-9);
    CHECK_NEAR(got.turn_b_radps2.x - weak.turn_b_radps2.x,
               -row[i].left * m.frame.torque_ratio_m * f_x / 16.8e-6, 1e-9);
    CHECK_NEAR(got.turn_b_radps2.z - weak.turn_b_radps2.z, 0.94 * 0.0325 * f_x / 29.8e-6, 1e-9);
  }
}

TEST(rotors_with_more_torque_turn_the_vehicle_as_one_of_them_gives_more) {
  model_t m = vehicle6(HUGE_VAL);
  vehicle6_add(&m, "torque_ratio"); // a tenth more
  const body_start_t start = vehicle6_start(&m, 5.0, 1.0);
  felt_t got = felt(&m, &start); // all cancel
  check_d3(got.turn_b_radps2, 0.0, 0.0, 0.0, 1e-9);
  fx_use_t *damage = vehicle6_add(&m, "motor_damage"); // of the first a tenth is left, and of its torque
  damage->p[1] = 0.9;
  got = felt(&m, &start);
  CHECK_NEAR(got.turn_b_radps2.z, 1.1 * 0.9 * WEIGHT_N / 4.0 * m.frame.torque_ratio_m / 29.8e-6, 1e-9);
}

TEST(a_steeper_curve_of_the_thrust_is_right_at_the_weight) {
  static const struct {
    double weights, more; // thrust in free air; what the slope adds
  } row[] = {{1.0, 0.0}, {1.2, 0.02}, {0.7, -0.03}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%g weights", row[i].weights);
    model_t m = vehicle6(HUGE_VAL);
    vehicle6_add(&m, "thrust_slope"); // by a tenth
    const body_start_t start = vehicle6_start(&m, 5.0, row[i].weights);
    check_d3(felt(&m, &start).acc_b_mps2, 0.0, 0.0, row[i].more * 9.81, 1e-9);
  }
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

TEST(a_surface_turns_a_tilted_vehicle_only_where_each_rotor_has_its_own_distance) {
  for (int each = 0; each <= 1; each++) {
    ROW("each %d", each);
    model_t m = vehicle6(1.0);
    fx_use_t *const ceiling = vehicle6_add(&m, "ceiling");
    ceiling->p[ceiling->form->n_param - 1] = each;
    body_start_t start = vehicle6_start(&m, 0.95, 1.0);
    start.q_wb = turned_about(d3(1.0, 0.0, 0.0), 0.2); // the left side is nearer, and is pulled up
    const felt_t got = felt(&m, &start);
    CHECK(got.acc_b_mps2.z > 0.05);
    CHECK(each ? got.turn_b_radps2.x > 0.1 : fabs(got.turn_b_radps2.x) < 1e-9);
    CHECK_NEAR(got.turn_b_radps2.y, 0.0, 1e-9);
  }
}

static body_t after_a_second(const fx_use_t *use) {
  model_t m = vehicle6(0.6);
  const body_start_t start = {.pos_w_m = {0.0, 0.0, 0.3}, .thrust_N = {0.08, 0.08, 0.08, 0.08}, .seed = 1};
  static body_t b;
  why_t why;
  CHECK_OK(model_add_fx(&m, use, &why));
  CHECK_OK(body_open(&b, &m, INTEGRATE_RK4, 0.002, &start));
  for (int k = 0; k < 500; k++)
    body_tick(&b, (const double[ROTORS]){0.08 + 1e-5 * (k % 50), 0.08, 0.081 - 1e-5 * (k % 30), 0.08}, 0.002);
  body_close(&b);
  return b;
}

TEST(what_a_steady_effect_does_once_is_what_it_would_do_at_every_tick) {
  int steady = 0;
  for (int i = 0; i < fx_count; i++) {
    if (!fx_table[i]->steady) continue;
    ROW("%s", fx_table[i]->name);
    fx_t each = *fx_table[i];
    each.steady = false;
    const fx_use_t once = fx_use(fx_table[i]);
    fx_use_t ever = once;
    ever.fx = &each;
    const body_t a = after_a_second(&once), b = after_a_second(&ever);
    CHECK(a.n_tick == 0 && b.n_tick == 1 && memcmp(a.y, b.y, sizeof a.y) == 0);
    steady++;
  }
  CHECK(steady > 0);
}
