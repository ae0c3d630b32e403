// test_rigid.c - the rigid body: what is conserved, and what each rotor does.
#include "plant/rigid.h"
#include "plant/rotor.h"
#include "rig/vehicle6.h"
#include <string.h>

// Free: no gravity is not to be had, but rotation does not feel it.
static const struct {
  const char *what;
  d3_t rate_b_radps;
} spin_row[] = {
    {"about x", {5.0, 0.0, 0.0}},
    {"about y", {0.0, -5.0, 0.0}},
    {"about z", {0.0, 0.0, 5.0}},
    {"all axes", {2.0, -1.5, 3.0}},
    {"middle axis, Dzhanibekov", {1e-4, 5.0, 1e-4}},
};

TEST(free_rotation_keeps_energy_and_angular_momentum) {
  for (unsigned i = 0; i < sizeof spin_row / sizeof *spin_row; i++)
    for (int kind = INTEGRATE_SUNDIALS; kind <= INTEGRATE_REFERENCE; kind++) {
      ROW("%s, kind %d", spin_row[i].what, kind);
      model_t m = vehicle6(HUGE_VAL);
      m.frame.inertia_kgm2[0] = 12e-6; // three different ones: 12, 16.8, 29.8
      m.frame.rotor_inertia_kgm2 = 0.0;
      body_start_t start = {.pos_w_m = {0.0, 0.0, 1e4}, .rate_b_radps = spin_row[i].rate_b_radps};
      body_t b;
      if (!CHECK_OK(body_open(&b, &m, (integrate_kind_t)kind, 0.002, &start))) continue;
      double still[RIGID_N];
      const d3_t before = vehicle6_momentum_w(&b.rigid, b.y);
      const double energy_J = rigid_energy_J(&b.rigid, b.y);
      double turned = 0.0;
      for (int t = 0; t < 5000; t++) {
        vehicle6_fly(&b, 0.0, 1);
        turned = fmin(turned, b.y[RIGID_RATE_RADPS + 1]);
      }
      memcpy(still, b.y, sizeof still);
      d3_put(still + RIGID_VEL_MPS, d3(0.0, 0.0, 0.0));
      const d3_t change = d3_sub(vehicle6_momentum_w(&b.rigid, still), before);
      CHECK_NEAR(d3_norm(change) / d3_norm(before), 0.0, 1e-9);
      CHECK_NEAR(rigid_energy_J(&b.rigid, still) / energy_J, 1.0, 1e-9);
      if (i == 4) CHECK(turned < -4.9); // it does turn over
      body_close(&b);
    }
}

TEST(rotors_and_body_exchange_angular_momentum) {
  // Rotors without drag that run up, while the body turns about all axes: the sum stays.
  model_t m = vehicle6(HUGE_VAL);
  m.frame.torque_ratio_m = 0.0;
  m.frame.rotor_spin[1] = 1.0; // three turn left, so that there is a sum
  body_start_t start = {.pos_w_m = {0.0, 0.0, 1e4}, .rate_b_radps = {1.0, 2.0, 0.5}};
  for (int i = 0; i < ROTORS; i++) start.thrust_N[i] = 0.04;
  body_t b;
  if (!CHECK_OK(body_open(&b, &m, INTEGRATE_RK4, 0.0005, &start))) return;
  const d3_t before = vehicle6_momentum_w(&b.rigid, b.y);
  const double yaw_radps = b.y[RIGID_RATE_RADPS + 2];
  vehicle6_fly(&b, 1.2, 500);
  const d3_t change = d3_sub(vehicle6_momentum_w(&b.rigid, b.y), before);
  CHECK_NEAR(d3_norm(change) / d3_norm(before), 0.0, 1e-9);
  CHECK(b.y[RIGID_RATE_RADPS + 2] < yaw_radps - 0.5); // the body goes the other way
  body_close(&b);
}

