// test_ceiling.c - the ceiling distance from a slow sensor: dynamics, gate, lock-out, age, bad samples.
#include "flight/ceiling.h"
#include "random.h"
#include "test.h"

#include <string.h>

static const ceiling_param_t P = {.gain = 0.1f, .floor_m = 0.043f, .near_m = 0.05f, .far_m = 0.5f};
static const float DT = 0.01f;
enum { EVERY = 10 }; // ticks per sample

// A vehicle that knows of a ceiling at zc_m.
static ceiling_t below(float zc_m) {
  ceiling_t s;
  ceiling_init(&s, DT);
  ceiling_predict(&s, &P, 0.0f);
  CHECK_OK(ceiling_correct(&s, &P, zc_m, 0.0f));
  return s;
}

// Ten ticks without motion, then a sample.
static void hover_and_look(ceiling_t *s, float range_m) {
  for (int i = 0; i < EVERY; i++) ceiling_predict(s, &P, 0.0f);
  CHECK_OK(ceiling_correct(s, &P, range_m, 0.0f));
}

TEST(ceiling_is_unknown_until_a_sample_shows_it) {
  ceiling_t s;
  ceiling_init(&s, DT);
  for (int i = 0; i < 100; i++) ceiling_predict(&s, &P, 0.001f);
  CHECK(!s.known);
  CHECK_OK(ceiling_correct(&s, &P, 0.3f, 0.0f));
  CHECK(s.known);
  CHECK(s.zc_m == 0.3f);
}

TEST(ceiling_moves_by_exactly_what_the_vehicle_climbs) {
  ceiling_t s = below(0.4f);
  ceiling_predict(&s, &P, 0.02f);
  CHECK_NEAR(s.zc_m, 0.38, 1e-7);
  ceiling_predict(&s, &P, -0.05f);
  CHECK_NEAR(s.zc_m, 0.43, 1e-7);
}

TEST(ceiling_error_falls_with_a_time_constant_of_0_95_s) {
  ceiling_t s = below(0.30f);
  for (int sample = 1; sample <= 30; sample++) {
    ROW("sample %d", sample);
    hover_and_look(&s, 0.40f);
    const double left = (0.40 - (double)s.zc_m) / 0.10;
    CHECK_NEAR(left, exp(-0.1 * sample / 0.95), 2e-3); // 0.95 is rounded from 0.949
    CHECK((left < 0.1) == (sample >= 22));
  }
}

TEST(ceiling_passes_white_noise_of_the_sensor_with_0_229) {
  ceiling_t s = below(0.3f);
  random_t r = {1};
  double square = 0.0;
  enum { SAMPLES = 100000 };
  for (int i = 0; i < SAMPLES + 100; i++) {
    CHECK_OK(ceiling_correct(&s, &P, (float)(0.3 + random_normal(&r, 0.01)), 0.0f));
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
    ceiling_t s = below(0.2f);
    ceiling_predict(&s, &P, 0.2f - row[i].estimate_m);
    const float before_m = s.zc_m;
    CHECK_OK(ceiling_correct(&s, &P, row[i].range_m, 0.0f));
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
    ceiling_t s = below(0.10f);
    for (int k = 0; k < 2; k++) ceiling_predict(&s, &P, 0.5f * row[i].climb_m);
    const float before_m = s.zc_m, now_m = row[i].range_m - row[i].climb_m;
    CHECK_OK(ceiling_correct(&s, &P, row[i].range_m, 0.02f));
    CHECK_NEAR(s.zc_m, before_m + (row[i].taken ? 0.1f * (now_m - before_m) : 0.0f), 1e-7);
    ROW("%s, first of all", row[i].what);
    ceiling_init(&s, DT);
    for (int k = 0; k < 2; k++) ceiling_predict(&s, &P, 0.5f * row[i].climb_m);
    CHECK_OK(ceiling_correct(&s, &P, row[i].range_m, 0.02f));
    CHECK(s.known == row[i].taken);
    if (s.known) CHECK_NEAR(s.zc_m, now_m, 1e-7);
  }
}

