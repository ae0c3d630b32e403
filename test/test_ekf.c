// test_ekf.c - the estimator on known motions: size of its errors, delays, bias, ground, outliers,
// repeatability.
#include "estimator/ekf.h"
#include "kinematic.h"
#include "plant/noise6.h"
#include "test.h"
#include <string.h>

#define BIAS_Z 0.0122 // s2, s: errors of height and climb for each m/s2 of bias (ekf.h)
#define BIAS_V 0.153
#define DEG    (3.14159265358979323846 / 180.0)

typedef struct {
  imu_t imu;
  range_t range;
  ekf_t ekf;
  random_t *random;
  noise6_t noise;
} rig_t;

static rig_t rig(const char *level, uint64_t seed) {
  rig_t r = {.noise = *noise6_find(level), .random = random_open(seed)};
  imu_init(&r.imu);
  range_init(&r.range);
  ekf_init(&r.ekf, &ekf_firmware, 0.0);
  return r;
}

static ekf_in_t sense(rig_t *r, const truth_t *truth) {
  const imu_sample_t imu = imu_step(&r->imu, &r->noise.imu, r->random, truth);
  const range_sample_t range = range_step(&r->range, &r->noise.range, r->random, truth);
  return (ekf_in_t){.acc_b_mps2 = imu.acc_b_mps2,
                    .gyro_b_radps = imu.gyro_b_radps,
                    .motors = truth->motors,
                    .range_new = range.down_new,
                    .range_m = range.down_m,
                    .flow_new = range.flow_new,
                    .flow_x = range.flow_x,
                    .flow_y = range.flow_y,
                    .flow_span_s = range.flow_span_s};
}

static ekf_out_t tick(rig_t *r, const truth_t *truth) {
  const ekf_in_t in = sense(r, truth);
  return ekf_step(&r->ekf, &in);
}

static void place(rig_t *r, const truth_t *t) {
  ekf_place(&r->ekf, t->pos_w_m, t->vel_w_mps, t->q_wb);
}

// Errors of one flight: root mean squares, and the largest.
typedef struct {
  double z_m, climb_mps, side_mps, tilt_rad, yaw_rad, z_max_m, xy_end_m, z_mean_m, climb_mean_mps;
} errors_t;

static void compare(errors_t *e, const ekf_out_t *out, const truth_t *truth) {
  const d3_t dp = d3_sub(out->pos_w_m, truth->pos_w_m), dv = d3_sub(out->vel_w_mps, truth->vel_w_mps);
  const dq_t q = truth->q_wb, dq = dq_mul(out->q_wb, (dq_t){q.w, -q.x, -q.y, -q.z});
  e->z_m += dp.z * dp.z;
  e->climb_mps += dv.z * dv.z;
  e->side_mps += dv.x * dv.x + dv.y * dv.y;
  e->tilt_rad += 4.0 * (dq.x * dq.x + dq.y * dq.y);
  e->yaw_rad += 4.0 * dq.z * dq.z;
  e->z_mean_m += dp.z;
  e->climb_mean_mps += dv.z;
  e->z_max_m = fmax(e->z_max_m, fabs(dp.z));
  e->xy_end_m = hypot(dp.x, dp.y);
}

static errors_t follow(rig_t *r, const kinematic_t *path, double from_s, double to_s) {
  errors_t e = {0};
  const truth_t start = kinematic_at(path, 0.0);
  place(r, &start);
  int n = 0;
  for (int ms = 0; ms < 1000.0 * to_s; ms++) {
    const truth_t truth = kinematic_at(path, 1e-3 * ms);
    const ekf_out_t out = tick(r, &truth);
    if (ms < 1000.0 * from_s) continue;
    compare(&e, &out, &truth);
    n++;
  }
  double *const mean_square[] = {&e.z_m, &e.climb_mps, &e.side_mps, &e.tilt_rad, &e.yaw_rad};
  for (unsigned i = 0; i < sizeof mean_square / sizeof *mean_square; i++)
    *mean_square[i] = sqrt(*mean_square[i] / n);
  e.z_mean_m /= n;
  e.climb_mean_mps /= n;
  return e;
}