// The state at hover in free air, all rates 0, and the derivative there.
static void hover(const model_t *m, const double command_N[ROTORS], double f_N, double dydt[RIGID_N]) {
  rigid_t r = {.mass_kg = m->mass_kg,
               .inertia_kgm2 = d3_of(m->frame.inertia_kgm2),
               .torque_ratio_m = m->frame.torque_ratio_m,
               .kf_Ns2 = m->frame.kf_Ns2,
               .rotor_inertia_kgm2 = m->frame.rotor_inertia_kgm2,
               .motor_tau_s = m->motor_tau_s,
               .thrust_scale = {1.0, 1.0, 1.0, 1.0}};
  const double ratio[ROTORS] = {1.0, 1.0, 1.0, 1.0};
  double y[RIGID_N] = {[RIGID_Q_WB] = 1.0};
  for (int i = 0; i < ROTORS; i++) {
    r.rotor_x_m[i] = m->frame.rotor_x_m[i];
    r.rotor_y_m[i] = m->frame.rotor_y_m[i];
    r.rotor_z_m[i] = 0.013;
    r.spin[i] = m->frame.rotor_spin[i];
    r.command_N[i] = command_N[i];
    y[RIGID_THRUST_N + i] = f_N;
  }
  const double turning[ROTORS] = {1.0, 1.0, 1.0, 1.0};
  double speed[ROTORS];
  rigid_tune(&r);
  rigid_rotor_radps(&r, y + RIGID_THRUST_N, speed);
  const load_t none = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  const axes_t axes = axes_of(dq_of(y + RIGID_Q_WB));
  rigid_derivative(&r, y, &axes, speed, ratio, turning, &none, dydt);
}

TEST(hover_is_an_equilibrium) {
  const model_t m = vehicle6(HUGE_VAL);
  const double f = WEIGHT_N / 4.0, command_N[ROTORS] = {f, f, f, f};
  double dydt[RIGID_N];
  hover(&m, command_N, f, dydt);
  for (int i = 0; i < RIGID_N; i++) {
    ROW("state %d", i);
    CHECK_NEAR(dydt[i], 0.0, 1e-14);
  }
}

TEST(yaw_is_turned_against_the_rotors_by_drag_and_by_their_acceleration) {
  // 2 and 4 turn right: more of them turns the body left. At once by the rotors' inertia, I Om' / J with
  // Om' = f' / (2 sqrt(kf f)); then by the torque, c f / J.
  const model_t m = vehicle6(HUGE_VAL);
  const frame_t *p = &m.frame;
  const double f = WEIGHT_N / 4.0, more = 1.1 * f, less = 0.9 * f;
  const double command_N[ROTORS] = {less, more, less, more};
  double dydt[RIGID_N];
  hover(&m, command_N, f, dydt);
  const double speedup = 0.1 * f / m.motor_tau_s / (2.0 * sqrt(p->kf_Ns2 * f));
  CHECK_NEAR(dydt[RIGID_RATE_RADPS + 2], 4.0 * p->rotor_inertia_kgm2 * speedup / p->inertia_kgm2[2], 1e-9);
  CHECK(dydt[RIGID_RATE_RADPS + 2] > 0.0);
  body_start_t start = vehicle6_start(&m, 5.0, 1.0);
  for (int i = 0; i < ROTORS; i++) start.thrust_N[i] = command_N[i];
  body_t b;
  if (!CHECK_OK(body_open(&b, &m, INTEGRATE_RK4, 0.002, &start))) return;
  body_tick(&b, command_N, 0.1);
  const double want = 0.1 * 4.0 * 0.1 * f * p->torque_ratio_m / p->inertia_kgm2[2];
  CHECK_NEAR(b.y[RIGID_RATE_RADPS + 2], want, 1e-9 * want);
  body_close(&b);
}

