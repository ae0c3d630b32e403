// test_ceiling.c - the ceiling distance from a slow sensor: dynamics, gate, lock-out, limits.
#include "rig/below.h"
#include "rig/splitmix.h"

TEST(ceiling_is_unknown_until_a_sample_shows_it) {
  ceiling_t s;
  ceiling_init(&s, BELOW_PERIOD_S);
  for (int i = 0; i < 100; i++) ceiling_predict(&s, &below_param, 0.001f);
  CHECK(!s.known);
  CHECK_OK(ceiling_correct(&s, &below_param, 0.3f, 0.0f));
  CHECK(s.known);
  CHECK(s.zc_m == 0.3f);
}

TEST(ceiling_takes_the_vehicle_for_level_until_it_is_told) {
  ceiling_t s;
  ceiling_init(&s, BELOW_PERIOD_S);
  CHECK(ceiling_up(&s, 0.1f) == 1.0f);
  ceiling_tilt(&s, 0.9f);
  CHECK(ceiling_up(&s, 0.1f) == 0.9f);
}

TEST(ceiling_moves_by_exactly_what_the_vehicle_climbs) {
  ceiling_t s = below_ceiling(0.4f);
  ceiling_predict(&s, &below_param, 0.02f);
  CHECK_NEAR(s.zc_m, 0.38, 1e-7);
  ceiling_predict(&s, &below_param, -0.05f);
  CHECK_NEAR(s.zc_m, 0.43, 1e-7);
}

TEST(ceiling_error_falls_with_a_time_constant_of_0_95_s) {
  ceiling_t s = below_ceiling(0.36f); // not so far off that it would be another ceiling
  for (int sample = 1; sample <= 30; sample++) {
    ROW("sample %d", sample);
    below_hover_and_look(&s, 0.40f);
    const double left = (0.40 - (double)s.zc_m) / 0.04;
    CHECK_NEAR(left, exp(-0.1 * sample / 0.95), 2e-3); // 0.95 is rounded from 0.949
    CHECK((left < 0.1) == (sample >= 22));
  }
}

TEST(ceiling_passes_white_noise_of_the_sensor_with_0_229) {
  ceiling_t s = below_ceiling(0.3f);
  splitmix_t r = {1};
  double square = 0.0;
  enum { SAMPLES = 100000 };
  for (int i = 0; i < SAMPLES + 100; i++) {
    CHECK_OK(ceiling_correct(&s, &below_param, (float)(0.3 + splitmix_normal(&r, 0.01)), 0.0f));
    if (i >= 100) square += pow((double)s.zc_m - 0.3, 2.0);
  }
  CHECK_NEAR(sqrt(square / SAMPLES) / 0.01, 0.229, 0.004); // 1 % is what 100000 correlated samples tell
}

TEST(ceiling_gate_acts_on_the_sample_and_on_the_estimate) {
  static const struct {
    const char *what;
    float estimate_m, range_m;
    bool taken;
  } row[] = {
      {"both far", 0.20f, 0.21f, true},
      {"sensor's floor", 0.20f, 0.04f, false},
      {"sample just below the floor", 0.06f, 0.0429f, false},
      {"sample just above it", 0.06f, 0.0431f, true},
      {"estimate just far enough", 0.0501f, 0.0431f, true},
      {"estimate just too near", 0.0499f, 0.0501f, false},
      {"both too near", 0.045f, 0.046f, false},
      {"contact", 0.0f, 0.04f, false},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    ceiling_t s = below_ceiling(0.2f);
    ceiling_predict(&s, &below_param, 0.2f - row[i].estimate_m);
    const float before_m = s.zc_m;
    CHECK_OK(ceiling_correct(&s, &below_param, row[i].range_m, 0.0f));
    CHECK_NEAR(s.zc_m, before_m + (row[i].taken ? 0.1f * (row[i].range_m - before_m) : 0.0f), 1e-7);
    CHECK((s.blind_s == 0.0f) == row[i].taken);
  }
}