static const kinematic_t hover = {
    .span_s = 1.0, .from_m = {0, 0, 0.3}, .to_m = {0, 0, 0.3}, .ceiling_m = 0.5};
static const kinematic_t climb = {
    .start_s = 1.0, .span_s = 2.0, .from_m = {0, 0, 0.1}, .to_m = {0, 0, 0.6}, .ceiling_m = 0.8};
static const kinematic_t step = {
    .start_s = 1.0, .span_s = 1.5, .from_m = {0, 0, 0.4}, .to_m = {0.6, 0.3, 0.4}, .ceiling_m = 0.8};
static const kinematic_t turn = {.start_s = 1.0,
                                 .span_s = 3.0,
                                 .from_m = {0, 0, 0.4},
                                 .to_m = {0, 0, 0.4},
                                 .yaw_to_rad = 2.0,
                                 .ceiling_m = 0.8};

TEST(ekf_follows_known_motions_with_errors_of_realistic_size) {
  // Largest root mean squares allowed: mm, mm/s, mm/s, degrees. Quiet: what delay and dead zone leave. Climbs
  // of 0.6 m/s lag by 20 ms; a yaw of 0.8 rad/s lags by 9 ms.
  static const struct {
    const char *what, *level;
    const kinematic_t *path;
    double z_mm, climb_mmps, side_mmps, tilt_deg, yaw_deg;
  } row[] = {
      {"hover, quiet", "quiet", &hover, 0.01, 0.01, 0.01, 0.001, 0.001},
      {"climb, quiet", "quiet", &climb, 4.0, 9.0, 0.01, 0.001, 0.001},
      {"sideways, quiet", "quiet", &step, 0.2, 2.0, 20.0, 0.35, 0.01},
      {"turn, quiet", "quiet", &turn, 0.01, 0.01, 0.01, 0.01, 0.45},
      {"hover", "real", &hover, 1.5, 10.0, 40.0, 0.25, 0.1},
      {"climb", "real", &climb, 5.0, 15.0, 50.0, 0.25, 0.1},
      {"sideways", "real", &step, 1.6, 10.0, 50.0, 0.4, 0.2},
      {"turn", "real", &turn, 1.6, 10.0, 50.0, 0.25, 0.5},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    rig_t r = rig(row[i].level, 11);
    const errors_t e = follow(&r, row[i].path, 1.0, 6.0);
    CHECK(1e3 * e.z_m < row[i].z_mm);
    CHECK(1e3 * e.climb_mps < row[i].climb_mmps);
    CHECK(1e3 * e.side_mps < row[i].side_mmps);
    CHECK(e.tilt_rad < row[i].tilt_deg * DEG);
    CHECK(e.yaw_rad < row[i].yaw_deg * DEG);
    CHECK(e.xy_end_m < 0.2);
    CHECK(r.ekf.resets == 0);
    random_close(r.random);
  }
}

TEST(ekf_height_near_the_ground_is_good_to_a_millimetre_and_knows_it) {
  rig_t r = rig("real", 4);
  const errors_t e = follow(&r, &hover, 2.0, 60.0);
  CHECK_NEAR(e.z_m, 0.00115, 0.0002);
  CHECK_NEAR(e.climb_mps, 0.0080, 0.0015);
  CHECK(fabs(e.z_mean_m) < 0.0002 && fabs(e.climb_mean_mps) < 0.001);
  // What it expects of itself is somewhat larger, because it expects 1 m/s2 of unknown acceleration.
  CHECK(sqrt(r.ekf.P[2][2]) > e.z_m && sqrt(r.ekf.P[2][2]) < 2.0 * e.z_m);
  for (int i = 0; i < EKF_N; i++)
    for (int j = 0; j < EKF_N; j++) CHECK(r.ekf.P[i][j] == r.ekf.P[j][i]);
  random_close(r.random);
}

