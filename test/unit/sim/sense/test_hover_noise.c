// test_hover_noise.c - noise of the accelerometer against a recorded hover (imu_rpm_500hz, jana05).
#include "base/csv.h"
#include "base/lowpass.h"
#include "flight/scenario.h"
#include "rig/test.h"
#include "sense/noise.h"

#include <stdio.h>

#define G_MPS2  9.81
#define RATE_HZ 500.0
#define FROM_S  4.0 // before, it sinks; after 40 s it no longer turns
#define TO_S    40.0

// Passes 8 to 20 Hz: below is motion, above the sensor's own filter.
typedef struct {
  lowpass_t low[2], high[2];
  double sum2;
  int n;
} band_t;

static void band_init(band_t *b, double at) {
  *b = (band_t){.n = 0};
  for (int i = 0; i < 2; i++) {
    lowpass_init(&b->low[i], 20.0, RATE_HZ, i == 0 ? at : 0.0);
    lowpass_init(&b->high[i], 8.0, RATE_HZ, i == 0 ? at : 0.0);
  }
}

static void band_add(band_t *b, double x, bool settled) {
  for (int i = 0; i < 2; i++) {
    const double smooth = lowpass_step(&b->low[i], x);
    x = smooth - lowpass_step(&b->high[i], smooth);
  }
  if (!settled) return;
  b->sum2 += x * x;
  b->n++;
}

static double band_sd(const band_t *b) {
  return sqrt(b->sum2 / b->n);
}

// Adds what lies between two rows of the log to the three bands, every 2 ms; the log's own rate is 507 Hz.
static void add_between(band_t band[3], const double last[4], const double now[4], double *next_s) {
  for (; *next_s <= now[0]; *next_s += 1.0 / RATE_HZ) {
    const double share = (*next_s - last[0]) / (now[0] - last[0]);
    for (int i = 0; i < 3; i++)
      band_add(&band[i], last[1 + i] + share * (now[1 + i] - last[1 + i]), *next_s > FROM_S + 1.0);
  }
}

static bool recorded(double sd_g[3]) {
  static const char *const name[] = {"t_s", "acc_x_g", "acc_y_g", "acc_z_g"};
  char path[512];
  why_t why;
  csv_file_t *file;
  snprintf(path, sizeof path, "%s/imu_rpm_500hz/jana05.csv", test_data_dir());
  if (!CHECK_OK(csv_open(&file, path, &why))) return false;
  band_t band[3];
  for (int i = 0; i < 3; i++) band_init(&band[i], i == 2 ? 1.0 : 0.0);
  double last[4] = {0.0}, now[4] = {0.0}, next_s = FROM_S;
  for (bool more = true; now[0] < TO_S;) {
    if (!CHECK_OK(csv_next(file, &more, &why)) || !more) break;
    for (int i = 0; i < 4; i++) last[i] = now[i];
    for (int i = 0; i < 4; i++)
      CHECK_OK(csv_number(file, csv_find(file, name[i]), CSV_GAP_REFUSED, &now[i], &why));
    if (last[0] >= FROM_S && now[0] > last[0]) add_between(band, last, now, &next_s);
    if (last[0] < FROM_S) next_s = now[0];
  }
  csv_close(file);
  for (int i = 0; i < 3; i++) sd_g[i] = band_sd(&band[i]);
  return CHECK(now[0] >= TO_S);
}

static void simulated(double sd_g[3]) {
  const truth_t truth = {.q_wb = {.w = 1.0}, .force_b_mps2 = {0.0, 0.0, G_MPS2}, .motors = true};
  imu_t imu;
  imu_init(&imu);
  random_t *random = random_open(3);
  band_t band[3];
  for (int i = 0; i < 3; i++) band_init(&band[i], i == 2 ? 1.0 : 0.0);
  for (int ms = 0; ms < 400000; ms++) {
    const imu_sample_t s = imu_step(&imu, &noise_find("real")->imu, random, &truth);
    const double acc[3] = {s.acc_b_mps2.x, s.acc_b_mps2.y, s.acc_b_mps2.z};
    for (int i = 0; ms % 2 == 0 && i < 3; i++) band_add(&band[i], acc[i] / G_MPS2, ms > 1000);
  }
  random_close(random);
  for (int i = 0; i < 3; i++) sd_g[i] = band_sd(&band[i]);
}

TEST(hover_noise_of_the_accelerometer_is_that_of_a_recorded_one) {
  if (!test_data_dir()) SKIP("no measured data");
  double real_g[3], ours_g[3];
  if (!recorded(real_g)) return;
  simulated(ours_g);
  // The record's own thirds differ by up to 17 % in x and y, and by 2 % in z.
  for (int i = 0; i < 3; i++) {
    ROW("axis %d", i);
    CHECK_NEAR(ours_g[i], real_g[i], 0.1 * real_g[i]);
  }
}

TEST(hover_logs_the_vertical_acceleration_with_the_spread_of_a_recorded_one) {
  request_t request = {.integrate = INTEGRATE_RK4, .seed = 1, .thesis_law = true};
  result_t result;
  why_t why;
  if (!CHECK_OK(result_init(&result, &why))) return;
  CHECK_OK(scenario_find("close-flight")->run(&request, &result, &why));
  double sum = 0.0, sum2 = 0.0;
  int n = 0;
  for (int i = 0; i < result.record.n; i++) {
    const sample_t *s = &result.record.sample[i];
    if (!(s->t_s > 14.0 && s->t_s < 22.0)) continue; // at 10 cm, arrived
    sum += s->sense.acc_mps2;
    sum2 += s->sense.acc_mps2 * s->sense.acc_mps2;
    n++;
  }
  // jana05 0.0089 g; over several flights 0.009 to 0.014 g. The law that ships follows the accelerometer more
  // closely, and moves more above 2 Hz: 0.014 g.
  CHECK_NEAR(sqrt(sum2 / n - sum / n * sum / n) / G_MPS2, 0.0092, 0.0007);
  result_free(&result);
}
