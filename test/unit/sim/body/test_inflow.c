// test_inflow.c - a rotor whose inflow a ceiling hinders: thrust, speed, torque and current are one model.
#include "plant/inflow.h"
#include "rig/vehicle6.h"

#include <string.h>

// What the three equations of the header leave over at a thrust rho and a speed s.
static double left_over(double rho, double s) {
  const double q = 1.0 - 0.5 * INFLOW_MOTOR * (s * s - 1.0);
  const double inflow = 1.0 - (rho / (s * s) - 1.0) / INFLOW_BLADES;
  return q - (1.0 - INFLOW_POWER) * s * s - INFLOW_POWER * rho * inflow;
}

static double turning_of(double rho) {
  return inflow_turning(few_all(rho), few_all(0.0))[0];
}
static double torque_of(double rho) {
  return inflow_torque(inflow_turning(few_all(rho), few_all(0.0)))[0];
}

TEST(inflow_speed_solves_motor_blades_and_power_together) {
  double faster = 0.0, less = 1.0;
  for (int i = 0; i <= 10; i++) {
    const double rho = 1.0 + 0.06 * i;
    ROW("thrust %g", rho);
    CHECK_NEAR(left_over(rho, turning_of(rho)), 0.0, 1e-12);
    if (i == 0) CHECK(turning_of(rho) == 1.0); // free air is flown to the bit as without surfaces
    if (i > 0) CHECK(turning_of(rho) > faster && torque_of(rho) < less); // it turns faster and draws less
    faster = turning_of(rho);
    less = torque_of(rho);
  }
  // To first order P (1/B - 1) / (M + 2 (1 - P) + 2 P / B) of the gain.
  CHECK_NEAR((turning_of(1.001) - 1.0) / 0.001, 0.0479, 2e-4);
  CHECK_NEAR((1.0 - torque_of(1.001)) / 0.001, 0.0671, 3e-4);
}

TEST(inflow_of_any_thrust_leaves_finite_speeds_and_no_negative_torque) {
  for (double rho = 0.01; rho < 20.0; rho *= 1.3) {
    ROW("thrust %g", rho);
    CHECK(turning_of(rho) > 0.0 && turning_of(rho) < 4.0);
    CHECK(torque_of(rho) >= 0.0 && torque_of(rho) < 2.0);
  }
}

TEST(inflow_at_contact_needs_a_third_of_the_power_at_the_same_thrust) {
  // No inflow is left: 1 = s^2 (1 + B), and the profile alone needs power.
  const double s = 1.0 / sqrt(1.0 + INFLOW_BLADES), power = (1.0 - INFLOW_POWER) * s * s * s;
  CHECK_NEAR(power, 1.0 / 3.0, 0.05); // Hsiao and Chirarattananon: a factor of three
}

static bool below(double gap_m, const char *more, double battery_As, model_t *m, body_t *b) {
  *m = vehicle6(1.0);
  if (gap_m < 0.9) vehicle6_add(m, "ceiling");
  if (more) vehicle6_add(m, more);
  if (battery_As > 0.0)
    m->battery = (battery_param_t){.capacity_As = battery_As,
                                   .resistance_ohm = 0.16,
                                   .idle_A = 0.3,
                                   .a_ApN = 6.0,
                                   .b_ApN2 = 10.0,
                                   .n = 2,
                                   .open_V = {3.0, 4.2}};
  const body_start_t start = vehicle6_start(m, 1.0 - gap_m, 1.0);
  return CHECK_OK(body_open(b, m, INTEGRATE_RK4, TICK_S, &start));
}

// Body does not move: what is looked at is one instant.
TEST(inflow_under_a_ceiling_leaves_the_published_thrust_and_changes_what_goes_with_it) {
  static const double gap_m[] = {0.9, 0.05, 0.02, 0.01, 0.002};
  const double free_radps = sqrt(0.25 * WEIGHT_N / vehicle6(1.0).frame.kf_Ns2);
  for (unsigned i = 0; i < sizeof gap_m / sizeof *gap_m; i++) {
    ROW("%g m", gap_m[i]);
    model_t m;
    body_t b;
    if (!below(gap_m[i], NULL, 0.0, &m, &b)) continue;
    const double e = gap_m[i] < 0.9 ? 0.44 * exp(-1.8 * gap_m[i] / RADIUS_M) : 0.0,
                 x = turning_of(1.0 + e) - 1.0;
    double left[ROTORS];
    body_current_left(&b, left);
    for (int k = 0; k < ROTORS; k++) {
      CHECK_NEAR(body_thrust_ratio(&b, k), 1.0 + e, 1e-9);
      CHECK_NEAR(body_rotor_radps(&b, k), (1.0 + x) * free_radps, 1e-6);
      CHECK_NEAR(left[k], torque_of(1.0 + e), 1e-9);
    }
    CHECK_NEAR(body_specific_force_b_mps2(&b).z, 9.81 * (1.0 + e), 1e-6);
    body_close(&b);
  }
}

