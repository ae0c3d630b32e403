// test_outer_ceiling.c - the outer loop knows where the ceiling is.
#include "rig/rig3.h"
#include "rig/test.h"

TEST(outer_takes_a_reset_of_the_height_for_no_climb) {
  // Faults row 45.
  static const double jump_m[] = {0.3, -0.3, 0.05, -0.02};
  for (unsigned i = 0; i < sizeof jump_m / sizeof *jump_m; i++) {
    ROW("%g m", jump_m[i]);
    flight_param_t p;
    rig3_t v;
    outer_t f = rig3_in_flight(&p, &v);
    const unsigned before = f.faults[ST_JUMP];
    v3_t goal = {0, 0, 0.94f};
    double worst = 0.0;
    for (int k = 0; k < 100; k++) {
      outer_in_t in = rig3_sense(&v, goal);
      if (k >= 7) {
        in.pos_w_m.z += (float)jump_m[i];
        in.setpoint.pos_w_m.z += (float)jump_m[i];
      }
      const outer_out_t out = rig3_step(&f, &p, &in);
      worst = fmax(worst, fabs((double)out.zc_m - (v.ceiling_m - v.pos[2])));
      rig3_move(&v, &out);
    }
    CHECK_NEAR(worst, 0.0, 0.02);
    CHECK(f.faults[ST_JUMP] == before + 1);
  }
}

TEST(outer_knows_the_ceiling_after_a_row_of_bad_inputs_in_a_climb) {
  // What was climbed while the inputs were bad is in the height of the first good one.
  static const struct {
    int ticks;
    double climb_mps, from_m;
  } row[] = {{1, 0.3, 0.7}, {3, 0.3, 0.7}, {10, 0.3, 0.7}, {25, 0.3, 0.7}, {25, -0.3, 0.7}, {3, 0.8, 0.55}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%d ticks at %g m/s", row[i].ticks, row[i].climb_mps);
    const flight_param_t p = rig3_param();
    outer_t f = rig3_outer(&p);
    rig3_t v = rig3_at(0, 0, row[i].from_m, 1.0);
    outer_out_t out = f.out;
    for (int k = 0; k < 50; k++) {
      v.vel[2] = row[i].climb_mps;
      v.pos[2] = row[i].from_m + row[i].climb_mps * 0.01 * k;
      v.tick = k;
      outer_in_t in = rig3_sense(&v, (v3_t){0, 0, 0.9f});
      if (k > 5) in.range_new = false;
      if (k >= 10 && k < 10 + row[i].ticks) in.acc_b_mps2.x = NAN;
      out = rig3_step(&f, &p, &in);
    }
    CHECK_NEAR(out.zc_m, v.ceiling_m - v.pos[2], 0.02);
  }
}

TEST(outer_corrects_a_slant_range) {
  // Faults row 23: 20 degrees make 6 % of the distance.
  static const double tilt = 20.0 * 3.14159265358979 / 180.0;
  for (int towards = 0; towards < 12; towards++)
    for (int yaw = 0; yaw < 3; yaw++) {
      ROW("towards %d deg, yaw %d rad", 30 * towards, yaw);
      const flight_param_t p = rig3_param();
      outer_t f = rig3_outer(&p);
      rig3_t v = rig3_at(0, 0, 0.6, 1.0);
      const double about = 0.5235987755983 * towards;
      v.up[0] = sin(tilt) * cos(about);
      v.up[1] = sin(tilt) * sin(about);
      v.up[2] = cos(tilt);
      v.yaw = yaw;
      for (v.tick = 0; v.tick < 50; v.tick++) {
        const outer_in_t in = rig3_sense(&v, (v3_t){0, 0, 0.6f});
        const outer_out_t out = rig3_step(&f, &p, &in);
        CHECK_NEAR(out.zc_m, 0.4, 1e-4);
      }
    }
}

