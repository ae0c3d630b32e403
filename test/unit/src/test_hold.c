// test_hold.c - the ceiling's height: followed, held, and given up.
#include "flight/hold.h"
#include "rig/below.h"
#include "rig/test.h"

#include <math.h>

typedef struct {
  ceiling_t ceiling;
  hold_t hold;
  float z_m, climb_mps;
} look_t;

static look_t fresh(float z_m) {
  look_t l = {.z_m = z_m};
  ceiling_init(&l.ceiling, BELOW_PERIOD_S);
  hold_init(&l.hold);
  return l;
}

static void tick(look_t *l, float climb_m, float range_m, int32_t mode) {
  l->z_m += climb_m;
  l->climb_mps = climb_m / BELOW_PERIOD_S;
  ceiling_predict(&l->ceiling, &below_param, climb_m);
  if (range_m > 0.0f && ceiling_correct(&l->ceiling, &below_param, range_m, 0.0f) == ST_OK)
    hold_sample(&l->hold, &l->ceiling, l->z_m, l->climb_mps, mode);
  hold_step(&l->hold, &l->ceiling, l->z_m, BELOW_PERIOD_S, mode);
}

// A tenth of a second: the sample comes last.
static void look(look_t *l, float climb_m, float range_m, int32_t mode) {
  for (int k = 1; k <= BELOW_EVERY; k++)
    tick(l, climb_m / (float)BELOW_EVERY, k == BELOW_EVERY ? range_m : 0.0f, mode);
}

// Under a ceiling at 1 m, having come from farther than 20 cm, at this gap.
static look_t arrived(float gap_m, int32_t mode) {
  look_t l = fresh(0.6f);
  for (int k = 0; k < 20; k++) look(&l, 0.0f, 1.0f - l.z_m, mode);
  while (l.z_m < 0.9999f - gap_m) look(&l, 0.02f, 0.98f - l.z_m, mode);
  return l;
}

TEST(hold_keeps_the_height_nearer_than_20_cm_and_follows_it_farther) {
  static const struct {
    float gap_m;
    int32_t mode;
    double want_m; // of a ceiling that the sensor then sees 3 cm higher
  } row[] = {{0.10f, HOLD_LATCHED, 1.0},
             {0.16f, HOLD_LATCHED, 1.0},
             {0.22f, HOLD_LATCHED, 1.03},
             {0.10f, HOLD_NOT, 1.03}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("gap %g m, mode %d", (double)row[i].gap_m, row[i].mode);
    look_t l = arrived(row[i].gap_m, row[i].mode);
    CHECK_NEAR(l.hold.ceiling_z_m, 1.0, 1e-4);
    for (int k = 0; k < 60; k++) look(&l, 0.0f, 1.03f - l.z_m, row[i].mode);
    CHECK_NEAR(l.hold.ceiling_z_m, row[i].want_m, 1e-3);
  }
}

TEST(hold_of_a_take_off_close_below_is_the_mean_of_ten_samples) {
  look_t l = fresh(0.85f);
  for (int k = 0; k < 40; k++) look(&l, 0.0f, k == 0 ? 0.18f : 0.15f, HOLD_LATCHED);
  CHECK_NEAR(l.hold.ceiling_z_m, 1.003, 1e-4); // the first alone: 1.03
  ROW("and is not moved by what comes later");
  for (int k = 0; k < 40; k++) look(&l, 0.0f, 0.17f, HOLD_LATCHED);
  CHECK_NEAR(l.hold.ceiling_z_m, 1.003, 1e-4);
}

TEST(hold_does_not_count_samples_at_the_sensors_floor) {
  look_t l = fresh(0.93f);
  for (int k = 0; k < 3; k++) look(&l, 0.0f, 0.07f, HOLD_LATCHED);
  look(&l, 0.025f, 0.045f, HOLD_LATCHED);
  for (int k = 0; k < 10; k++) look(&l, 0.002f, 0.04f, HOLD_LATCHED);
  CHECK_NEAR(l.hold.ceiling_z_m, 1.0, 1e-4);
  CHECK(l.hold.samples == 3);
}