static truth_t level(double z_m, d3_t vel, d3_t rate) {
  return (truth_t){.pos_w_m = {0.0, 0.0, z_m},
                   .vel_w_mps = vel,
                   .q_wb = {1.0, 0.0, 0.0, 0.0},
                   .rate_b_radps = rate,
                   .force_b_mps2 = {0.0, 0.0, 9.81},
                   .up_m = HUGE_VAL,
                   .down_m = z_m,
                   .motors = true};
}

TEST(ekf_height_lags_by_the_age_of_the_range_and_by_half_a_prediction) {
  // Of a steady climb the mean innovation is 0. At odd samples the newest prediction is 5 ms old, at even
  // ones new, the range 13 ms: the prediction lags 13 - 2.5 ms; it is then held 0 to 9 ms and handed out 1 ms
  // later.
  rig_t r = rig("quiet", 1);
  const double climb_mps = 0.2;
  const truth_t start = level(0.1, (d3_t){0.0, 0.0, climb_mps}, (d3_t){0.0, 0.0, 0.0});
  place(&r, &start);
  double lag_s = 0.0;
  for (int ms = 0; ms < 6000; ms++) {
    const truth_t truth = level(0.1 + 1e-3 * climb_mps * ms, start.vel_w_mps, start.rate_b_radps);
    const ekf_out_t out = tick(&r, &truth);
    if (ms >= 3000) lag_s += (truth.pos_w_m.z - out.pos_w_m.z) / climb_mps / 3000.0;
  }
  CHECK_NEAR(lag_s, 0.0105 + 0.0045 + 0.001, 0.0015);
  random_close(r.random);
}

TEST(ekf_attitude_lags_by_the_gyro_filter_and_half_a_prediction) {
  // Gyro 2.8 ms, the mean over ten samples and its hold 0 to 9 ms, 1 ms to be handed out.
  rig_t r = rig("quiet", 1);
  const truth_t start = kinematic_at(&turn, 0.0);
  place(&r, &start);
  double behind = 0.0, square = 0.0;
  for (int ms = 0; ms < 5000; ms++) {
    const truth_t truth = kinematic_at(&turn, 1e-3 * ms);
    const ekf_out_t out = tick(&r, &truth);
    const double error = 2.0 * (truth.q_wb.z * out.q_wb.w - truth.q_wb.w * out.q_wb.z),
                 rate = truth.rate_b_radps.z;
    behind += error * rate;
    square += rate * rate;
  }
  CHECK_NEAR(behind / square, 0.0028 + 0.0045 + 0.001 + 0.0005, 0.001);
  random_close(r.random);
}

// The vertical axis alone, with the filter's numbers, written anew: two states, noise each ms, prediction
// each 10 ms, range each 25 ms. Mean errors that a constant acceleration error leaves.
static void bias_by_two_states(double bias, double range_sd_m, double *z_m, double *climb_mps) {
  double p11 = 1e-6, p12 = 0.0, p22 = 1e-4, z = 0.0, v = 0.0;
  *z_m = *climb_mps = 0.0;
  for (int ms = 1; ms <= 20000; ms++) {
    if (ms % 10 == 0) {
      z += 0.01 * v + 0.5e-4 * bias;
      v += 0.01 * bias;
      p11 += 0.02 * p12 + 1e-4 * p22;
      p12 += 0.01 * p22;
    }
    p22 += 1e-6;
    if (ms % 25 == 0) {
      const double s = p11 + range_sd_m * range_sd_m, k1 = p11 / s, k2 = p12 / s, error = -z;
      z += k1 * error;
      v += k2 * error;
      p22 -= k2 * p12;
      p12 -= k1 * p12;
      p11 -= k1 * p11;
    }
    if (ms > 10000) *z_m += z / 10000.0, *climb_mps += v / 10000.0;
  }
}

