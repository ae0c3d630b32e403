// test_gap_varied.c - other pilots that could have flown the same log (3_feedback/nominal.h).
#include "gap/3_feedback/nominal.h"
#include "gap/5_infer/limits.h"
#include "rig/test.h"

TEST(gap_nominal_pilots_are_varied_about_the_one_that_fits) {
  const closed_loop_t fit = {.rate_gain = {10.0, 12.0, 5.0},
                             .rate_lead = {0.45},
                             .tilt_gain = 30.0,
                             .climb_gain = 3.0,
                             .height_gain = 2.0};
  double low = HUGE_VAL, high = 0.0, together = 0.0;
  for (int i = 0; i < NOMINAL_FLIGHTS; i++) {
    const closed_loop_t v = closed_loop_varied(&fit, i);
    const double turn = v.rate_gain[0] / fit.rate_gain[0], climb = v.climb_gain / fit.climb_gain;
    if (i == 0) CHECK(turn == 1.0 && climb == 1.0);
    CHECK_NEAR(v.rate_lead[0], fmin(turn * fit.rate_lead[0], 0.5), 1e-12); // no more than is read off any log
    CHECK_NEAR(v.tilt_gain, turn * turn * fit.tilt_gain, 1e-9);            // the damping stays
    low = fmin(low, turn), high = fmax(high, turn);
    together += (turn - 1.0) * (climb - 1.0) / NOMINAL_FLIGHTS / 0.03;
  }
  CHECK(low >= 0.7 && low < 0.8 && high > 1.2 && high <= 1.3);
  CHECK(fabs(together) < 0.5);
}

TEST(gap_every_other_nominal_pilot_is_swift_where_rows_miss_commands) {
  closed_loop_t slow = {.rate_gain = {8.0, 12.0, 5.0},
                        .rate_gain_most = 170.0,
                        .tilt_gain = 22.0,
                        .gyro_radps = {0.01, 0.01, 0.01},
                        .angle_rad = 0.002,
                        .turn_noise_radps2 = {0.8, 1.0}};
  for (int unread = 0; unread < 2; unread++) {
    slow.unread = unread;
    for (int i = 0; i < NOMINAL_FLIGHTS; i++) {
      const closed_loop_t v = closed_loop_varied(&slow, i);
      const bool swift = unread && i % 2;
      ROW("%s, pilot %d", unread ? "rows miss commands" : "no row misses one", i);
      CHECK((v.rate_gain[0] > 0.69 * 25.0) == swift && (v.tilt_gain > 100.0) == swift);
      const bool swiftest = v.rate_gain[0] > 0.69 / 1.3 * 170.0 && v.rate_gain[1] == v.rate_gain[0];
      CHECK(swiftest == (swift && i % 4 == 3));
      CHECK(v.rate_gain[0] <= 170.0 && v.tilt_gain <= 0.35 * 1.3 * 25.0 * 170.0);
      CHECK(v.unread == (unread && !swiftest));
      // What it is fed with makes commands as noisy as the log's, and no noisier.
      const double noise = hypot(0.01 * v.rate_gain[0], 0.002 * v.tilt_gain);
      CHECK_NEAR((1.0 - v.spared) * noise, swiftest ? 0.8 : noise, 1e-9);
      CHECK(v.outer_s == (swift ? 0.01 : 0.0) && v.kicks == (swift && !swiftest));
      CHECK(v.rate_gain[2] < 7.0); // a rotor's torque is small
    }
  }
}