TEST(hold_ends_when_samples_put_the_ceiling_elsewhere_for_300_ms) {
  static const struct {
    const char *what;
    float gap_m, shift_m;
    int samples, every_other; // every_other 1: in between the old ceiling is seen
    double want_m;            // NaN: forgotten
  } row[] = {
      {"30 cm higher, 300 ms", 0.10f, 0.30f, 4, 0, 1.30},
      {"30 cm higher, 200 ms", 0.10f, 0.30f, 3, 0, 1.0},
      {"30 cm higher, flickering", 0.10f, 0.30f, 10, 1, 1.0},
      {"6 cm higher, no room", 0.08f, 0.06f, 30, 0, 1.0},
      {"6 cm higher, room", 0.10f, 0.06f, 4, 0, 1.06},
      {"4 cm higher", 0.15f, 0.04f, 30, 0, 1.0},
      {"6 cm lower", 0.15f, -0.06f, 4, 0, 0.94},
      {"6 cm lower, 200 ms", 0.15f, -0.06f, 3, 0, 1.0},
      {"open sky, 300 ms", 0.10f, 2.5f, 4, 0, (double)NAN},
      {"open sky, 200 ms", 0.10f, 2.5f, 3, 0, 1.0},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    look_t l = arrived(row[i].gap_m, HOLD_LATCHED);
    const float gap_m = 1.0f - l.z_m;
    for (int k = 0; k < row[i].samples; k++) {
      look(&l, 0.0f, gap_m + row[i].shift_m, HOLD_LATCHED);
      if (row[i].every_other) look(&l, 0.0f, gap_m, HOLD_LATCHED);
    }
    if (isnan(row[i].want_m))
      CHECK(isnan(l.hold.ceiling_z_m));
    else
      CHECK_NEAR(l.hold.ceiling_z_m, row[i].want_m, 2e-3);
  }
}

TEST(hold_is_not_ended_by_samples_that_come_in_a_burst) {
  look_t l = arrived(0.10f, HOLD_LATCHED);
  for (int k = 0; k < 8; k++) tick(&l, 0.0f, 0.40f, HOLD_LATCHED);
  CHECK_NEAR(l.hold.ceiling_z_m, 1.0, 1e-4);
  ROW("nor by two that are far apart");
  l = arrived(0.10f, HOLD_LATCHED);
  look(&l, 0.0f, 0.40f, HOLD_LATCHED);
  for (int k = 0; k < 50; k++) tick(&l, 0.0f, 0.0f, HOLD_LATCHED);
  look(&l, 0.0f, 0.40f, HOLD_LATCHED);
  CHECK_NEAR(l.hold.ceiling_z_m, 1.0, 1e-4);
}

TEST(hold_follows_what_is_far_or_new_and_keeps_what_is_near) {
  static const struct {
    const char *what;
    int32_t mode;
    bool known, follows;
    int samples, against;
    float held_z_m, zc_m, seen_m;
  } row[] = {
      {"not latched", HOLD_NOT, true, true, 10, 0, 1.2f, 0.1f, 0.1f},
      {"never seen before", HOLD_LATCHED, true, true, 0, 0, NAN, 0.1f, 0.1f},
      {"far", HOLD_LATCHED, true, true, 10, 0, 1.2f, 0.3f, 0.3f},
      {"near", HOLD_LATCHED, true, false, 10, 0, 1.2f, 0.1f, 0.3f},
      {"far, but seen near", HOLD_LATCHED, true, false, 10, 0, 1.2f, 0.3f, 0.1f},
      {"far, of few samples", HOLD_LATCHED, true, false, 9, 0, 1.2f, 0.3f, 0.3f},
      {"far, and contradicted", HOLD_LATCHED, true, false, 10, 1, 1.2f, 0.3f, 0.3f},
      {"not known", HOLD_NOT, false, false, 10, 0, 1.2f, 0.3f, 0.3f},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    ceiling_t c;
    ceiling_init(&c, BELOW_PERIOD_S);
    c.known = row[i].known;
    c.zc_m = row[i].zc_m;
    c.seen_m = row[i].seen_m;
    hold_t s = {.ceiling_z_m = row[i].held_z_m, .samples = row[i].samples, .against = row[i].against};
    hold_step(&s, &c, 0.8f, BELOW_PERIOD_S, row[i].mode);
    CHECK(s.ceiling_z_m == (row[i].follows ? 0.8f + row[i].zc_m : row[i].held_z_m));
  }
}