TEST(ekf_answers_an_accelerometer_bias_as_two_states_do) {
  static const struct {
    double bias, height_m;
  } row[] = {{0.1, 0.3}, {-0.1, 0.3}, {0.3, 0.3}, {0.1, 0.05}, {0.1, 1.0}, {0.01, 0.5}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("bias %g at %g m", row[i].bias, row[i].height_m);
    rig_t r = rig("quiet", 1);
    CHECK(noise6_set(&r.noise, "acc.bias.z", row[i].bias));
    kinematic_t path = hover;
    path.from_m.z = path.to_m.z = row[i].height_m;
    const errors_t e = follow(&r, &path, 10.0, 20.0);
    double z_m, climb_mps;
    const double sd_m = 0.0025 * (1.0 + exp(log(80.0) / 1.5 * (row[i].height_m - 2.5)));
    bias_by_two_states(row[i].bias, sd_m, &z_m, &climb_mps);
    CHECK_NEAR(e.z_mean_m / z_m, 1.0, 0.01); // the floor of the variances is in one of them only
    CHECK_NEAR(e.climb_mean_mps / climb_mps, 1.0, 0.01);
    // The header's numbers.
    CHECK_NEAR(e.z_mean_m, BIAS_Z * row[i].bias, 0.03 * BIAS_Z * fabs(row[i].bias));
    CHECK_NEAR(e.climb_mean_mps, BIAS_V * row[i].bias, 0.03 * BIAS_V * fabs(row[i].bias));
    CHECK(e.side_mps < 1e-6 && e.tilt_rad < 1e-6);
    random_close(r.random);
  }
}

// Runs `ms` ticks of unchanging inputs of the quiet rig.
static ekf_out_t stay(rig_t *r, const truth_t *truth, int ms) {
  ekf_out_t out = r->ekf.out;
  for (int i = 0; i < ms; i++) out = tick(r, truth);
  return out;
}

TEST(ekf_in_flight_ignores_the_horizontal_accelerometer_and_on_the_ground_does_not) {
  static const struct {
    const char *what;
    bool motors;
    int after_ms;
    bool ignored;
  } row[] = {{"in flight", true, 1000, true},
             {"motors off for less than 2 s", false, 1900, true},
             {"on the ground", false, 2300, false}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    rig_t a = rig("quiet", 1), b = rig("quiet", 1);
    truth_t truth = level(0.3, (d3_t){0.0, 0.0, 0.0}, (d3_t){0.0, 0.0, 0.0});
    place(&a, &truth);
    place(&b, &truth);
    CHECK(noise6_set(&b.noise, "acc.bias.x", 1.0));
    truth.motors = row[i].motors;
    const ekf_out_t x = stay(&a, &truth, row[i].after_ms), y = stay(&b, &truth, row[i].after_ms);
    CHECK((x.vel_w_mps.x == y.vel_w_mps.x && x.q_wb.y == y.q_wb.y) == row[i].ignored);
    CHECK_NEAR(y.acc_w_mps2.x, cos(2.0 * asin(y.q_wb.y)) + 9.81 * 2.0 * y.q_wb.y * y.q_wb.w,
               1e-3); // always handed out
    random_close(a.random);
    random_close(b.random);
  }
}

TEST(ekf_on_the_ground_goes_back_to_level_and_in_flight_does_not) {
  // A yaw error is seen by nothing else: 0.1 % of it each 10 ms, a tenth each second.
  static const struct {
    bool motors;
    double want;
  } row[] = {{false, 0.904837}, {true, 1.0}};
  for (int i = 0; i < 2; i++) {
    rig_t r = rig("quiet", 1);
    truth_t truth = level(0.01, (d3_t){0.0, 0.0, 0.0}, (d3_t){0.0, 0.0, 0.0});
    r.ekf.q = (dq_t){cos(0.1), 0.0, 0.0, sin(0.1)};
    truth.motors = row[i].motors;
    const ekf_out_t out = stay(&r, &truth, 1000);
    CHECK_NEAR(2.0 * asin(out.q_wb.z) / 0.2, row[i].want, 2e-3);
    random_close(r.random);
  }
}

