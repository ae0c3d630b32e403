// test_imu.c - accelerometer and gyro: filters, delays, noise, errors, range.
#include "rig/test.h"
#include "sense/imu.h"
#include "sense/noise.h"

#include <string.h>

#define PI 3.14159265358979323846

static truth_t still(bool motors) {
  return (truth_t){.q_wb = {1.0, 0.0, 0.0, 0.0}, .force_b_mps2 = {0.0, 0.0, 9.81}, .motors = motors};
}

// Gain and delay of one axis at a frequency: the output is projected on sine and cosine over whole periods.
static void respond(bool gyro, double f_Hz, double *gain, double *delay_s) {
  imu_t imu;
  imu_init(&imu);
  const imu_param_t perfect = {0};
  double in_phase = 0.0, behind = 0.0;
  for (int i = 0; i < 4000; i++) {
    const double w = 2.0 * PI * f_Hz * i * 1e-3;
    truth_t truth = still(false);
    *(gyro ? &truth.rate_b_radps.y : &truth.force_b_mps2.y) = sin(w);
    const imu_sample_t s = imu_step(&imu, &perfect, NULL, &truth);
    const double y = gyro ? s.gyro_b_radps.y : s.acc_b_mps2.y;
    if (i < 2000) continue;
    in_phase += y * sin(w) / 1000.0;
    behind -= y * cos(w) / 1000.0;
  }
  *gain = sqrt(in_phase * in_phase + behind * behind);
  *delay_s = atan2(behind, in_phase) / (2.0 * PI * f_Hz);
}

TEST(imu_filters_have_the_corner_and_the_delay_of_the_firmwares) {
  static const struct {
    const char *what;
    bool gyro;
    double f_Hz, gain, gain_tol, delay_s;
  } row[] = {
      {"accelerometer at its corner", false, 30.0, 0.70711, 1e-4, 0.25 / 30.0},
      {"gyro at its corner", true, 80.0, 0.70711, 1e-4, 0.25 / 80.0},
      {"accelerometer far below", false, 2.0, 1.0, 1e-3, 0.0075},
      {"gyro far below", true, 2.0, 1.0, 1e-3, 0.0028},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    double gain, delay_s;
    respond(row[i].gyro, row[i].f_Hz, &gain, &delay_s);
    CHECK_NEAR(gain, row[i].gain, row[i].gain_tol);
    CHECK_NEAR(delay_s, row[i].delay_s, 5e-5); // they are known to a tenth of a millisecond
  }
}

TEST(imu_filters_fall_by_forty_decibels_a_decade) {
  double near, far, delay_s;
  respond(false, 60.0, &near, &delay_s);
  respond(false, 120.0, &far, &delay_s);
  CHECK(near / far > 3.9 && near / far < 5.0); // 4, and more towards half the sample rate
}

typedef struct {
  double acc[3], gyro[3];
} spread_t;

static spread_t spread_of(const noise_t *noise, bool motors, uint64_t seed, spread_t *mean) {
  imu_t imu;
  imu_init(&imu);
  random_t *random = random_open(seed);
  const truth_t truth = still(motors);
  const int n = 400000, skip = 200;
  spread_t sum = {{0.0}, {0.0}}, square = {{0.0}, {0.0}};
  for (int i = 0; i < n + skip; i++) {
    const imu_sample_t s = imu_step(&imu, &noise->imu, random, &truth);
    if (i < skip) continue;
    const double v[6] = {s.acc_b_mps2.x,   s.acc_b_mps2.y,   s.acc_b_mps2.z - 9.81,
                         s.gyro_b_radps.x, s.gyro_b_radps.y, s.gyro_b_radps.z};
    for (int k = 0; k < 3; k++) {
      sum.acc[k] += v[k] / n, square.acc[k] += v[k] * v[k] / n;
      sum.gyro[k] += v[3 + k] / n, square.gyro[k] += v[3 + k] * v[3 + k] / n;
    }
  }
  random_close(random);
  *mean = sum;
  for (int k = 0; k < 3; k++) {
    square.acc[k] = sqrt(square.acc[k] - sum.acc[k] * sum.acc[k]);
    square.gyro[k] = sqrt(square.gyro[k] - sum.gyro[k] * sum.gyro[k]);
  }
  return square;
}

