// test_range.c - upward and downward range and flow: rates, ages, floor, reach, slant, noise.
#include "rig/kinematic.h"
#include "rig/test.h"
#include "sense/noise.h"
#include "sense/range.h"

static const range_param_t perfect = {0};

static truth_t at(double up_m, double down_m) {
  return (truth_t){.q_wb = {1.0, 0.0, 0.0, 0.0}, .up_m = up_m, .down_m = down_m, .motors = true};
}

TEST(range_up_is_sixty_to_eighty_ms_old_and_a_hundred_more_when_replaced) {
  // The distance grows by 1 mm each ms, so that the sample itself says how old it is.
  range_t s;
  range_init(&s);
  random_t *random = random_open(3);
  int count[RANGE_UP_AGE_MAX_MS + 1] = {0}, oldest = 0, fresh = 0, wrong = 0;
  for (int ms = 0; ms < 3000 * RANGE_UP_PERIOD_MS; ms++) {
    const truth_t truth = at(1e-3 * (100 + ms % 3000), 0.3);
    const range_sample_t out = range_step(&s, &perfect, random, &truth);
    if (ms < RANGE_UP_PERIOD_MS) {
      CHECK(out.up_mm == 0.0 && !out.up_new && out.up_age_ms == 0);
      continue;
    }
    const int age_ms = (100 + ms % 3000 - (int)lround(out.up_mm) + 3000) % 3000;
    wrong += age_ms != out.up_age_ms || out.up_new != (ms % RANGE_UP_PERIOD_MS == 0);
    oldest = age_ms > oldest ? age_ms : oldest;
    if (!out.up_new) continue;
    fresh++;
    if (CHECK(age_ms >= 60 && age_ms <= 80)) count[age_ms]++;
  }
  CHECK(wrong == 0);
  CHECK(fresh == 2999);
  CHECK(oldest >= 175 && oldest <= 179); // the tick after, it is replaced
  for (int age = 60; age <= 80; age++) CHECK(count[age] > 95 && count[age] < 195); // 143 expected, 4 sd
  random_close(random);
}

TEST(range_up_has_a_floor_a_reach_and_a_slant) {
  static const struct {
    const char *what;
    double up_m, want_mm;
  } row[] = {
      {"usual", 0.2, 200.0},
      {"floor", 0.04, 40.0},
      {"below the floor", 0.02, 40.0},
      {"contact", 0.0, 40.0},
      {"reach", 4.0, 4000.0},
      {"beyond", 4.001, 32767.0},
      {"open sky", HUGE_VAL, 32767.0},
      {"not a number", (double)NAN, 32767.0},
      {"20 deg below 20 cm", 0.2 / 0.93969262, 212.8356},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    range_t s;
    range_init(&s);
    random_t *random = random_open(1);
    range_sample_t out = {0};
    const truth_t truth = at(row[i].up_m, 0.3);
    for (int ms = 0; ms <= RANGE_UP_PERIOD_MS; ms++) out = range_step(&s, &perfect, random, &truth);
    CHECK(out.up_new);
    CHECK_NEAR(out.up_mm, row[i].want_mm, 1e-3);
    random_close(random);
  }
}

TEST(range_up_sees_a_tilted_vehicles_slant) {
  // Half a metre to the side in a second: 20 deg at most.
  const kinematic_t path = {
      .span_s = 1.0, .from_m = {0.0, 0.0, 0.5}, .to_m = {0.5, 0.0, 0.5}, .ceiling_m = 0.7};
  double tallest = 0.0;
  for (double t = 0.0; t < 1.0; t += 0.001) {
    const truth_t truth = kinematic_at(&path, t);
    const double up = dq_to_world(truth.q_wb, (d3_t){0.0, 0.0, 1.0}).z;
    CHECK_NEAR(truth.up_m * up, 0.2, 1e-9);
    tallest = fmax(tallest, truth.up_m);
  }
  CHECK(tallest > 0.205);
}