TEST(ceiling_gate_looks_at_what_the_sensor_read_not_at_what_that_means_now) {
  static const struct {
    const char *what;
    float climb_m, range_m; // climbed since the sample, in two ticks
    bool taken;
  } row[] = {{"read 7 cm, now at 4 cm", 0.03f, 0.07f, true},
             {"read 4 cm, now at 7 cm", -0.03f, 0.04f, false}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    ceiling_t s = below_ceiling(0.10f);
    for (int k = 0; k < 2; k++) ceiling_predict(&s, &below_param, 0.5f * row[i].climb_m);
    const float before_m = s.zc_m, now_m = row[i].range_m - row[i].climb_m;
    CHECK_OK(ceiling_correct(&s, &below_param, row[i].range_m, 0.02f));
    CHECK_NEAR(s.zc_m, before_m + (row[i].taken ? 0.1f * (now_m - before_m) : 0.0f), 1e-7);
    ROW("%s, first of all", row[i].what);
    ceiling_init(&s, BELOW_PERIOD_S);
    for (int k = 0; k < 2; k++) ceiling_predict(&s, &below_param, 0.5f * row[i].climb_m);
    CHECK_OK(ceiling_correct(&s, &below_param, row[i].range_m, 0.02f));
    CHECK(s.known == row[i].taken);
    if (s.known) CHECK_NEAR(s.zc_m, now_m, 1e-7);
  }
}

TEST(ceiling_height_is_constant_while_the_sensor_is_gated) {
  // Claim 14: below 5 cm, where the sensor reads its floor of 4 cm, height + zc does not move at all.
  ceiling_t s = below_ceiling(0.20f);
  const double ceiling_m = 0.30 + 0.20;
  double height_m = 0.30, last_m = height_m, drift_m = 0.0;
  for (int tick = 0; tick < 6000; tick++) {
    height_m = tick < 100 ? 0.30 + 0.0017 * tick : 0.47 + 0.01 * sin(0.02 * (tick - 100));
    ceiling_predict(&s, &below_param, (float)(height_m - last_m));
    last_m = height_m;
    if (tick >= 100 && tick % BELOW_EVERY == 0) {
      const double gap_m = ceiling_m - height_m;
      CHECK_OK(ceiling_correct(&s, &below_param, (float)fmax(gap_m, 0.04), 0.0f));
    }
    drift_m = fmax(drift_m, fabs(height_m + (double)s.zc_m - ceiling_m));
  }
  CHECK_NEAR(drift_m, 0.0, 1e-5); // 6000 roundings of 2e-9 m
  CHECK_NEAR(s.blind_s, 60.0, 0.1);
}

TEST(ceiling_lock_out_of_the_thesis_is_cured_in_half_a_second) {
  // Fault 20: the estimate is wrongly at 4 cm, the sensor sees 30 cm.
  static const struct {
    const char *what;
    double climb_mps, sd_m, delay_s;
  } row[] = {{"still", 0, 0, 0},
             {"noise of 3 mm", 0, 0.003, 0},
             {"sinking at 0.02 m/s", -0.02, 0.003, 0},
             {"climbing at 0.2 m/s, sample 100 ms old", 0.2, 0.003, 0.1}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    splitmix_t rnd = {2};
    ceiling_t s = below_ceiling(0.10f);
    ceiling_predict(&s, &below_param, 0.06f);
    double gap_m = 0.30;
    for (int tick = 1; tick <= 50; tick++) {
      gap_m -= row[i].climb_mps * (double)BELOW_PERIOD_S;
      ceiling_predict(&s, &below_param, (float)(row[i].climb_mps * (double)BELOW_PERIOD_S));
      if (tick % BELOW_EVERY != 0) continue;
      const double then_m = gap_m + row[i].climb_mps * row[i].delay_s;
      CHECK_OK(ceiling_correct(&s, &below_param, (float)(then_m + splitmix_normal(&rnd, row[i].sd_m)),
                               (float)row[i].delay_s));
    }
    CHECK_NEAR(s.zc_m, gap_m, 0.01);
  }
}

TEST(ceiling_estimate_is_not_overruled_by_samples_that_contradict_each_other) {
  static const struct {
    const char *what;
    float range_m[6];
    bool overruled;
  } row[] = {
      {"two agree", {0.3f, 0.3f, 0.04f, 0.3f, 0.3f, 0.04f}, false},
      {"each one elsewhere", {0.10f, 0.20f, 0.30f, 0.40f, 0.15f, 0.25f}, false},
      {"two and two", {0.1f, 0.1f, 0.3f, 0.3f, 0.1f, 0.1f}, false},
      {"three agree after a stray one", {0.1f, 0.3f, 0.3f, 0.31f, 0.04f, 0.04f}, true},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    ceiling_t s = below_ceiling(0.10f);
    ceiling_predict(&s, &below_param, 0.06f);
    for (int k = 0; k < 6; k++) below_hover_and_look(&s, row[i].range_m[k]);
    CHECK_NEAR(s.zc_m, row[i].overruled ? 0.3033 : 0.04, 1e-3);
  }
}