TEST(inflow_changes_the_torque_and_the_momentum_of_one_rotor) {
  // One rotor alone turns, so that nothing cancels out; it stays at its command.
  model_t m = vehicle6(1.0);
  vehicle6_add(&m, "ceiling");
  body_start_t start = vehicle6_start(&m, 1.0 - 0.01, 0.0);
  start.thrust_N[0] = 0.08;
  start.rate_b_radps = d3(3.0, 0.0, 0.0);
  body_t b;
  if (!CHECK_OK(body_open(&b, &m, INTEGRATE_RK4, TICK_S, &start))) return;
  memcpy(b.rigid.command_N, start.thrust_N, sizeof b.rigid.command_N);
  const frame_t *const f = &m.frame;
  const double rho = 1.0 + 0.44 * exp(-1.8 * 0.01 / RADIUS_M), x = turning_of(rho) - 1.0, q = torque_of(rho);
  const double rest_radps = ROTOR_SLOWEST_RADPS, turns_radps = (1.0 + x) * sqrt(0.08 / f->kf_Ns2);
  double momentum = 0.0;
  for (int k = 0; k < ROTORS; k++)
    momentum += f->rotor_spin[k] * f->rotor_inertia_kgm2 * (k == 0 ? turns_radps : (1.0 + x) * rest_radps);
  const d3_t turn = vehicle6_angular_acc_b_radps2(&b);
  CHECK_NEAR(turn.z, -f->rotor_spin[0] * q * f->torque_ratio_m * 0.08 / f->inertia_kgm2[2], 1e-9);
  // - w x h about y: w_x h_z, beside the thrust's own moment.
  const double thrust_Nm = -b.rigid.rotor_x_m[0] * 0.08 * body_thrust_ratio(&b, 0);
  CHECK_NEAR(turn.y, (thrust_Nm + 3.0 * momentum) / f->inertia_kgm2[1], 1e-6);
  body_close(&b);
}

TEST(inflow_hindered_rotors_draw_less_from_the_battery) {
  model_t near, far;
  body_t a, b;
  if (!below(0.005, NULL, 900.0, &near, &a) || !below(0.9, NULL, 900.0, &far, &b)) return;
  a.rigid.held = b.rigid.held = true;
  vehicle6_fly(&a, 1.0, 1);
  vehicle6_fly(&b, 1.0, 1);
  const double e = 0.44 * exp(-1.8 * 0.005 / RADIUS_M), left = torque_of(1.0 + e);
  CHECK_NEAR((a.current_A - 0.3) / (b.current_A - 0.3), left, 1e-9);
  CHECK_NEAR(a.vbat_V - b.vbat_V, 0.16 * (b.current_A - a.current_A), 1e-6);
  body_close(&a);
  body_close(&b);
}

TEST(ceiling_rpm_turns_rotors_faster_by_the_same_line_and_leaves_the_thrust) {
  model_t plain, more;
  body_t a, b;
  if (!below(0.02, NULL, 0.0, &plain, &a) || !below(0.02, "ceiling_rpm", 0.0, &more, &b)) return;
  const double k = 0.05 * exp(-0.8 * 0.02 / RADIUS_M);
  double left_a[ROTORS], left_b[ROTORS];
  body_current_left(&a, left_a);
  body_current_left(&b, left_b);
  const double free_radps = sqrt(0.25 * WEIGHT_N / plain.frame.kf_Ns2);
  CHECK_NEAR(body_rotor_radps(&b, 2) - body_rotor_radps(&a, 2), k * free_radps, 1e-6);
  CHECK_NEAR(left_b[2] - left_a[2], -INFLOW_MOTOR * k, 0.05 * k); // of first order
  CHECK(body_thrust_ratio(&b, 2) == body_thrust_ratio(&a, 2));
  body_close(&a);
  body_close(&b);
}