TEST(range_down_sees_the_nearest_ground_in_its_cone) {
  static const struct {
    double tilt_deg, cone_deg, want_m; // 0.5 m above level ground
  } row[] = {{0.0, 7.5, 0.5}, {5.0, 7.5, 0.5}, {20.0, 7.5, 0.512142}, {20.0, 0.0, 0.532089}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%g deg, cone %g deg", row[i].tilt_deg, row[i].cone_deg);
    const double deg = 3.14159265358979 / 180.0, tilt = row[i].tilt_deg * deg;
    range_t s;
    range_init(&s);
    random_t *random = random_open(1);
    const range_param_t p = {.down_cone_rad = row[i].cone_deg * deg};
    truth_t truth = at(1.0, 0.5 / cos(tilt));
    truth.q_wb = (dq_t){cos(0.5 * tilt), 0.0, sin(0.5 * tilt), 0.0};
    range_sample_t out = {0};
    for (int ms = 0; ms <= RANGE_DOWN_PERIOD_MS; ms++) out = range_step(&s, &p, random, &truth);
    CHECK(out.down_new);
    CHECK_NEAR(out.down_m, row[i].want_m, 1e-5);
    random_close(random);
  }
}

typedef struct {
  double mean, sd;
  int n;
} stat_t;

static void include(stat_t *s, double x) {
  s->mean += x;
  s->sd += x * x;
  s->n++;
}

static stat_t closed(stat_t s) {
  s.mean /= s.n;
  s.sd = sqrt(s.sd / s.n - s.mean * s.mean);
  return s;
}

TEST(range_noise_has_the_stated_size) {
  static const struct { double height_m, down_sd_m; } row[] = {{0.1, 0.0025}, {0.5, 0.0025}, {2.5, 0.005}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%g m", row[i].height_m);
    range_t s;
    range_init(&s);
    random_t *random = random_open(i + 1);
    stat_t up = {0}, down = {0}, flow = {0};
    const truth_t truth = at(0.5, row[i].height_m);
    for (int ms = 0; ms < 1000000; ms++) {
      const range_sample_t out = range_step(&s, &noise_find("real")->range, random, &truth);
      if (out.up_new) include(&up, 1e-3 * out.up_mm);
      if (out.down_new) include(&down, out.down_m);
      if (out.flow_new) include(&flow, out.flow_x);
    }
    up = closed(up), down = closed(down), flow = closed(flow);
    CHECK(up.n == 9999 && down.n == 39999 && flow.n == 99999);
    CHECK_NEAR(up.mean, 0.5, 1.5e-4);
    CHECK_NEAR(up.sd, 0.003, 1e-4);
    CHECK_NEAR(down.mean, row[i].height_m, 1e-4);
    CHECK_NEAR(down.sd, hypot(row[i].down_sd_m, 0.001 / sqrt(12.0)), 5e-5); // whole millimetres
    CHECK_NEAR(flow.sd, hypot(2.0, 1.0 / sqrt(12.0)), 0.02);
    random_close(random);
  }
}

TEST(range_down_is_thirteen_ms_old_and_far_away_without_ground) {
  range_t s;
  range_init(&s);
  random_t *random = random_open(3);
  for (int ms = 0; ms < 2000; ms++) {
    const truth_t truth = at(HUGE_VAL, 0.2 + 1e-3 * ms);
    const range_sample_t out = range_step(&s, &perfect, random, &truth);
    CHECK(out.down_new == (ms > 0 && ms % 25 == 0));
    if (out.down_new) CHECK_NEAR(out.down_m, 0.2 + 1e-3 * (ms - 13), 1e-9);
  }
  for (int ms = 0; ms < 100; ms++) {
    const truth_t truth = at(HUGE_VAL, ms < 50 ? HUGE_VAL : 4.5);
    const range_sample_t out = range_step(&s, &perfect, random, &truth);
    if (out.down_new && ms > 25) CHECK(out.down_m > 5.0); // as the firmware's outliers
  }
  random_close(random);
}

