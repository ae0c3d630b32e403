// test_body_ceiling.c - six degrees of freedom near a ceiling or the ground: height and tilt.
#include "rig/turned.h"
#include "rig/vehicle6.h"
#include <string.h>

static const d3_t x_axis = {1.0, 0.0, 0.0};

static double angle_of(const body_t *b) {
  return 2.0 * b->y[RIGID_Q_WB + 1]; // small turns about x
}

// The rate at which a small departure grows, from three to six times its own time constant.
static double growth_radps(double gap_m, bool tilt, double guess) {
  model_t m = vehicle6(1.0);
  vehicle6_add(&m, "ceiling");
  const double share = 1.0 / (1.0 + 0.44 * exp(-80.0 * gap_m));
  body_start_t start = vehicle6_start(&m, 1.0 - gap_m, share);
  const double z_m = start.pos_w_m.z, step_s = 0.0005;
  if (tilt)
    start.q_wb = turned_about(x_axis, 1e-7);
  else
    start.pos_w_m.z += 1e-8;
  body_t b;
  if (!CHECK_OK(body_open(&b, &m, INTEGRATE_RK4, step_s, &start))) return (double)NAN;
  const double f = share * WEIGHT_N / 4.0, command_N[ROTORS] = {f, f, f, f};
  double at[2];
  for (int i = 0; i < 2; i++) {
    const int ticks = (int)(3.0 / guess / step_s);
    for (int t = 0; t < ticks; t++) body_tick(&b, command_N, step_s);
    at[i] = tilt ? angle_of(&b) : b.y[RIGID_POS_M + 2] - z_m;
    if (i == 1) at[1] = log(at[1] / at[0]) / (ticks * step_s);
  }
  CHECK(b.ceiling_contacts == 0);
  body_close(&b);
  return at[1];
}

TEST(height_and_tilt_under_a_ceiling_run_away_as_the_linear_poles_say) {
  // 1 + 0.44 exp(-80 z), I 16.8e-6 kg m2, rotors 32.5 mm beside the axis, 32.9 g
  static const struct {
    double gap_m, height_radps, tilt_radps;
  } row[] = {{0.050, 2.5, 3.6}, {0.020, 8.0, 11.6}, {0.010, 11.4, 16.5}, {0.005, 13.4, 19.4}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("gap %g m", row[i].gap_m);
    const double height = growth_radps(row[i].gap_m, false, row[i].height_radps);
    const double tilt = growth_radps(row[i].gap_m, true, row[i].tilt_radps);
    // cosh is not yet exp after three time constants: 0.2 %; the table has two or three digits
    CHECK_NEAR(height / row[i].height_radps, 1.0, 0.015);
    CHECK_NEAR(tilt / row[i].tilt_radps, 1.0, 0.015);
  }
}

TEST(ground_turns_a_tilted_vehicle_back_and_a_ceiling_turns_it_over) {
  static const char *const name[] = {"ground", "ceiling"};
  for (int i = 0; i < 2; i++) {
    ROW("%s", name[i]);
    model_t m = vehicle6(0.1);
    vehicle6_add(&m, name[i]);
    const double gap_m = 0.05, ratio = 1.0 + 0.44 * exp(-80.0 * gap_m), slope_pm = 80.0 * (ratio - 1.0);
    body_start_t start = vehicle6_start(&m, gap_m, 1.0 / ratio);
    start.q_wb = turned_about(x_axis, 1e-4);
    body_t b;
    if (!CHECK_OK(body_open(&b, &m, INTEGRATE_RK4, 0.002, &start))) continue;
    const double stiffness = 0.0325 * 0.0325 * WEIGHT_N / ratio * slope_pm / 16.8e-6; // 1/s2
    const double want = (i == 0 ? -stiffness : stiffness) * 1e-4;
    CHECK_NEAR(vehicle6_angular_acc_b_radps2(&b).x, want, 1e-3 * fabs(want));
    vehicle6_fly(&b, 1.0 / ratio, 150);
    // at 3.59 rad/s for 0.3 s: cos or cosh of 1.08
    CHECK_NEAR(angle_of(&b), 1e-4 * (i == 0 ? cos(1.0774) : cosh(1.0774)), 2e-6);
    body_close(&b);
  }
}