TEST(ceiling_estimate_that_is_wrongly_far_comes_down_when_the_sensor_says_near) {
  // The other lock-out: the estimate stands at 20 cm and the vehicle is near. Below 4 cm the sensor says 4 cm
  // whatever the distance, but that the ceiling is no farther than that is certain.
  static const float range_m[] = {0.048f, 0.045f, 0.04f, 0.03f};
  for (unsigned i = 0; i < sizeof range_m / sizeof *range_m; i++) {
    ROW("sensor says %g m", (double)range_m[i]);
    ceiling_t s = below_ceiling(0.20f);
    for (int k = 0; k < 30; k++) below_hover_and_look(&s, range_m[i]);
    CHECK(s.known);
    CHECK(s.zc_m < below_param.near_m + 0.01f);
  }
}

TEST(ceiling_that_was_overruled_takes_three_more_samples_to_be_overruled_again) {
  // The sensor sits at its floor while the vehicle goes down: each sample means a distance that is farther.
  ceiling_t s = below_ceiling(0.3f);
  for (int sample = 1; sample <= 6; sample++) {
    ROW("sample %d", sample);
    for (int i = 0; i < BELOW_EVERY; i++) ceiling_predict(&s, &below_param, -0.0005f);
    CHECK_OK(ceiling_correct(&s, &below_param, 0.042f, 0.1f));
    CHECK((s.blind_s == 0.0f) == (sample % 3 == 0));
  }
}

TEST(ceiling_beyond_far_is_no_ceiling) {
  ceiling_t s;
  ceiling_init(&s, BELOW_PERIOD_S);
  below_hover_and_look(&s, 3.9f);
  CHECK(!s.known);
  below_hover_and_look(&s, 0.5f);
  CHECK(!s.known);
  below_hover_and_look(&s, 0.4999f);
  CHECK(s.known);
  ROW("sunk away from it");
  for (int i = 0; i < 10; i++) ceiling_predict(&s, &below_param, -0.01f);
  CHECK(!s.known);
  ROW("back again");
  below_hover_and_look(&s, 0.2f);
  CHECK(s.known);
  CHECK(s.zc_m == 0.2f);
}

TEST(ceiling_distance_is_never_negative) {
  ceiling_t s = below_ceiling(0.06f);
  for (int i = 0; i < 20; i++) {
    ceiling_predict(&s, &below_param, 0.01f);
    CHECK(s.zc_m >= 0.0f && s.known);
  }
  ROW("a ring of descents and a sample that is older than them");
  s = below_ceiling(0.3f);
  for (int i = 0; i < 40; i++) ceiling_predict(&s, &below_param, 0.02f);
  CHECK_OK(ceiling_correct(&s, &below_param, 0.06f, 0.3f));
  CHECK(s.zc_m >= 0.0f);
}

TEST(ceiling_counts_the_time_without_a_sample) {
  ceiling_t s = below_ceiling(0.3f);
  CHECK(s.blind_s == 0.0f);
  for (int i = 0; i < 100; i++) ceiling_predict(&s, &below_param, 0.0f);
  CHECK_NEAR(s.blind_s, 1.0, 1e-5);
  CHECK_OK(ceiling_correct(&s, &below_param, 0.3f, 0.0f));
  CHECK(s.blind_s == 0.0f);
}

TEST(ceiling_counts_rivals_from_0_where_the_sign_of_their_count_flipped) {
  static const int rivals[] = {-1, -2, INT32_MIN};
  for (unsigned i = 0; i < sizeof rivals / sizeof *rivals; i++) {
    ROW("%d rivals", rivals[i]);
    ceiling_t s = below_ceiling(0.10f);
    s.rivals = rivals[i];
    for (int k = 0; k < 3; k++) {
      CHECK(s.zc_m == 0.10f);
      CHECK_OK(ceiling_correct(&s, &below_param, 0.4f, 0.0f));
    }
    CHECK(s.zc_m == 0.4f && s.rivals == 0);
  }
}
