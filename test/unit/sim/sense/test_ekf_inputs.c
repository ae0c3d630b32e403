// test_ekf_inputs.c - what the estimator takes, drops and hands out, call by call.
#include "rig/ekf_rig.h"
#include "rig/test.h"
#include <string.h>

// What one input changes in the next tick's position and velocity, against the same without it.
static bool is_taken(const ekf_in_t *in, double tilt_rad) {
  ekf_t a, b;
  ekf_init(&a, &ekf_firmware, 0.0);
  ekf_place(&a, (d3_t){0.0, 0.0, 0.4}, (d3_t){0.0, 0.0, 0.0},
            (dq_t){cos(0.5 * tilt_rad), sin(0.5 * tilt_rad), 0.0, 0.0});
  b = a;
  ekf_in_t without = *in;
  without.range_new = without.flow_new = false;
  ekf_step(&a, in);
  ekf_step(&b, &without);
  return memcmp(a.s, b.s, sizeof a.s) != 0;
}

TEST(ekf_drops_outliers_as_the_firmware_does) {
  static const struct {
    const char *what;
    bool range, flow;
    double range_m, flow_x, flow_y, tilt_rad;
    bool taken;
  } row[] = {
      {"range", true, false, 0.45, 0.0, 0.0, 0.0, true},
      {"far range", true, false, 4.999, 0.0, 0.0, 0.0, true},
      {"no ground", true, false, 8.191, 0.0, 0.0, 0.0, false},
      {"5 m", true, false, 5.0, 0.0, 0.0, 0.0, false},
      {"range not a number", true, false, (double)NAN, 0.0, 0.0, 0.0, false},
      {"range at 83 deg", true, false, 0.45, 0.0, 0.0, 83.0 * DEG, true},
      {"range at 85 deg", true, false, 0.45, 0.0, 0.0, 85.0 * DEG, false},
      {"range upside down", true, false, 0.45, 0.0, 0.0, 180.0 * DEG, false},
      {"flow", false, true, 0.0, 99.0, -99.0, 0.0, true},
      {"flow x", false, true, 0.0, 100.0, 0.0, 0.0, false},
      {"flow y", false, true, 0.0, 5.0, -100.0, 0.0, false},
      {"nothing", false, false, 0.3, 5.0, 5.0, 0.0, false},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    const ekf_in_t in = {.imu.acc_b_mps2 = {0.0, 0.0, 9.81},
                         .motors = true,
                         .range_new = row[i].range,
                         .range_m = row[i].range_m,
                         .flow_new = row[i].flow,
                         .flow_x = row[i].flow_x,
                         .flow_y = row[i].flow_y,
                         .flow_span_s = 0.01};
    CHECK(is_taken(&in, row[i].tilt_rad) == row[i].taken);
  }
}

TEST(ekf_starts_anew_when_it_is_out_of_bounds) {
  static const struct {
    const char *what;
    d3_t pos, vel;
    int resets;
  } row[] = {{"within", {99.0, 0.0, 1.0}, {0.0, 9.9, 0.0}, 0},
             {"too far", {-101.0, 0.0, 1.0}, {0.0, 0.0, 0.0}, 1},
             {"too fast", {0.0, 0.0, 1.0}, {0.0, -10.1, 0.0}, 1}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    ekf_t e;
    ekf_init(&e, &ekf_firmware, 0.5);
    ekf_place(&e, row[i].pos, row[i].vel, (dq_t){1.0, 0.0, 0.0, 0.0});
    const ekf_in_t in = {.imu.acc_b_mps2 = {0.0, 0.0, 9.81}, .motors = true};
    ekf_step(&e, &in);
    CHECK(e.resets == row[i].resets);
    if (row[i].resets) CHECK(e.s[0] == 0.0 && e.s[4] == 0.0 && e.q.z == sin(0.25) && e.flying_ms > 0);
  }
}

TEST(ekf_hands_out_what_the_call_before_finished) {
  ekf_t e;
  ekf_init(&e, &ekf_firmware, 0.0);
  ekf_place(&e, (d3_t){0.0, 0.0, 0.4}, (d3_t){0.0, 0.0, 0.0}, (dq_t){1.0, 0.0, 0.0, 0.0});
  const ekf_in_t still = {.imu.acc_b_mps2 = {0.0, 0.0, 9.81}, .motors = true};
  ekf_in_t jump = still;
  jump.range_new = true;
  jump.range_m = 0.5;
  CHECK(ekf_step(&e, &jump).pos_w_m.z == 0.4);
  CHECK(ekf_step(&e, &still).pos_w_m.z > 0.4);
}
