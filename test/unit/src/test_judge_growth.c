// test_judge_growth.c - a ceiling that the range does not see, told by how the thrust ratio grows in a climb.
#include "flight/judge.h"
#include "rig/hovering.h"
#include "rig/test.h"

#define WORLD_M 2.0f // the true ceiling's height

typedef struct {
  guard_t g;
  float z_m, speed_mps;
  int ms;
} climb_t;

// One sample of the outer loop's every 10 ms; the range is off by so much, more of the ratio than usual.
static void sample(climb_t *c, float range_off_m, float more, void (*edit)(guard_in_t *in)) {
  const guard_param_t p = hovering_param();
  const float zc_m = WORLD_M - c->z_m + range_off_m;
  const hover_t h = {zc_m, zc_m, zc_m, 1.0f + more};
  guard_in_t in = hovering(&h, c->ms);
  in.ms = 10;
  in.range_new = false;
  if (edit) edit(&in);
  c->ms += 10;
  c->z_m += 0.01f * c->speed_mps;
  c->g.vel_w_mps.z = c->speed_mps;
  c->g.now = judge_ceiling(&c->g, &p, &in);
}

static climb_t begun(float gap_m) {
  climb_t c = {.z_m = WORLD_M - gap_m};
  guard_init(&c.g);
  for (int i = 0; i < 200; i++) sample(&c, 0.3f, 0.0f, NULL);
  return c;
}

// The curve of thesis eq. 2.
static float curve(const climb_t *c, float per_m) {
  return 0.44f * expf(-per_m * (WORLD_M - c->z_m));
}

static void no_ceiling_known(guard_in_t *in) {
  in->zc_known = false;
}

TEST(guard_takes_a_ratio_that_grows_with_the_height_risen_for_a_ceiling) {
  static const struct {
    const char *what;
    float speed_mps, range_off_m, per_m;
    void (*edit)(guard_in_t *in);
    float at_m; // the true gap at which it is noticed; 0: not as far as 15 mm
  } row[] = {
      {"0.1 m/s", 0.1f, 0.3f, 80.0f, NULL, 0.0200f},
      {"0.05 m/s", 0.05f, 0.3f, 80.0f, NULL, 0.0220f},
      {"0.15 m/s", 0.15f, 0.3f, 80.0f, NULL, 0.0195f},
      {"0.25 m/s: a jolt would look like it", 0.25f, 0.3f, 80.0f, NULL, 0.0f},
      {"a curve that is steeper by a fifth", 0.1f, 0.3f, 96.0f, NULL, 0.0160f},
      {"a curve that is flatter by a fifth", 0.1f, 0.3f, 64.0f, NULL, 0.0260f},
      {"no ceiling known", 0.1f, 0.3f, 80.0f, no_ceiling_known, 0.0200f},
      {"the range's 62 mm do not explain it", 0.1f, 0.041f, 80.0f, NULL, 0.0200f},
      {"the range's 60 mm explain it", 0.1f, 0.037f, 80.0f, NULL, 0.0f},
      {"no ceiling", 0.1f, 0.3f, 1000.0f, NULL, 0.0f},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    climb_t c = begun(0.15f);
    c.speed_mps = row[i].speed_mps;
    while (WORLD_M - c.z_m > 0.015f && (c.g.now & GUARD_RATIO) == 0)
      sample(&c, row[i].range_off_m, curve(&c, row[i].per_m), row[i].edit);
    CHECK(((c.g.now & GUARD_RATIO) != 0) == (row[i].at_m > 0.0f));
    if (row[i].at_m > 0.0f) CHECK_NEAR(WORLD_M - c.z_m, row[i].at_m, 1.1e-3); // a sample's climb
  }
}

TEST(guard_sees_no_growth_without_an_accelerometer) {
  climb_t c = begun(0.15f);
  c.speed_mps = 0.1f;
  c.g.acc_lost = true;
  while (WORLD_M - c.z_m > 0.015f) sample(&c, 0.3f, curve(&c, 80.0f), NULL);
  CHECK((c.g.now & GUARD_RATIO) == 0);
}

// A tenth more from one sample to the next, as when a load drops, is the same at any height.
TEST(guard_takes_no_jolt_for_a_ceiling) {
  static const float speed_mps[] = {0.0f, 0.02f, 0.05f, 0.1f, 0.15f, 0.3f, -0.1f};
  for (unsigned i = 0; i < sizeof speed_mps / sizeof *speed_mps; i++) {
    ROW("%g m/s", (double)speed_mps[i]);
    climb_t c = begun(1.5f);
    c.speed_mps = speed_mps[i];
    unsigned said = 0;
    for (int k = 0; k < 300; k++) {
      sample(&c, 0.3f, k < 150 ? 0.0f : 0.1f, NULL);
      said |= c.g.now;
    }
    CHECK((said & GUARD_RATIO) == 0);
  }
}

TEST(guard_follows_no_sink_with_what_it_remembers_of_growth) {
  climb_t c = begun(0.15f);
  c.speed_mps = -1.0f;
  for (int k = 0; k < 200; k++) sample(&c, 0.3f, 0.1f, NULL);
  CHECK(c.g.growth.n <= 40.0f && c.g.growth.f <= 40.0f && c.g.growth.ff <= 40.0f);
  CHECK((c.g.now & GUARD_RATIO) == 0);
}

TEST(guard_forgets_a_growth_where_a_bit_of_it_flipped) {
  static const float odd[] = {NAN, INFINITY, -INFINITY, 1e30f, -1e30f, 1.1e3f};
  for (unsigned i = 0; i < 6 * sizeof odd / sizeof *odd; i++) {
    ROW("sum %u, %g", i % 6, (double)odd[i / 6]);
    climb_t c = begun(0.5f);
    float *const sum[] = {&c.g.growth.n, &c.g.growth.f,  &c.g.growth.ff,
                          &c.g.growth.y, &c.g.growth.fy, &c.g.growth.yy};
    *sum[i % 6] = odd[i / 6];
    sample(&c, 0.3f, 0.0f, NULL);
    CHECK(c.g.growth.n == 0.0f && c.g.growth.ff == 0.0f && (c.g.now & GUARD_RATIO) == 0);
  }
}

// As above, but of a size that sums have: no fit explains more of the ratio than there is.
TEST(guard_takes_no_flipped_sum_for_a_ceiling) {
  static const float more[] = {-500.0f, -50.0f, -5.0f, 5.0f, 50.0f, 500.0f};
  for (unsigned i = 0; i < 6 * sizeof more / sizeof *more; i++) {
    ROW("sum %u, %g more", i % 6, (double)more[i / 6]);
    climb_t c = begun(1.5f);
    c.speed_mps = 0.1f;
    for (int k = 0; k < 100; k++) sample(&c, 0.3f, k % 2 ? 0.02f : -0.02f, NULL);
    float *const sum[] = {&c.g.growth.n, &c.g.growth.f,  &c.g.growth.ff,
                          &c.g.growth.y, &c.g.growth.fy, &c.g.growth.yy};
    *sum[i % 6] += more[i / 6];
    unsigned said = 0;
    for (int k = 0; k < 200; k++) {
      sample(&c, 0.3f, k % 2 ? 0.02f : -0.02f, NULL);
      said |= c.g.now;
    }
    CHECK((said & GUARD_RATIO) == 0);
  }
}
