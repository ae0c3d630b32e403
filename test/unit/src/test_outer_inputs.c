// test_outer_inputs.c - the outer loop with bad inputs: what it holds, and what it counts.
#include "rig/splitmix.h"
#include "rig/rig3.h"
#include "rig/test.h"

#include <float.h>
#include <limits.h>
#include <string.h>

TEST(outer_changes_nothing_on_an_input_that_is_not_a_number) {
  // Faults rows 1, 3, 4.
  static const float bad[] = {NAN, -NAN, INFINITY, -INFINITY, 1e38f, -1e38f, FLT_MAX};
  flight_param_t p;
  rig3_t v;
  const outer_t start = rig3_in_flight(&p, &v);
  int fields = 0;
  for (size_t field = 0; field < sizeof(outer_in_t); field += sizeof(float)) {
    if (field == offsetof(outer_in_t, range_new) || field == offsetof(outer_in_t, range_m) ||
        field == offsetof(outer_in_t, range_age_s))
      continue;
    fields++;
    for (unsigned k = 0; k < sizeof bad / sizeof *bad; k++) {
      ROW("%g at byte %d", (double)bad[k], (int)field);
      outer_t f;
      memcpy(&f, &start, sizeof f);
      outer_in_t in = rig3_sense(&v, (v3_t){0, 0, 0.94f});
      memcpy((char *)&in + field, &bad[k], sizeof bad[k]);
      const outer_out_t out = rig3_step(&f, &p, &in);
      CHECK(rig3_same_out(&out, &start.out));
      CHECK(rig3_is_command(&out, &p));
      CHECK(rig3_same_state(&f, &start));
      const status_t kind = field >= offsetof(outer_in_t, setpoint) ? ST_BAD_SETPOINT : ST_BAD_INPUT;
      CHECK(f.faults[kind] == start.faults[kind] + 1);
      CHECK(rig3_faults(&f) == rig3_faults(&start) + 1);
    }
  }
  CHECK(fields == 23);
}

TEST(outer_holds_an_attitude_that_is_none) {
  // Faults row 47. Half to twice the length of a quaternion is normalised, the rest is no attitude.
  static const struct {
    float scale;
    bool used;
  } row[] = {{0.0f, false}, {0.1f, false}, {0.49f, false}, {0.51f, true},
             {1.5f, true},  {1.99f, true}, {2.1f, false}};
  flight_param_t p;
  rig3_t v;
  const outer_t start = rig3_in_flight(&p, &v);
  outer_t plain;
  memcpy(&plain, &start, sizeof plain);
  outer_in_t in = rig3_sense(&v, (v3_t){0, 0, 0.94f});
  const outer_out_t want = rig3_step(&plain, &p, &in);
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("length %g", (double)row[i].scale);
    outer_t f;
    memcpy(&f, &start, sizeof f);
    outer_in_t scaled = in;
    const float k = row[i].scale;
    scaled.q_wb = (quat_t){k * in.q_wb.w, k * in.q_wb.x, k * in.q_wb.y, k * in.q_wb.z};
    const outer_out_t out = rig3_step(&f, &p, &scaled);
    CHECK(f.faults[ST_BAD_INPUT] == (row[i].used ? 0u : 1u));
    CHECK(rig3_same_state(&f, &start) == !row[i].used);
    if (row[i].used) CHECK_NEAR(out.thrust_N, want.thrust_N, 1e-6);
  }
}

TEST(outer_gives_a_safe_command_before_it_has_seen_a_good_sample) {
  const flight_param_t p = rig3_param();
  outer_t f = rig3_outer(&p);
  rig3_t v = rig3_at(0, 0, 0.5, 1.0);
  outer_in_t in = rig3_sense(&v, (v3_t){0, 0, 0.9f});
  in.acc_b_mps2.z = NAN;
  const outer_out_t out = rig3_step(&f, &p, &in);
  CHECK(out.thrust_N == 0.0f && out.up_w.z == 1.0f && out.at.ratio == 1.0f && !out.zc_known);
  CHECK(!f.started);
}

TEST(outer_counts_a_bad_range_and_flies_on_as_without_it) {
  // Faults rows 13, 14, 22.
  static const float bad[] = {NAN, INFINITY, -INFINITY, 1e38f, 32.767f, 0.0f, -0.3f, 300.0f};
  flight_param_t p;
  rig3_t v;
  const outer_t start = rig3_in_flight(&p, &v);
  for (unsigned k = 0; k < sizeof bad / sizeof *bad; k++) {
    ROW("%g", (double)bad[k]);
    outer_t f, twin;
    memcpy(&f, &start, sizeof f);
    memcpy(&twin, &start, sizeof twin);
    outer_in_t in = rig3_sense(&v, (v3_t){0, 0, 0.94f});
    in.range_new = true;
    in.range_m = bad[k];
    const outer_out_t out = rig3_step(&f, &p, &in);
    in.range_new = false;
    const outer_out_t want = rig3_step(&twin, &p, &in);
    CHECK(rig3_same_out(&out, &want));
    CHECK(rig3_same_state(&f, &twin));
    CHECK(f.faults[ST_BAD_RANGE] == start.faults[ST_BAD_RANGE] + 1);
    CHECK(rig3_faults(&f) == rig3_faults(&twin) + 1);
  }
}