TEST(ceiling_height_is_constant_while_the_sensor_is_gated) {
  // Claim 14: below 5 cm, where the sensor reads its floor of 4 cm, height + zc does not move at all.
  ceiling_t s = below(0.20f);
  const double ceiling_m = 0.30 + 0.20;
  double height_m = 0.30, last_m = height_m, drift_m = 0.0;
  for (int tick = 0; tick < 6000; tick++) {
    height_m = tick < 100 ? 0.30 + 0.0017 * tick : 0.47 + 0.01 * sin(0.02 * (tick - 100));
    ceiling_predict(&s, &P, (float)(height_m - last_m));
    last_m = height_m;
    if (tick >= 100 && tick % EVERY == 0) {
      const double gap_m = ceiling_m - height_m;
      CHECK_OK(ceiling_correct(&s, &P, (float)fmax(gap_m, 0.04), 0.0f));
    }
    drift_m = fmax(drift_m, fabs(height_m + (double)s.zc_m - ceiling_m));
  }
  CHECK_NEAR(drift_m, 0.0, 1e-5); // 6000 roundings of 2e-9 m
  CHECK_NEAR(s.blind_s, 60.0, 0.1);
}

TEST(ceiling_lock_out_of_the_thesis_is_cured_in_half_a_second) {
  // Errata E20, faults row 20: the estimate is wrongly at 4 cm, the sensor sees 30 cm.
  static const struct {
    const char *what;
    double climb_mps, sd_m, delay_s;
  } row[] = {{"still", 0, 0, 0},
             {"noise of 3 mm", 0, 0.003, 0},
             {"sinking at 0.02 m/s", -0.02, 0.003, 0},
             {"climbing at 0.2 m/s, sample 100 ms old", 0.2, 0.003, 0.1}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    random_t rnd = {2};
    ceiling_t s = below(0.10f);
    ceiling_predict(&s, &P, 0.06f);
    double gap_m = 0.30;
    for (int tick = 1; tick <= 50; tick++) {
      gap_m -= row[i].climb_mps * (double)DT;
      ceiling_predict(&s, &P, (float)(row[i].climb_mps * (double)DT));
      if (tick % EVERY != 0) continue;
      const double then_m = gap_m + row[i].climb_mps * row[i].delay_s;
      CHECK_OK(
          ceiling_correct(&s, &P, (float)(then_m + random_normal(&rnd, row[i].sd_m)), (float)row[i].delay_s));
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
    ceiling_t s = below(0.10f);
    ceiling_predict(&s, &P, 0.06f);
    for (int k = 0; k < 6; k++) hover_and_look(&s, row[i].range_m[k]);
    CHECK_NEAR(s.zc_m, row[i].overruled ? 0.3033 : 0.04, 1e-3);
  }
}

TEST(ceiling_estimate_that_is_wrongly_far_comes_down_when_the_sensor_says_near) {
  // The other lock-out: the estimate stands at 20 cm and the vehicle is near. Below 4 cm the sensor says 4 cm
  // whatever the distance, but that the ceiling is no farther than that is certain.
  static const float range_m[] = {0.048f, 0.045f, 0.04f, 0.03f};
  for (unsigned i = 0; i < sizeof range_m / sizeof *range_m; i++) {
    ROW("sensor says %g m", (double)range_m[i]);
    ceiling_t s = below(0.20f);
    for (int k = 0; k < 30; k++) hover_and_look(&s, range_m[i]);
    CHECK(s.known);
    CHECK(s.zc_m < P.near_m + 0.01f);
  }
}

// Flies up and down at speed_mps between gaps of 45 and 8 cm; the worst error of the estimate.
static double worst_error_m(double speed_mps, int every, int delay, bool age_given, int seed) {
  ceiling_t s;
  ceiling_init(&s, DT);
  random_t r = {(uint64_t)seed};
  double gap[1000], worst = 0.0;
  double direction = 1.0;
  gap[0] = 0.45;
  for (int k = 1; k < 1000; k++) {
    if (gap[k - 1] < 0.08) direction = -1.0;
    if (gap[k - 1] > 0.45) direction = 1.0;
    const double climb_m = direction * speed_mps * (double)DT;
    gap[k] = gap[k - 1] - climb_m;
    ceiling_predict(&s, &P, (float)climb_m);
    if (k >= delay && k % every == 0 && random_bits(&r) % 8 != 0) { // one in eight is missed
      const float range_m = (float)gap[k - delay], age_s = age_given ? (float)delay * DT : 0.0f;
      CHECK_OK(ceiling_correct(&s, &P, range_m, age_s));
      // One in eight is announced twice.
      if (random_bits(&r) % 8 == 0) CHECK_OK(ceiling_correct(&s, &P, range_m, age_s));
    }
    if (s.known) worst = fmax(worst, fabs((double)s.zc_m - gap[k]));
  }
  CHECK(s.known);
  return worst;
}

TEST(ceiling_uses_the_age_of_a_sample) {
  // Faults row 21.
  for (int delay = 5; delay <= 13; delay += 2)
    for (int every = 5; every <= 20; every += 5) {
      ROW("%d ms old, every %d ms", 10 * delay, 10 * every);
      CHECK_NEAR(worst_error_m(0.3, every, delay, true, 3), 0.0, 0.02);
    }
  ROW("130 ms old and taken for new");
  CHECK(worst_error_m(0.3, EVERY, 13, false, 3) > 0.03);
}

TEST(ceiling_takes_any_age) {
  static const struct {
    const char *what;
    float age_s;
    double moved_m; // since the sample, at 1 cm per tick
  } row[] = {{"now", 0.0f, 0.0},
             {"one tick", 0.01f, 0.01},
             {"rounded up to ticks", 0.0251f, 0.03},
             {"rounded down to ticks", 0.0249f, 0.02},
             {"31 ticks", 0.31f, 0.31},
             {"too old", 0.4f, 0.31},
             {"1e38", 1e38f, 0.31}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++)
    for (int ticks = 40; ticks <= 75; ticks += 5) { // the ring's newest is anywhere
      ROW("%s, %d ticks", row[i].what, ticks);
      ceiling_t s;
      ceiling_init(&s, DT);
      for (int k = 0; k < ticks; k++) ceiling_predict(&s, &P, -0.01f);
      CHECK_OK(ceiling_correct(&s, &P, 0.1f, row[i].age_s));
      CHECK_NEAR(s.zc_m, 0.1 + row[i].moved_m, 1e-6);
    }
}

TEST(ceiling_refuses_an_age_that_is_none) {
  static const float age_s[] = {NAN, INFINITY, -INFINITY, -0.01f};
  for (unsigned i = 0; i < sizeof age_s / sizeof *age_s; i++) {
    ROW("age %g s", (double)age_s[i]);
    ceiling_t s;
    ceiling_init(&s, DT);
    CHECK_OK(ceiling_correct(&s, &P, 0.3f, 0.0f));
    CHECK_STATUS(ST_BAD_RANGE, ceiling_correct(&s, &P, 0.1f, age_s[i]));
    CHECK(s.zc_m == 0.3f);
  }
}

TEST(ceiling_remembers_a_climb_over_missed_periods_as_an_even_one) {
  static const int periods[] = {1, 7, 31, 32, 33, 500};
  for (unsigned i = 0; i < sizeof periods / sizeof *periods; i++) {
    ROW("%d periods", periods[i]);
    const int n = periods[i];
    ceiling_t once, even;
    ceiling_init(&once, DT);
    ceiling_init(&even, DT);
    CHECK_OK(ceiling_correct(&once, &P, 0.45f, 0.0f));
    CHECK_OK(ceiling_correct(&even, &P, 0.45f, 0.0f));
    ceiling_predict_over(&once, &P, 0.2f, n);
    for (int k = 0; k < n; k++) ceiling_predict(&even, &P, 0.2f / (float)n);
    CHECK_NEAR(once.zc_m, even.zc_m, 1e-4);
    CHECK_NEAR(once.blind_s, even.blind_s, 1e-3);
  }
}

TEST(ceiling_keeps_its_estimate_when_a_sample_is_no_distance) {
  // Faults rows 13, 14, 22.
  static const struct {
    const char *what;
    float range_m;
  } row[] = {{"no echo", 32.767f},
             {"never started", 0.0f},
             {"minus zero", -0.0f},
             {"negative", -0.3f},
             {"nan", NAN},
             {"infinite", INFINITY},
             {"minus infinite", -INFINITY},
             {"millimetres", 300.0f},
             {"1e38", 1e38f},
             {"beyond the sensor", 4.01f}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    ceiling_t s = below(0.3f);
    for (int k = 0; k < 5; k++) ceiling_predict(&s, &P, 0.01f);
    const ceiling_t before = s;
    CHECK_STATUS(ST_BAD_RANGE, ceiling_correct(&s, &P, row[i].range_m, 0.0f));
    CHECK(memcmp(&s, &before, sizeof s) == 0);
    ROW("%s, first of all", row[i].what);
    ceiling_init(&s, DT);
    CHECK_STATUS(ST_BAD_RANGE, ceiling_correct(&s, &P, row[i].range_m, 0.0f));
    CHECK(!s.known);
  }
}

TEST(ceiling_is_not_made_known_by_a_sample_that_is_not_believed) {
  static const float range_m[] = {0.0003f, 0.01f, 0.0499f}; // the first: 0.3 m in kilometres, so to speak
  for (unsigned i = 0; i < sizeof range_m / sizeof *range_m; i++) {
    ROW("%g m", (double)range_m[i]);
    ceiling_t s;
    ceiling_init(&s, DT);
    for (int k = 0; k < 10; k++) hover_and_look(&s, range_m[i]);
    CHECK(!s.known);
    ROW("%g m, after a ceiling that went out of sight", (double)range_m[i]);
    s = below(0.4f);
    for (int k = 0; k < 20; k++) ceiling_predict(&s, &P, -0.01f);
    for (int k = 0; k < 10; k++) hover_and_look(&s, range_m[i]);
    CHECK(!s.known);
  }
}

TEST(ceiling_beyond_far_is_no_ceiling) {
  ceiling_t s;
  ceiling_init(&s, DT);
  hover_and_look(&s, 3.9f);
  CHECK(!s.known);
  hover_and_look(&s, 0.5f);
  CHECK(!s.known);
  hover_and_look(&s, 0.4999f);
  CHECK(s.known);
  ROW("sunk away from it");
  for (int i = 0; i < 10; i++) ceiling_predict(&s, &P, -0.01f);
  CHECK(!s.known);
  ROW("back again");
  hover_and_look(&s, 0.2f);
  CHECK(s.known);
  CHECK(s.zc_m == 0.2f);
}

TEST(ceiling_distance_is_never_negative) {
  ceiling_t s = below(0.06f);
  for (int i = 0; i < 20; i++) {
    ceiling_predict(&s, &P, 0.01f);
    CHECK(s.zc_m >= 0.0f && s.known);
  }
  ROW("a ring of descents and a sample that is older than them");
  s = below(0.3f);
  for (int i = 0; i < 40; i++) ceiling_predict(&s, &P, 0.02f);
  CHECK_OK(ceiling_correct(&s, &P, 0.06f, 0.3f));
  CHECK(s.zc_m >= 0.0f);
}

TEST(ceiling_counts_the_time_without_a_sample) {
  ceiling_t s = below(0.3f);
  CHECK(s.blind_s == 0.0f);
  for (int i = 0; i < 100; i++) ceiling_predict(&s, &P, 0.0f);
  CHECK_NEAR(s.blind_s, 1.0, 1e-5);
  CHECK_OK(ceiling_correct(&s, &P, 0.3f, 0.0f));
  CHECK(s.blind_s == 0.0f);
}