TEST(each_rotor_has_its_own_distance_along_the_vertical) {
  model_t m = vehicle6(1.0);
  vehicle6_add(&m, "ceiling");
  vehicle6_add(&m, "ground");
  body_start_t start = {.pos_w_m = {0.0, 0.0, 0.9}};
  start.q_wb = turned_about(x_axis, 0.5);
  body_t b;
  if (!CHECK_OK(body_open(&b, &m, INTEGRATE_RK4, 0.002, &start))) return;
  for (int i = 0; i < ROTORS; i++) {
    ROW("rotor %d", i + 1);
    const double side = i < 2 ? -1.0 : 1.0; // a turn about +x lifts the left ones, 3 and 4
    const double z_m = 0.9 + 0.013 * m.rotor_radius_m / 0.02355 * cos(0.5) + side * 0.0325 * sin(0.5);
    CHECK_NEAR(body_ceiling_gap_m(&b, i), 1.0 - z_m, 1e-12);
    CHECK_NEAR(body_thrust_ratio(&b, i), 1.0 + 0.44 * exp(-80.0 * (1.0 - z_m)) + 0.44 * exp(-80.0 * z_m),
               1e-12);
  }
  body_close(&b);
}

TEST(blades_touch_at_the_tilt_that_geometry_says) {
  // Worked out beforehand: 47 / 17 / 8.4 / 4.2 degrees, over the diagonal
  static const struct {
    double gap_m, tilt_deg;
  } row[] = {{0.050, 47.0}, {0.020, 17.0}, {0.010, 8.4}, {0.005, 4.2}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("gap %g m", row[i].gap_m);
    model_t m = vehicle6(1.0);
    m.frame.rotor_above_feet_m = m.frame.cg_above_feet_m; // the tilt is about the blades' plane
    double lo = 0.0, hi = 1.2;
    for (int k = 0; k < 30; k++) {
      const double mid = 0.5 * (lo + hi);
      body_start_t start = {.pos_w_m = {0.0, 0.0, 1.0 - row[i].gap_m}};
      start.q_wb = turned_about(d3(sqrt(0.5), sqrt(0.5), 0.0), mid);
      body_t b;
      if (!CHECK_OK(body_open(&b, &m, INTEGRATE_RK4, 0.002, &start))) return;
      *(body_clearance(&b).ceiling_m > 0.0 ? &lo : &hi) = mid;
      body_close(&b);
    }
    CHECK_NEAR(lo * 180.0 / 3.14159265358979 / row[i].tilt_deg, 1.0, 0.03);
  }
}

TEST(body_yaws_by_the_torque_that_a_ceiling_leaves_and_not_by_the_thrust) {
  // The ceiling raises the lift, and takes a little of the torque: at 1 cm 20 % more and 1.9 % less.
  static const double gap_m[] = {HUGE_VAL, 0.05, 0.01};
  for (int i = 0; i < 3; i++) {
    ROW("gap %g m", gap_m[i]);
    model_t m = vehicle6(i == 0 ? HUGE_VAL : 1.0);
    vehicle6_add(&m, "ceiling");
    body_start_t start = vehicle6_start(&m, i == 0 ? 0.5 : 1.0 - gap_m[i], 1.0);
    const double f = 0.25 * WEIGHT_N, command_N[ROTORS] = {0.9 * f, 1.1 * f, 0.9 * f, 1.1 * f};
    memcpy(start.thrust_N, command_N, sizeof start.thrust_N);
    body_t b;
    if (!CHECK_OK(body_open(&b, &m, INTEGRATE_RK4, 0.002, &start))) return;
    CHECK((body_thrust_ratio(&b, 0) > 1.15) == (i == 2));
    memcpy(b.rigid.command_N, command_N, sizeof b.rigid.command_N); // the rotors keep their speed
    double left[ROTORS];
    body_current_left(&b, left);
    CHECK_NEAR(left[0], i == 2 ? 0.981 : 1.0, 1e-3);
    const double want = 4.0 * 0.1 * f * left[0] * m.frame.torque_ratio_m / m.frame.inertia_kgm2[2];
    CHECK_NEAR(vehicle6_angular_acc_b_radps2(&b).z, want, 1e-9 * want);
    body_close(&b);
  }
}