TEST(roll_and_pitch_follow_the_rotors_that_push) {
  const model_t m = vehicle6(HUGE_VAL);
  const double f = WEIGHT_N / 4.0, command_N[ROTORS] = {f, f, f, f};
  double dydt[RIGID_N];
  model_t tilted = m;
  // One rotor moved outwards by 10 mm does what 10 mm times its thrust does.
  tilted.frame.rotor_y_m[2] += 0.01;
  hover(&tilted, command_N, f, dydt);
  CHECK_NEAR(dydt[RIGID_RATE_RADPS], 0.01 * f / 16.8e-6, 1e-9); // left side up: +x
  tilted = m;
  tilted.frame.rotor_x_m[0] += 0.01;
  hover(&tilted, command_N, f, dydt);
  CHECK_NEAR(dydt[RIGID_RATE_RADPS + 1], -0.01 * f / 16.8e-6, 1e-9); // nose up: -y
}

TEST(pwm_and_its_inverse_agree_and_are_limited) {
  const thrust_map_t map = {THRUST_MAP_VOLT_CUBIC, {-0.01483074, 0.04724465, -0.01847364, 0.00596092, 0.0}};
  // spec: hover at 32.9 g is pwm 0.59 / 0.67 / 0.76 at 4.2 / 3.7 / 3.3 V
  CHECK_NEAR(rotor_pwm(&map, 0.0807, 4.2, 0.12) / 65535.0, 0.59, 0.01);
  CHECK_NEAR(rotor_pwm(&map, 0.0807, 3.7, 0.12) / 65535.0, 0.67, 0.01);
  CHECK_NEAR(rotor_pwm(&map, 0.0807, 3.3, 0.12) / 65535.0, 0.76, 0.01);
  CHECK_NEAR(rotor_command_N(&map, rotor_pwm(&map, 0.05, 3.7, 0.12), 3.7, 0.12), 0.05, 1e-9);
  CHECK(rotor_command_N(&map, 1e9, 4.0, 0.12) == rotor_command_N(&map, 65535.0, 4.0, 0.12));
  CHECK(rotor_command_N(&map, -5.0, 4.0, 0.12) == 0.0);
  CHECK(rotor_command_N(&map, (double)NAN, 4.0, 0.12) == 0.0);
  CHECK(rotor_command_N(&map, 40000.0, 0.0, 0.12) == 0.0);
  const thrust_map_t none = {.kind = THRUST_MAP_NONE};
  CHECK_NEAR(rotor_command_N(&none, 32767.5, 4.0, 0.12), 0.06, 1e-12);
}

TEST(thrust_maps_say_what_they_need_and_give) {
  static const struct {
    const char *what;
    thrust_map_t map;
    double command, volt, want_N;
    bool speed, voltage;
  } row[] = {
      {"stand",
       {THRUST_MAP_STAND, {11.0933585, -39.0810417, -9.5256471, 20.5733023, 38.4288507}},
       32768.0,
       4.2,
       9.81e-3 * (11.0933585 - 0.5 * 39.0810417 - 9.5256471 + 0.25 * 20.5733023 + 0.5 * 38.4288507),
       false,
       true},
      {"volt cubic", {THRUST_MAP_VOLT_CUBIC, {0.01, 0.02, 0.03, 0.04, 0.0}}, 65535.0, 2.0, 0.49, false, true},
      {"pwm cubic",
       {THRUST_MAP_PWM_CUBIC, {0.01, 0.02, 0.03, 0.04, 0.0}},
       32767.5,
       0.0,
       0.0325,
       false,
       false},
      {"k w^2", {THRUST_MAP_SPEED, {0.0, 0.0, 2e-8, 0.0, 0.0}}, 2000.0, 0.0, 0.08, true, false},
      {"below zero", {THRUST_MAP_SPEED, {-1.0, 0.0, 2e-8, 0.0, 0.0}}, 2000.0, 0.0, 0.0, true, false},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    CHECK_NEAR(thrust_map_N(&row[i].map, row[i].command, row[i].volt), row[i].want_N, 1e-12);
    CHECK(thrust_map_takes_speed(&row[i].map) == row[i].speed);
    CHECK(thrust_map_needs_voltage(&row[i].map) == row[i].voltage);
  }
}
