// test_hold.c - the ceiling's height: followed, held, and given up.
#include "flight/hold.h"
#include "rig/below.h"
#include "rig/test.h"

#include <math.h>

typedef struct {
  ceiling_t ceiling;
  hold_t hold;
  float z_m;
} look_t;

static look_t fresh(float z_m) {
  look_t l = {.z_m = z_m};
  ceiling_init(&l.ceiling, BELOW_PERIOD_S);
  hold_init(&l.hold);
  return l;
}

static void tick(look_t *l, float climb_m, float range_m, bool latch) {
  l->z_m += climb_m;
  ceiling_predict(&l->ceiling, &below_param, climb_m);
  if (range_m > 0.0f && ceiling_correct(&l->ceiling, &below_param, range_m, 0.0f) == ST_OK)
    hold_sample(&l->hold, &l->ceiling, l->z_m);
  hold_step(&l->hold, &l->ceiling, l->z_m, BELOW_PERIOD_S, latch);
}

// A tenth of a second: the sample comes last.
static void look(look_t *l, float climb_m, float range_m, bool latch) {
  for (int k = 1; k <= BELOW_EVERY; k++)
    tick(l, climb_m / (float)BELOW_EVERY, k == BELOW_EVERY ? range_m : 0.0f, latch);
}

// Under a ceiling at 1 m, having come from farther than 20 cm, at this gap.
static look_t arrived(float gap_m, bool latch) {
  look_t l = fresh(0.6f);
  for (int k = 0; k < 20; k++) look(&l, 0.0f, 1.0f - l.z_m, latch);
  while (l.z_m < 0.9999f - gap_m) look(&l, 0.02f, 0.98f - l.z_m, latch);
  return l;
}

TEST(hold_keeps_the_height_nearer_than_20_cm_and_follows_it_farther) {
  static const struct {
    float gap_m;
    bool latch;
    double want_m; // of a ceiling that the sensor then sees 3 cm higher
  } row[] = {{0.10f, true, 1.0}, {0.16f, true, 1.0}, {0.22f, true, 1.03}, {0.10f, false, 1.03}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("gap %g m, latch %d", (double)row[i].gap_m, row[i].latch);
    look_t l = arrived(row[i].gap_m, row[i].latch);
    CHECK_NEAR(l.hold.ceiling_z_m, 1.0, 1e-4);
    for (int k = 0; k < 60; k++) look(&l, 0.0f, 1.03f - l.z_m, row[i].latch);
    CHECK_NEAR(l.hold.ceiling_z_m, row[i].want_m, 1e-3);
  }
}

TEST(hold_of_a_take_off_close_below_is_the_mean_of_ten_samples) {
  look_t l = fresh(0.85f);
  for (int k = 0; k < 40; k++) look(&l, 0.0f, k == 0 ? 0.18f : 0.15f, true);
  CHECK_NEAR(l.hold.ceiling_z_m, 1.003, 1e-4); // the first alone: 1.03
  ROW("and is not moved by what comes later");
  for (int k = 0; k < 40; k++) look(&l, 0.0f, 0.17f, true);
  CHECK_NEAR(l.hold.ceiling_z_m, 1.003, 1e-4);
}

TEST(hold_does_not_count_samples_at_the_sensors_floor) {
  look_t l = fresh(0.93f);
  for (int k = 0; k < 3; k++) look(&l, 0.0f, 0.07f, true);
  look(&l, 0.025f, 0.045f, true);
  for (int k = 0; k < 10; k++) look(&l, 0.002f, 0.04f, true);
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
    look_t l = arrived(row[i].gap_m, true);
    const float gap_m = 1.0f - l.z_m;
    for (int k = 0; k < row[i].samples; k++) {
      look(&l, 0.0f, gap_m + row[i].shift_m, true);
      if (row[i].every_other) look(&l, 0.0f, gap_m, true);
    }
    if (isnan(row[i].want_m))
      CHECK(isnan(l.hold.ceiling_z_m));
    else
      CHECK_NEAR(l.hold.ceiling_z_m, row[i].want_m, 2e-3);
  }
}

TEST(hold_is_not_ended_by_samples_that_come_in_a_burst) {
  look_t l = arrived(0.10f, true);
  for (int k = 0; k < 8; k++) tick(&l, 0.0f, 0.40f, true);
  CHECK_NEAR(l.hold.ceiling_z_m, 1.0, 1e-4);
  ROW("nor by two that are far apart");
  l = arrived(0.10f, true);
  look(&l, 0.0f, 0.40f, true);
  for (int k = 0; k < 50; k++) tick(&l, 0.0f, 0.0f, true);
  look(&l, 0.0f, 0.40f, true);
  CHECK_NEAR(l.hold.ceiling_z_m, 1.0, 1e-4);
}

TEST(hold_follows_what_is_far_or_new_and_keeps_what_is_near) {
  static const struct {
    const char *what;
    bool latch, known, follows;
    int samples, against;
    float held_z_m, zc_m, seen_m;
  } row[] = {
      {"not latched", false, true, true, 10, 0, 1.2f, 0.1f, 0.1f},
      {"never seen before", true, true, true, 0, 0, NAN, 0.1f, 0.1f},
      {"far", true, true, true, 10, 0, 1.2f, 0.3f, 0.3f},
      {"near", true, true, false, 10, 0, 1.2f, 0.1f, 0.3f},
      {"far, but seen near", true, true, false, 10, 0, 1.2f, 0.3f, 0.1f},
      {"far, of few samples", true, true, false, 9, 0, 1.2f, 0.3f, 0.3f},
      {"far, and contradicted", true, true, false, 10, 1, 1.2f, 0.3f, 0.3f},
      {"not known", false, false, false, 10, 0, 1.2f, 0.3f, 0.3f},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    ceiling_t c;
    ceiling_init(&c, BELOW_PERIOD_S);
    c.known = row[i].known;
    c.zc_m = row[i].zc_m;
    c.seen_m = row[i].seen_m;
    hold_t s = {.ceiling_z_m = row[i].held_z_m, .samples = row[i].samples, .against = row[i].against};
    hold_step(&s, &c, 0.8f, BELOW_PERIOD_S, row[i].latch);
    CHECK(s.ceiling_z_m == (row[i].follows ? 0.8f + row[i].zc_m : row[i].held_z_m));
  }
}