TEST(outer_counts_a_sample_whose_age_is_none_and_flies_on_without_it) {
  static const float age_s[] = {NAN, INFINITY, -INFINITY, -0.01f};
  for (unsigned i = 0; i < sizeof age_s / sizeof *age_s; i++) {
    ROW("age %g s", (double)age_s[i]);
    flight_param_t p;
    rig3_t v;
    const outer_t start = rig3_in_flight(&p, &v);
    outer_t f, twin;
    memcpy(&f, &start, sizeof f);
    memcpy(&twin, &start, sizeof twin);
    outer_in_t in = rig3_sense(&v, (v3_t){0, 0, 0.94f});
    in.range_new = false;
    const outer_out_t want = rig3_step(&twin, &p, &in);
    in.range_new = true;
    in.range_m = 0.1f;
    in.range_age_s = age_s[i];
    const outer_out_t out = rig3_step(&f, &p, &in);
    CHECK(rig3_same_out(&out, &want));
    CHECK(f.faults[ST_BAD_RANGE] == twin.faults[ST_BAD_RANGE] + 1);
  }
}

TEST(outer_finds_no_bias_in_a_climb_whose_inputs_were_bad_for_a_while) {
  flight_param_t p = rig3_param();
  p.bias.pole_radps = 5.0f;
  outer_t f = rig3_outer(&p);
  for (int k = 0; k < 500; k++) {
    ROW("tick %d", k);
    const float climb_mps = 0.5f;
    const outer_in_t in = {.pos_w_m = {.z = 0.01f * climb_mps * (float)k},
                           .vel_w_mps = {.z = climb_mps},
                           .acc_b_mps2 = {.z = k >= 400 && k < 420 ? NAN : GRAVITY_MPS2},
                           .q_wb = {.w = 1.0f},
                           .thrust_N = 0.314f};
    (void)rig3_step(&f, &p, &in);
    if (k < 390) continue; // has settled by then
    CHECK_NEAR(f.bias.bias_mps2.z, 0.0, 1e-4);
    CHECK_NEAR(bias_free_velocity(&f.bias, in.vel_w_mps).z, 0.5, 1e-4);
  }
}

TEST(outer_takes_a_last_height_that_is_none_for_no_reset) {
  static const float height_m[] = {7e4f, -1e30f, INFINITY, NAN}; // a bit of it flipped
  for (unsigned i = 0; i < sizeof height_m / sizeof *height_m; i++) {
    ROW("%g m", (double)height_m[i]);
    flight_param_t p;
    rig3_t v;
    outer_t f = rig3_in_flight(&p, &v);
    const float held_m = f.hold.ceiling_z_m, zc_m = f.ceiling.zc_m;
    const unsigned jumps = f.faults[ST_JUMP];
    f.height_last_m = height_m[i];
    outer_in_t in = rig3_sense(&v, (v3_t){0, 0, 0.94f});
    in.range_new = false;
    (void)rig3_step(&f, &p, &in);
    CHECK(f.hold.ceiling_z_m == held_m && f.faults[ST_JUMP] == jumps);
    CHECK_NEAR(f.ceiling.zc_m, zc_m - 0.01f * in.vel_w_mps.z, 1e-6);
  }
}

TEST(outer_outputs_stay_in_their_limits_whatever_comes) {
  // G1 and G2 of the fault list: 20000 ticks of which most have something wrong.
  static const float odd[] = {NAN,   INFINITY, -INFINITY, 1e38f,   1e-45f, 0.0f,
                              -1.0f, 1.0f,     99.0f,     -999.0f, 9999.0f};
  splitmix_t r = {1};
  flight_param_t p = rig3_param();
  p.curve.mode = CURVE_LIVE;
  outer_t f = rig3_outer(&p);
  rig3_t v = rig3_at(0, 0, 0.9, 1.0);
  int bad = 0;
  for (int k = 0; k < 20000; k++) {
    v.pos[2] = splitmix_between(&r, 0.3, 1.0);
    outer_in_t in = rig3_sense(&v, (v3_t){0, 0, 0.94f});
    for (int n = (int)(splitmix_bits(&r) % 4); n > 0; n--) {
      const size_t field = sizeof(float) * (splitmix_bits(&r) % (sizeof(outer_in_t) / sizeof(float)));
      if (field != offsetof(outer_in_t, range_new))
        memcpy((char *)&in + field, &odd[splitmix_bits(&r) % (sizeof odd / sizeof *odd)], sizeof(float));
    }
    const outer_out_t out = rig3_step(&f, &p, &in);
    if (!rig3_is_command(&out, &p) || out.zc_m < 0.0f || out.zc_m > 4.0f) bad++;
    for (int i = 0; i < RBF_N; i++)
      if (!(fabsf(f.learn.rls.theta.w[i]) <= RLS_WEIGHT_MAX)) bad++;
  }
  CHECK(bad == 0);
}

TEST(outer_counts_no_further_than_a_counter_goes_and_mends_one_that_is_none) {
  flight_param_t p;
  rig3_t v;
  outer_t f = rig3_in_flight(&p, &v);
  outer_in_t in = rig3_sense(&v, (v3_t){0, 0, 0.94f});
  in.acc_b_mps2.x = NAN;
  f.faults[ST_BAD_INPUT] = UINT_MAX;
  (void)rig3_step(&f, &p, &in);
  CHECK(f.faults[ST_BAD_INPUT] == UINT_MAX);
  f.missed = 2 * OUTER_MISSED_MAX; // a flipped bit
  (void)rig3_step(&f, &p, &in);
  CHECK(f.missed == OUTER_MISSED_MAX);
}
