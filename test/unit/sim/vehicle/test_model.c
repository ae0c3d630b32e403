// test_model.c - what follows of a model's numbers.
#include "rig/test.h"
#include "vehicle/model.h"

// Lift and moments are what was asked for, of rotors beside the axes and on them.
TEST(model_mix_gives_lift_and_moments_of_any_symmetric_frame) {
  static const struct {
    const char *what;
    double x_m[ROTORS], y_m[ROTORS], torque_ratio_m;
  } rows[] = {
      {"x", {0.03, -0.03, -0.03, 0.03}, {-0.03, -0.03, 0.03, 0.03}, 0.006},
      {"longer than wide", {0.10, -0.10, -0.10, 0.10}, {-0.05, -0.05, 0.05, 0.05}, 0.01},
      {"plus", {0.04, 0.0, -0.04, 0.0}, {0.0, -0.04, 0.0, 0.04}, 0.006},
      {"no torque", {0.04, 0.0, -0.04, 0.0}, {0.0, -0.04, 0.0, 0.04}, 0.0},
  };
  const double moment_Nm[3] = {1e-3, -2e-3, 3e-4};
  for (unsigned i = 0; i < sizeof rows / sizeof *rows; i++) {
    ROW("%s", rows[i].what);
    frame_t f = {.rotor_spin = {1, -1, 1, -1}, .torque_ratio_m = rows[i].torque_ratio_m};
    double more_N[ROTORS], lift_N = 0.0, x = 0.0, y = 0.0, z = 0.0;
    for (int k = 0; k < ROTORS; k++) f.rotor_x_m[k] = rows[i].x_m[k], f.rotor_y_m[k] = rows[i].y_m[k];
    model_mix(&f, 0.3, moment_Nm, more_N);
    for (int k = 0; k < ROTORS; k++) {
      lift_N += more_N[k];
      x += f.rotor_y_m[k] * more_N[k];
      y -= f.rotor_x_m[k] * more_N[k];
      z -= f.rotor_spin[k] * f.torque_ratio_m * more_N[k];
    }
    CHECK_NEAR(lift_N, 0.3, 1e-12);
    CHECK_NEAR(x, moment_Nm[0], 1e-12);
    CHECK_NEAR(y, moment_Nm[1], 1e-12);
    CHECK_NEAR(z, f.torque_ratio_m > 0.0 ? moment_Nm[2] : 0.0, 1e-12);
  }
}

TEST(model_mix_leaves_what_rotors_on_one_axis_cannot_turn) {
  frame_t f = {.rotor_x_m = {0.04, 0.02, -0.02, -0.04}};
  const double moment_Nm[3] = {1e-3, 0.0, 0.0};
  double more_N[ROTORS];
  model_mix(&f, 0.4, moment_Nm, more_N);
  for (int k = 0; k < ROTORS; k++) CHECK_NEAR(more_N[k], 0.1, 1e-12);
}

// Runge and Kutta's step bears 2.8 times the fastest rate: half of a time constant where that is least, which
// of rotors that go with the square of their speed is at full thrust.
TEST(model_s_step_is_half_of_the_shortest_time_constant) {
  static const struct {
    const char *what;
    double tau_s, down_over_up, square[2], thrust, want_s; // thrust: at most, over the weight
  } row[] = {{"up and down alike", 0.004, 1.0, {0.0, 0.0}, 4.0, 0.002},
             {"faster down", 0.004, 0.5, {0.0, 0.0}, 4.0, 0.001},
             {"the most that is asked for", 0.1, 1.0, {0.0, 0.0}, 4.0, 0.005},
             {"up by its square, twice the hover's speed", 0.004, 1.0, {1.0, 0.0}, 4.0, 0.001},
             {"half of it down by its square", 0.004, 1.0, {0.0, 0.5}, 9.0, 0.001},
             {"hardly more than the weight", 0.004, 1.0, {1.0, 1.0}, 1.0, 0.002},
             {"no lag", 0.0, 1.0, {0.0, 0.0}, 4.0, 0.005}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    const model_t m = {.mass_kg = 0.03,
                       .motor_tau_s = row[i].tau_s,
                       .motor_down_over_up = row[i].down_over_up,
                       .lag_in_speed = true,
                       .lag_square = {row[i].square[0], row[i].square[1]},
                       .thrust_max_N = row[i].thrust * 0.03 * 9.81};
    CHECK_NEAR(model_step_s(&m, 0.005), row[i].want_s, 1e-12);
  }
}