TEST(outer_corrects_a_slant_range_by_the_tilt_as_it_was_when_it_was_measured) {
  // 20 degrees now and 16 then would be 6.6 mm of 0.3 m. Missed ticks keep the tilt as it was.
  static const struct {
    const char *what;
    int rolls_from, rolls_to, missed_from, missed_to; // the roll ends at 20 degrees; the sample comes at 60
    double then_deg;
    float age_s;
  } row[] = {
      {"tilted for ever, first sample", 0, 0, 0, 0, 20.0, 0.07f},
      {"rolls in", 40, 60, 0, 0, 13.0, 0.07f},
      {"as it is now", 40, 60, 0, 0, 20.0, 0.0f},
      {"tilted before the sample", 20, 40, 0, 0, 20.0, 0.07f},
      {"tilts after the sample", 55, 60, 0, 0, 0.0, 0.07f},
      {"unseen while it rolled", 50, 60, 49, 55, 0.0, 0.07f},
      {"unseen while tilted", 20, 40, 45, 58, 20.0, 0.07f},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    const flight_param_t p = rig3_param();
    outer_t f = rig3_outer(&p);
    rig3_t v = rig3_at(0, 0, 0.7, 1.0);
    outer_out_t out = f.out;
    for (int k = row[i].rolls_to == 0 ? 60 : 0; k <= 60; k++) {
      const int from = row[i].rolls_from, to = row[i].rolls_to;
      const double done = to == from ? 1.0 : fmin(fmax((double)(k - from) / (to - from), 0.0), 1.0);
      const double tilt = done * 20.0 * 3.14159265358979 / 180.0;
      v.up[0] = sin(tilt);
      v.up[2] = cos(tilt);
      outer_in_t in = rig3_sense(&v, (v3_t){0, 0, 0.7f});
      if (k >= row[i].missed_from && k < row[i].missed_to) in.acc_b_mps2.x = NAN;
      in.range_new = k == 60; // the first one: taken as it is
      in.range_m = (float)(0.3 / cos(row[i].then_deg * 3.14159265358979 / 180.0));
      in.range_age_s = row[i].age_s;
      out = rig3_step(&f, &p, &in);
    }
    CHECK_NEAR(out.zc_m, 0.3, 1e-4);
  }
}

TEST(outer_uses_the_age_of_a_range_sample) {
  // At 0.3 m/s a sample that is 130 ms old is 4 cm off.
  const flight_param_t p = rig3_param();
  outer_t f = rig3_outer(&p);
  for (int k = 0; k < 120; k++) {
    ROW("tick %d", k);
    const float gap_m = 0.45f - 0.003f * (float)k;
    const outer_in_t in = {.pos_w_m = {0, 0, 1.0f - gap_m},
                           .vel_w_mps = {0, 0, 0.3f},
                           .acc_b_mps2 = {0, 0, GRAVITY_MPS2},
                           .q_wb = {1, 0, 0, 0},
                           .thrust_N = 0.314f,
                           .range_new = k >= 13 && k % 10 == 3,
                           .range_m = gap_m + 0.039f,
                           .range_age_s = 0.13f};
    const outer_out_t out = rig3_step(&f, &p, &in);
    if (k >= 13) CHECK_NEAR(out.zc_m, gap_m, 0.004); // the climb of the very first tick is not known
  }
}

TEST(outer_takes_the_same_range_again_after_a_climb_for_no_measurement) {
  static const struct {
    double climb_m;
    double zc_m; // 0.3 m under the ceiling at first
  } row[] = {{0.005, 0.3}, {0.03, 0.27}, {-0.03, 0.33}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%g m", row[i].climb_m);
    const flight_param_t p = rig3_param();
    outer_t f = rig3_outer(&p);
    rig3_t v = rig3_at(0, 0, 0.5, 0.8);
    for (int tick = 0; tick < 300; tick++) {
      v.pos[2] = 0.5 + row[i].climb_m * fmin(tick / 50.0, 1.0);
      outer_in_t in = rig3_sense(&v, (v3_t){0, 0, 0.5f});
      in.vel_w_mps = (v3_t){0, 0, tick < 50 ? (float)(2.0 * row[i].climb_m) : 0.0f};
      in.acc_b_mps2 = (v3_t){0, 0, GRAVITY_MPS2};
      in.range_m = 0.3f + p.up_offset_m;
      in.range_age_s = 0.0f;
      in.range_new = tick % 10 == 0;
      (void)rig3_step(&f, &p, &in);
    }
    CHECK_NEAR((double)f.ceiling.zc_m, row[i].zc_m, 2e-3);
  }
}
