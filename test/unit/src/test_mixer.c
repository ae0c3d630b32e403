// test_mixer.c - torques and thrust to four motor forces.
#include "flight/mixer.h"
#include "rig/splitmix.h"
#include "rig/test.h"

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
      {"all that there is", {0, 0, 0}, 0.48f, false, false, false},
      {"a micronewton more", {0, 0, 0}, 0.480001f, false, true, false},
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

// Numbers that formulas stumble over: zeros, limits, and what lies on both sides of them.
static float drawn(splitmix_t *r, double size, const float *special, int n_special) {
  const int pick = (int)splitmix_between(r, 0.0, 2.0 * n_special);
  return pick < n_special ? special[pick] : (float)splitmix_normal(r, size);
}

// What the order yaw, thrust, tilt leaves of roll and pitch (as forces of a motor), lift and yaw; in double.
typedef struct {
  double roll_N, pitch_N, lift_N, yaw_N;
} shares_t;

static shares_t shares_of(const mixer_param_t *p, v3_t torque_Nm, float thrust_N) {
  const double max = (double)p->force_max_N, arms_m = 4.0 * (double)p->arm_m;
  shares_t s = {(double)torque_Nm.x / arms_m, (double)torque_Nm.y / arms_m, 0.25 * (double)thrust_N,
                (double)torque_Nm.z / (4.0 * (double)p->yaw_m)};
  const double span = fabs(s.roll_N) + fabs(s.pitch_N), tilt = span > 0.5 * max ? 0.5 * max / span : 1.0;
  s.roll_N *= tilt;
  s.pitch_N *= tilt;
  s.lift_N = fmin(fmax(s.lift_N, tilt * span), max - tilt * span);
  const double same = fabs(s.roll_N + s.pitch_N), other = fabs(s.roll_N - s.pitch_N);
  const double left = fmin(s.lift_N - same, max - s.lift_N - other),
               right = fmin(s.lift_N - other, max - s.lift_N - same);
  s.yaw_N = fmin(fmax(s.yaw_N, -fmax(right, 0.0)), fmax(left, 0.0));
  return s;
}

static bool given(const mixer_out_t *out, const shares_t *want) {
  const double arms_m = 4.0 * (double)P.arm_m, tol_N = 1e-7;
  return CHECK_NEAR(out->torque_b_Nm.x, arms_m * want->roll_N, arms_m * tol_N) &&
         CHECK_NEAR(out->torque_b_Nm.y, arms_m * want->pitch_N, arms_m * tol_N) &&
         CHECK_NEAR(out->torque_b_Nm.z, 4.0 * (double)P.yaw_m * want->yaw_N, 4.0 * (double)P.yaw_m * tol_N) &&
         CHECK_NEAR(out->thrust_N, 4.0 * want->lift_N, 4.0 * tol_N);
}

TEST(mixer_gives_the_most_that_can_be_had_whatever_is_asked_for) {
  const float edge_Nm = 4.0f * P.arm_m * 0.5f * P.force_max_N, yaw_edge_Nm = 4.0f * P.yaw_m * P.force_max_N;
  const float tilts[] = {0.0f, -0.0f, edge_Nm, -edge_Nm, 0.5f * edge_Nm, -0.5f * edge_Nm, 1e-38f, 1e3f};
  const float yaws[] = {0.0f, 0.0f, -0.0f, -0.0f, yaw_edge_Nm, -yaw_edge_Nm, 1e-38f, -1e3f};
  const float thrusts[] = {0.0f, 4.0f * P.force_max_N, 0.5f * P.force_max_N, -1.0f, 0.47f, 0.32f};
  splitmix_t r = {.state = 11};
  for (int i = 0; i < 400000; i++) {
    const double size = pow(10.0, splitmix_between(&r, -4.0, 3.0));
    const v3_t torque = {drawn(&r, 1e-2 * size, tilts, 8), drawn(&r, 1e-2 * size, tilts, 8),
                         drawn(&r, 1e-3 * size, yaws, 8)};
    const float thrust_N = drawn(&r, 0.3 * size, thrusts, 6);
    ROW("%a %a %a Nm, %a N", (double)torque.x, (double)torque.y, (double)torque.z, (double)thrust_N);
    const mixer_out_t out = mixer_mix(&P, torque, thrust_N);
    for (int m = 0; m < MOTORS; m++)
      if (!CHECK(out.force_N[m] >= 0.0f && out.force_N[m] <= P.force_max_N)) return;
    const shares_t want = shares_of(&P, torque, thrust_N);
    if (!given(&out, &want)) return;
  }
}

