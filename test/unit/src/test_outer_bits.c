// test_outer_bits.c - the outer loop gives the same bits where it has to.
#include "rig/splitmix.h"
#include "rig/rig3.h"
#include "rig/test.h"

TEST(outer_without_a_ceiling_is_plain_indi_to_the_bit) {
  // Faults row 41.
  static const struct {
    const char *what;
    bool new_samples;
    double ceiling_m;
  } row[] = {{"no samples", false, RIG3_NO_CEILING},
             {"no echo", true, RIG3_NO_CEILING},
             {"beyond far", true, 3.0},
             {"in sight, beyond zOn", true, 0.95}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++)
    for (int32_t mode = CURVE_FIXED; mode <= CURVE_THEORY; mode++) {
      ROW("%s, mode %d", row[i].what, (int)mode);
      flight_param_t p = rig3_param(), off = p;
      p.curve.mode = mode;
      off.curve.mode = CURVE_OFF;
      p.curve.clip = off.curve.clip = 0;
      outer_t f = rig3_outer(&p), twin = rig3_outer(&off);
      rig3_t v = rig3_at(0.2, -0.1, 0.4, row[i].ceiling_m);
      int differ = 0;
      for (int k = 0; k < 500; k++) {
        outer_in_t in = rig3_sense(&v, (v3_t){0, 0, k < 200 ? 0.7f : 0.5f});
        in.range_new = in.range_new && row[i].new_samples;
        const outer_out_t out = rig3_step(&f, &p, &in);
        const outer_out_t want = rig3_step(&twin, &off, &in);
        if (!rig3_same_out(&out, &want)) differ++;
        if (k == 499) CHECK(out.zc_known == (i == 3));
        rig3_move(&v, &out);
      }
      CHECK(differ == 0);
    }
}

TEST(outer_does_the_same_for_q_and_minus_q) {
  flight_param_t p;
  rig3_t v;
  (void)rig3_in_flight(&p, &v);
  outer_t f = rig3_outer(&p), twin = rig3_outer(&p);
  v = rig3_at(0.3, 0.2, 0.8, 1.0);
  v.yaw = 2.0;
  splitmix_t r = {2};
  int differ = 0, flipped = 0;
  for (int k = 0; k < 500; k++) {
    outer_in_t in = rig3_sense(&v, (v3_t){0, 0, 0.94f});
    const outer_out_t want = rig3_step(&twin, &p, &in);
    if (k == 0 || splitmix_bits(&r) % 2 == 0) { // the very first one, too
      in.q_wb = (quat_t){-in.q_wb.w, -in.q_wb.x, -in.q_wb.y, -in.q_wb.z};
      flipped++;
    }
    const outer_out_t out = rig3_step(&f, &p, &in);
    if (!rig3_same_out(&out, &want)) differ++;
    rig3_move(&v, &want);
  }
  CHECK(differ == 0);
  CHECK(flipped > 200 && flipped < 300);
}

TEST(outer_of_one_vehicle_does_not_touch_that_of_another) {
  flight_param_t p = rig3_param(), other = p;
  other.curve.mode = p.curve.mode = CURVE_LIVE;
  other.pos.kp_per_s = 2.0f;
  other.cutoff_Hz = 20.0f;
  outer_t alone = rig3_outer(&p), one = rig3_outer(&p), two = rig3_outer(&other);
  rig3_t va = rig3_at(0.1, 0, 0.8, 1.0), v1 = va, v2 = rig3_at(-0.3, 0.2, 0.6, 0.9);
  int differ = 0;
  for (int k = 0; k < 400; k++) {
    const outer_out_t want = rig3_fly(&alone, &p, &va, (v3_t){0, 0, 0.95f}, 1);
    const outer_out_t out = rig3_fly(&one, &p, &v1, (v3_t){0, 0, 0.95f}, 1);
    (void)rig3_fly(&two, &other, &v2, (v3_t){0, 0, 0.8f}, 1);
    if (!rig3_same_out(&out, &want)) differ++;
  }
  CHECK(differ == 0);
  CHECK(rig3_same_state(&alone, &one));
}

TEST(outer_started_again_is_as_one_that_never_flew) {
  flight_param_t p;
  rig3_t v;
  outer_t used = rig3_in_flight(&p, &v);
  CHECK_OK(outer_init(&used, &p, RIG3_PERIOD_S));
  outer_t first = rig3_outer(&p);
  rig3_t va = rig3_at(0.1, 0, 0.8, 1.0), vb = va;
  int differ = 0;
  for (int k = 0; k < 300; k++) {
    const outer_out_t a = rig3_fly(&used, &p, &va, (v3_t){0, 0, 0.95f}, 1);
    const outer_out_t b = rig3_fly(&first, &p, &vb, (v3_t){0, 0, 0.95f}, 1);
    if (!rig3_same_out(&a, &b)) differ++;
  }
  CHECK(differ == 0);
  CHECK(rig3_faults(&used) == rig3_faults(&first));
}

TEST(outer_by_the_estimators_own_height_and_gains_is_the_same_to_the_bit) {
  flight_param_t p;
  rig3_t v;
  outer_t f = rig3_in_flight(&p, &v), twin = f;
  const height_fly_t by = {.law = p.pos};
  int differ = 0;
  for (int k = 0; k < 300; k++) {
    const outer_in_t in = rig3_sense(&v, (v3_t){0, 0, k < 150 ? 0.96f : 0.9f});
    const outer_out_t want = *outer_step(&f, &in), out = (outer_fly_by(&twin, &by), *outer_step(&twin, &in));
    if (!rig3_same_out(&out, &want)) differ++;
    rig3_move(&v, &want);
  }
  CHECK(differ == 0);
}
