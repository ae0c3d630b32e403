// test_mixer.c - torques and thrust to four motor forces.
#include "flight/mixer.h"
#include "random.h"
#include "test.h"

static const mixer_param_t P = {.arm_m = 0.0325f, .yaw_m = 0.00735f, .force_max_N = 0.12f};

TEST(mixer_gives_what_can_be_had) {
  static const struct {
    const char *what;
    v3_t torque_Nm;
    float thrust_N;
  } row[] = {
      {"hover", {0, 0, 0}, 0.32f},
      {"roll", {1e-3f, 0, 0}, 0.32f},
      {"pitch", {0, -1e-3f, 0}, 0.32f},
      {"yaw", {0, 0, 2e-4f}, 0.32f},
      {"all", {5e-4f, -7e-4f, -1e-4f}, 0.25f},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    const mixer_out_t out = mixer_mix(&P, row[i].torque_Nm, row[i].thrust_N);
    CHECK_NEAR(out.torque_b_Nm.x, row[i].torque_Nm.x, 1e-8);
    CHECK_NEAR(out.torque_b_Nm.y, row[i].torque_Nm.y, 1e-8);
    CHECK_NEAR(out.torque_b_Nm.z, row[i].torque_Nm.z, 1e-8);
    CHECK_NEAR(out.thrust_N, row[i].thrust_N, 1e-6);
    CHECK(!out.gave_up_tilt && !out.gave_up_thrust && !out.gave_up_yaw);
  }
}

TEST(mixer_turns_the_right_motors_up) {
  // Motors: 1 front right, 2 back right, 3 back left, 4 front left; x forward, y left, z up.
  static const struct {
    const char *what;
    v3_t torque_Nm;
    int up[2];
  } row[] = {
      {"roll right side down", {1e-3f, 0, 0}, {2, 3}},
      {"nose down", {0, 1e-3f, 0}, {1, 2}},
      {"yaw to the left", {0, 0, 1e-4f}, {1, 3}},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    const mixer_out_t out = mixer_mix(&P, row[i].torque_Nm, 0.32f);
    for (int m = 0; m < MOTORS; m++)
      CHECK((out.force_N[m] > 0.08f) == (m == row[i].up[0] || m == row[i].up[1]));
  }
}

TEST(mixer_keeps_roll_and_pitch_before_thrust_before_yaw) {
  static const struct {
    const char *what;
    v3_t torque_Nm;
    float thrust_N;
    bool tilt, thrust, yaw; // given up
  } row[] = {
      {"too heavy", {2e-3f, 0, 0}, 0.48f, false, true, false},
      {"too heavy and yaw", {2e-3f, 0, 1e-4f}, 0.48f, false, true, true},
      {"falling", {2e-3f, -1e-3f, 0}, 0.0f, false, true, false},
      {"yaw alone too much", {0, 0, 5e-3f}, 0.32f, false, false, true},
      {"roll beyond everything", {1.0f, 0, 0}, 0.32f, true, true, false},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    const mixer_out_t out = mixer_mix(&P, row[i].torque_Nm, row[i].thrust_N);
    CHECK(out.gave_up_tilt == row[i].tilt && out.gave_up_thrust == row[i].thrust &&
          out.gave_up_yaw == row[i].yaw);
    if (!row[i].tilt) {
      CHECK_NEAR(out.torque_b_Nm.x, row[i].torque_Nm.x, 1e-7);
      CHECK_NEAR(out.torque_b_Nm.y, row[i].torque_Nm.y, 1e-7);
    }
    if (!row[i].thrust) CHECK_NEAR(out.thrust_N, row[i].thrust_N, 1e-6);
  }
}

TEST(mixer_stays_within_the_limits_whatever_is_asked_for) {
  random_t r = {.state = 11};
  for (int i = 0; i < 200000; i++) {
    const double size = pow(10.0, random_between(&r, -4.0, 3.0));
    const v3_t torque = {(float)random_normal(&r, 1e-2 * size), (float)random_normal(&r, 1e-2 * size),
                         (float)random_normal(&r, 1e-3 * size)};
    const mixer_out_t out = mixer_mix(&P, torque, (float)random_normal(&r, 0.3 * size));
    for (int m = 0; m < MOTORS; m++)
      if (!CHECK(out.force_N[m] >= 0.0f && out.force_N[m] <= P.force_max_N)) return;
    // Roll and pitch keep their direction, also where they cannot have their size.
    const double across = (double)(out.torque_b_Nm.x * torque.y - out.torque_b_Nm.y * torque.x);
    if (!CHECK_NEAR(across, 0.0, 1e-7 * size)) return;
  }
}