TEST(imu_noise_has_the_measured_size_at_rest_and_with_motors) {
  const double g = 9.81, deg = PI / 180.0;
  spread_t mean;
  ROW("at rest"); // recorded: 0.0011 to 0.0013 g, 0.12 to 0.17 deg/s
  const spread_t rest = spread_of(noise_find("real"), false, 5, &mean);
  for (int k = 0; k < 3; k++) {
    CHECK_NEAR(rest.acc[k], 0.0012 * g, 0.0001 * g);
    CHECK_NEAR(rest.gyro[k], 0.14 * deg, 0.02 * deg);
    CHECK_NEAR(mean.acc[k], 0.0, 0.0001 * g);
  }
  ROW("motors"); // of a recorded hover, see test_hover_noise.c
  const spread_t on = spread_of(noise_find("real"), true, 6, &mean);
  CHECK_NEAR(on.acc[0], 0.016 * g, 0.0003 * g);
  CHECK_NEAR(on.acc[2], 0.008 * g, 0.0003 * g);
  CHECK_NEAR(on.gyro[1], 1.0 * deg, 0.02 * deg);
  CHECK_NEAR(on.gyro[2], 0.5 * deg, 0.01 * deg);
}

TEST(imu_errors_are_constant_and_add_up) {
  static const struct {
    const char *field;
    double value;
    d3_t acc, gyro; // at specific force (1, 2, 9.81) and rates (0.1, 0.2, 0.3)
  } row[] = {
      {"acc.bias.z", 0.1, {1.0, 2.0, 9.91}, {0.1, 0.2, 0.3}},
      {"acc.scale", 0.01, {1.01, 2.02, 9.9081}, {0.1, 0.2, 0.3}},
      {"gyro.bias.x", 0.02, {1.0, 2.0, 9.81}, {0.12, 0.2, 0.3}},
      {"gyro.scale", -0.1, {1.0, 2.0, 9.81}, {0.09, 0.18, 0.27}},
      {"mount.x", 0.01, {1.0, 2.0981, 9.79}, {0.1, 0.203, 0.298}}, // rolled left down: gravity on +y
      {"mount.z", 0.01, {1.02, 1.99, 9.81}, {0.102, 0.199, 0.3}},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].field);
    noise_t noise = *noise_find("quiet");
    CHECK(noise_set(&noise, row[i].field, row[i].value));
    truth_t truth = still(true);
    truth.force_b_mps2 = (d3_t){1.0, 2.0, 9.81};
    truth.rate_b_radps = (d3_t){0.1, 0.2, 0.3};
    imu_t imu;
    imu_init(&imu);
    const imu_sample_t s = imu_step(&imu, &noise.imu, NULL, &truth);
    const d3_t a = d3_sub(s.acc_b_mps2, row[i].acc), w = d3_sub(s.gyro_b_radps, row[i].gyro);
    CHECK_NEAR(sqrt(d3_dot(a, a)), 0.0, 1e-12);
    CHECK_NEAR(sqrt(d3_dot(w, w)), 0.0, 1e-12);
  }
}

TEST(imu_clips_at_the_range_of_the_chip) {
  imu_t imu;
  imu_init(&imu);
  const imu_param_t perfect = {0};
  truth_t truth = still(true);
  truth.force_b_mps2.z = -1000.0;
  truth.rate_b_radps.x = 100.0;
  const imu_sample_t s = imu_step(&imu, &perfect, NULL, &truth);
  CHECK_NEAR(s.acc_b_mps2.z, -24.0 * 9.81, 1e-9);
  CHECK_NEAR(s.gyro_b_radps.x, 2000.0 * PI / 180.0, 1e-9);
}

TEST(noise_levels_can_be_set_one_by_one) {
  noise_t noise = *noise_find("real");
  CHECK(noise_find("loud") == NULL);
  CHECK(!noise_set(&noise, "acc.w", 0.1));
  CHECK(!noise_set(&noise, "acc.z", -0.1));
  CHECK(!noise_set(&noise, "acc.z", (double)NAN));
  CHECK(noise.imu.acc_z_mps2 == 0.008 * 9.81);
  for (int i = 0; i < noise_field_count; i++) {
    const noise_field_t *f = &noise_fields[i];
    ROW("%s", f->name);
    CHECK(noise_set(&noise, f->name, 0.125));
    CHECK(noise_get(&noise, f) == 0.125);
    CHECK(strlen(f->source) > 5 && strlen(f->brief) > 5);
    CHECK(strcmp(f->unit, "") == 0 || strcmp(f->unit, "m/s2") == 0 || strcmp(f->unit, "rad/s") == 0 ||
          strcmp(f->unit, "rad") == 0 || strcmp(f->unit, "m") == 0 || strcmp(f->unit, "s") == 0 ||
          strcmp(f->unit, "counts") == 0);
    for (int k = 0; k < noise_count; k++) {
      const double of_level = noise_get(&noise_levels[k], f);
      CHECK(of_level >= f->min && of_level <= f->max);
    }
  }
}