TEST(ekf_in_flight_finds_level_again_through_the_flow_but_for_the_dead_zone) {
  // Corrections of less than 1e-4 rad each are dropped: without noise the last quarter of a degree stays, and
  // with it 2 cm/s of velocity. Noise carries the corrections over the edge.
  rig_t r = rig("quiet", 1);
  truth_t truth = level(0.4, (d3_t){0.0, 0.0, 0.0}, (d3_t){0.0, 0.0, 0.0});
  place(&r, &truth);
  r.ekf.q = dq_unit((dq_t){1.0, sin(1.0 * DEG), 0.0, 0.0}); // believes in 2 deg of roll
  stay(&r, &truth, 3000);
  ekf_out_t out = stay(&r, &truth, 3000);
  CHECK_NEAR(2.0 * out.q_wb.x, 0.24 * DEG, 0.02 * DEG);
  CHECK_NEAR(out.vel_w_mps.y, -0.0187, 0.001);
  r.noise = *noise6_find("real");
  double mean = 0.0;
  for (int ms = 0; ms < 20000; ms++) {
    out = tick(&r, &truth);
    if (ms >= 2000) mean += 2.0 * out.q_wb.x / 18000.0;
  }
  CHECK_NEAR(mean, 0.0, 0.08 * DEG);
  random_close(r.random);
}

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
    const ekf_in_t in = {.acc_b_mps2 = {0.0, 0.0, 9.81},
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
    const ekf_in_t in = {.acc_b_mps2 = {0.0, 0.0, 9.81}, .motors = true};
    ekf_step(&e, &in);
    CHECK(e.resets == row[i].resets);
    if (row[i].resets) CHECK(e.s[0] == 0.0 && e.s[4] == 0.0 && e.q.z == sin(0.25) && e.flying_ms > 0);
  }
}

TEST(ekf_hands_out_what_the_call_before_finished) {
  ekf_t e;
  ekf_init(&e, &ekf_firmware, 0.0);
  ekf_place(&e, (d3_t){0.0, 0.0, 0.4}, (d3_t){0.0, 0.0, 0.0}, (dq_t){1.0, 0.0, 0.0, 0.0});
  const ekf_in_t still = {.acc_b_mps2 = {0.0, 0.0, 9.81}, .motors = true};
  ekf_in_t jump = still;
  jump.range_new = true;
  jump.range_m = 0.5;
  CHECK(ekf_step(&e, &jump).pos_w_m.z == 0.4);
  CHECK(ekf_step(&e, &still).pos_w_m.z > 0.4);
}

// Everything that came out of four seconds of a flight.
static void flown(uint64_t seed, double ceiling_m, ekf_out_t *out, int n) {
  rig_t r = rig("real", seed);
  kinematic_t path = step;
  path.ceiling_m = ceiling_m;
  const truth_t start = kinematic_at(&path, 0.0);
  place(&r, &start);
  for (int ms = 0; ms < n; ms++) {
    const truth_t truth = kinematic_at(&path, 1e-3 * ms);
    out[ms] = tick(&r, &truth);
  }
  random_close(r.random);
}

TEST(ekf_never_reads_the_upward_range_and_the_same_seed_gives_the_same_bits) {
  enum { N = 4000 };
  static ekf_out_t first[N], other[N];
  flown(7, 0.45, first, N);
  flown(7, 0.45, other, N);
  CHECK(memcmp(first, other, sizeof first) == 0);
  flown(7, HUGE_VAL, other, N);
  CHECK(memcmp(first, other, sizeof first) == 0);
  flown(8, 0.45, other, N);
  CHECK(memcmp(first, other, sizeof first) != 0);
}

TEST(ekf_takes_off_from_the_ground) {
  rig_t r = rig("real", 2);
  kinematic_t path = climb;
  path.from_m.z = 0.02;
  path.start_s = 3.0;
  path.motors_on_s = 2.5;
  errors_t e = {0};
  for (int ms = 0; ms < 16000; ms++) {
    const truth_t truth = kinematic_at(&path, 1e-3 * ms);
    const ekf_out_t out = tick(&r, &truth);
    if (ms == 2400) CHECK_NEAR(out.pos_w_m.z, 0.02, 0.004);
    if (ms >= 6000) compare(&e, &out, &truth);
  }
  CHECK(sqrt(e.z_m / 10000.0) < 0.002);
  CHECK(sqrt(e.climb_mps / 10000.0) < 0.015);
  CHECK(sqrt(e.tilt_rad / 10000.0) < 0.5 * DEG);
  random_close(r.random);
}