TEST(hold_goes_on_with_the_mean_of_samples_that_come_slowly) {
  static const struct {
    const char *what;
    int32_t mode;
    float climb_mps, off_m; // of every later sample
    int samples;
    double want_m;
  } row[] = {
      {"30 more, 3 mm higher", HOLD_MEAN, 0.0f, 0.003f, 30, 1.0 + 0.003 * 30.0 / 40.0},
      {"latched", HOLD_LATCHED, 0.0f, 0.003f, 30, 1.0},
      {"climbing as fast as counts", HOLD_MEAN, 0.04f, 0.003f, 30, 1.0 + 0.003 * 30.0 / 40.0},
      {"climbing faster", HOLD_MEAN, 0.06f, 0.003f, 30, 1.0},
      {"sinking faster", HOLD_MEAN, -0.06f, 0.003f, 30, 1.0},
      {"as far off as noise brings it", HOLD_MEAN, 0.0f, 0.0115f, 1, 1.0 + 0.0115 / 11.0},
      {"farther off", HOLD_MEAN, 0.0f, 0.0125f, 30, 1.0},
      {"after 70 at a rate of one in 70", HOLD_MEAN, 0.0f, 0.003f, 130, 1.003 - 0.003 * 10.0 / 70.0 * 0.3653},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    look_t l = fresh(0.85f);
    for (int k = 0; k < 10; k++) look(&l, 0.0f, 0.15f, row[i].mode);
    ceiling_t seen = l.ceiling;
    seen.blind_s = 0.0f;
    for (int k = 0; k < row[i].samples; k++) {
      seen.seen_m = 0.15f + row[i].off_m;
      hold_sample(&l.hold, &seen, l.z_m, row[i].climb_mps, row[i].mode);
    }
    CHECK_NEAR(l.hold.ceiling_z_m, row[i].want_m, 2e-6);
  }
}

TEST(hold_of_a_mean_is_not_latched_anew_when_it_is_left_and_is_overruled_all_the_same) {
  look_t l = fresh(0.85f);
  for (int k = 0; k < 20; k++) look(&l, 0.0f, 0.15f, HOLD_MEAN);
  for (int k = 0; k < 20; k++) look(&l, -0.01f, 0.15f + 0.01f * (float)(k + 1) + 0.03f, HOLD_MEAN);
  CHECK_NEAR(l.hold.ceiling_z_m, 1.0, 1e-4); // 35 cm below it, where the estimate is 2 cm higher
  ROW("three samples that put it elsewhere");
  for (int k = 0; k < 5; k++) look(&l, 0.0f, 0.25f, HOLD_MEAN);
  CHECK_NEAR(l.hold.ceiling_z_m, l.z_m + 0.25f, 2e-3);
}

TEST(hold_counts_on_from_0_where_the_sign_of_its_count_flipped) {
  static const int32_t samples[] = {-1, -10, INT32_MIN};
  for (unsigned i = 0; i < sizeof samples / sizeof *samples; i++) {
    ROW("%d samples", (int)samples[i]);
    look_t l = arrived(0.10f, HOLD_LATCHED);
    l.hold.samples = samples[i];
    look(&l, 0.0f, 0.12f, HOLD_LATCHED);
    CHECK(l.hold.samples == 1);
    CHECK_NEAR(l.hold.ceiling_z_m, l.z_m + 0.12f, 1e-5);
  }
}