TEST(mixer_stops_no_motor_where_yaw_is_zero_and_another_is_at_its_limit) {
  // 0/0 of a motor's room once stopped all four.
  for (int i = 1; i <= 400; i++) {
    const v3_t torque = {1e-5f * (float)i, 0.0f, 0.0f};
    ROW("roll %g Nm", (double)torque.x);
    const mixer_out_t out = mixer_mix(&P, torque, 0.47f);
    const shares_t want = shares_of(&P, torque, 0.47f);
    CHECK(given(&out, &want));
    CHECK(!out.gave_up_yaw && out.thrust_N > 0.35f);
  }
}

TEST(mixer_takes_what_is_no_number_for_nothing) {
  static const struct {
    const char *what;
    v3_t torque_Nm;
    float thrust_N, roll_Nm, pitch_Nm, yaw_Nm, given_N;
  } row[] = {
      {"roll NaN", {NAN, 0, 0}, 0.32f, 0.0f, 0.0f, 0.0f, 0.32f},
      {"pitch NaN", {1e-3f, NAN, 0}, 0.32f, 1e-3f, 0.0f, 0.0f, 0.32f},
      {"yaw NaN", {0, 1e-3f, NAN}, 0.32f, 0.0f, 1e-3f, 0.0f, 0.32f},
      {"thrust NaN", {1e-3f, 0, 0}, NAN, 1e-3f, 0.0f, 0.0f, 1e-3f / 0.0325f},
      {"thrust infinite", {1e-3f, 0, 0}, INFINITY, 1e-3f, 0.0f, 0.0f, 0.48f - 1e-3f / 0.0325f},
      {"roll infinite", {INFINITY, 0, 0}, 0.32f, 0.0078f, 0.0f, 0.0f, 0.24f},
      {"pitch the largest number", {0, -3e38f, 0}, 0.32f, 0.0f, -0.0078f, 0.0f, 0.24f},
      {"yaw the largest number", {0, 0, 3e38f}, 0.32f, 0.0f, 0.0f, 0.16f * 0.00735f, 0.32f},
      {"yaw infinite", {0, 0, -INFINITY}, 0.32f, 0.0f, 0.0f, -0.16f * 0.00735f, 0.32f},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    const mixer_out_t out = mixer_mix(&P, row[i].torque_Nm, row[i].thrust_N);
    CHECK_NEAR(out.torque_b_Nm.x, row[i].roll_Nm, 1e-8);
    CHECK_NEAR(out.torque_b_Nm.y, row[i].pitch_Nm, 1e-8);
    CHECK_NEAR(out.torque_b_Nm.z, row[i].yaw_Nm, 1e-8);
    CHECK_NEAR(out.thrust_N, row[i].given_N, 1e-6);
    CHECK(out.gave_up_thrust == !(fabsf(row[i].thrust_N - row[i].given_N) < 1e-6f));
  }
}

TEST(mixer_tells_what_forces_give) {
  const float force_N[MOTORS] = {0.01f, 0.02f, 0.04f, 0.08f};
  const mixer_out_t out = mixer_of(&P, force_N);
  CHECK_NEAR(out.thrust_N, 0.15, 1e-8);
  CHECK_NEAR(out.torque_b_Nm.x, 0.0325 * (-0.01 - 0.02 + 0.04 + 0.08), 1e-9);
  CHECK_NEAR(out.torque_b_Nm.y, 0.0325 * (-0.01 + 0.02 + 0.04 - 0.08), 1e-9);
  CHECK_NEAR(out.torque_b_Nm.z, 0.00735 * (-0.01 + 0.02 - 0.04 + 0.08), 1e-10);
  CHECK(!out.gave_up_yaw && !out.gave_up_thrust && !out.gave_up_tilt);
  for (int m = 0; m < MOTORS; m++) CHECK(out.force_N[m] == force_N[m]);
}