TEST(flow_counts_angles_of_motion_and_of_turning) {
  static const struct {
    const char *what;
    d3_t vel, rate;
    double down_m, x_per_s, y_per_s; // radians of the image
  } row[] = {
      {"forward", {0.5, 0.0, 0.0}, {0.0, 0.0, 0.0}, 0.5, 1.0, 0.0},
      {"left", {0.0, 0.3, 0.0}, {0.0, 0.0, 0.0}, 0.6, 0.0, 0.5},
      {"nose going down", {0.0, 0.0, 0.0}, {0.0, 0.2, 0.0}, 0.6, -0.2, 0.0},
      {"left side going up", {0.0, 0.0, 0.0}, {0.2, 0.0, 0.0}, 0.6, 0.0, 0.2},
      {"no ground", {1.0, 1.0, 0.0}, {0.0, 0.0, 0.0}, HUGE_VAL, 0.0, 0.0},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    for (int round = 0; round < 2; round++) {
      range_t s;
      range_init(&s);
      random_t *random = random_open(3);
      truth_t truth = at(1.0, row[i].down_m);
      truth.vel_w_mps = row[i].vel;
      truth.rate_b_radps = row[i].rate;
      const range_param_t p = {.rounding = round};
      double x = 0.0, y = 0.0, span_s = 0.0;
      for (int ms = 0; ms <= 1000; ms++) {
        const range_sample_t out = range_step(&s, &p, random, &truth);
        if (out.flow_new) x += out.flow_x, y += out.flow_y, span_s += out.flow_span_s;
      }
      CHECK_NEAR(span_s, 1.0, 1e-9);
      // 488 counts a radian, one millisecond more in the first sample; rounding loses nothing for good
      CHECK_NEAR(x, 1.001 * 488.322 * row[i].x_per_s, 0.01 + 0.5 * round);
      CHECK_NEAR(y, 1.001 * 488.322 * row[i].y_per_s, 0.01 + 0.5 * round);
      random_close(random);
    }
  }
}

TEST(range_has_an_error_of_scale_and_offset_before_floor_and_reach) {
  static const struct {
    const char *what;
    double up_scale, up_offset_m, down_scale, down_offset_m, up_m, down_m, want_up_mm, want_down_m;
  } row[] = {
      {"none", 0.0, 0.0, 0.0, 0.0, 0.5, 0.4, 500.0, 0.4},
      {"scale up", 0.01, 0.0, 0.0, 0.0, 0.5, 0.4, 505.0, 0.4},
      {"offset up", 0.0, -0.003, 0.0, 0.0, 0.5, 0.4, 497.0, 0.4},
      {"scale down", 0.0, 0.0, -0.01, 0.0, 0.5, 0.4, 500.0, 0.396},
      {"offset down", 0.0, 0.0, 0.0, 0.003, 0.5, 0.4, 500.0, 0.403},
      {"all", 0.01, 0.002, 0.02, -0.001, 0.5, 0.4, 507.0, 0.407},
      {"the floor stays", 0.0, -0.003, 0.0, 0.0, 0.041, 0.4, 40.0, 0.4},
      {"the reach is true", 0.1, 0.0, 0.0, 0.0, 3.99, 0.4, 4389.0, 0.4},
      {"never below 0", 0.0, 0.0, 0.0, -0.003, 0.5, 0.001, 500.0, 0.0},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    const range_param_t p = {.up_scale = row[i].up_scale,
                             .up_offset_m = row[i].up_offset_m,
                             .down_scale = row[i].down_scale,
                             .down_offset_m = row[i].down_offset_m};
    range_t s;
    range_init(&s);
    random_t *random = random_open(1);
    const truth_t truth = at(row[i].up_m, row[i].down_m);
    double up_mm = 0.0, down_m = 0.0;
    for (int ms = 0; ms < 300; ms++) {
      const range_sample_t out = range_step(&s, &p, random, &truth);
      up_mm = out.up_mm;
      if (out.down_new) down_m = out.down_m;
    }
    CHECK_NEAR(up_mm, row[i].want_up_mm, 1e-9);
    CHECK_NEAR(down_m, row[i].want_down_m, 1e-12);
    random_close(random);
  }
}
