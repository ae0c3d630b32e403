// test_gap_flights.c - stage 1 on flights: recorded ones by the columns and vehicle files of the tree, and
// simulated ones.
#include "gap/1_read/flight.h"
#include "rig/programs.h"
#include "rig/scratch.h"
#include "rig/test.h"
#include "vehicle/model_file.h"

#include <glob.h>
#include <stdio.h>

// Each folder of recorded flights.
static const struct {
  const char *files, *columns, *vehicle;
  int least; // logs
  double rate_Hz, tol_Hz;
  int null; // a signal that these logs lack; -1: none
} FOLDER[] = {
    {"ground_effect/*.csv", "neural_swarm", "cf21_neural_swarm", 4, 101.3, 0.1, SIG_RANGE},
    {"imu_rpm_500hz/jana??.csv", "imrc", "cf21_imrc", 4, 500.0, 0.1, SIG_RANGE},
    {"imu_rpm_500hz/*_mocap.csv", "imrc_mocap", "cf21_imrc", 4, 101.0, 1.0, SIG_VX},
    {"brushless/flight??.csv", "imrc", "cf21_brushless", 3, 500.0, 0.1, SIG_RANGE},
    {"brushless/*_mocap.csv", "imrc_mocap", "cf21_brushless", 3, 101.0, 1.0, SIG_VX},
    {"nanobench/*.csv", "nanobench", "cf21_nanobench", 2, 100.0, 0.1, SIG_W1},
    {"ceiling_gap/2024*.csv", "air_garage", "cf21_air_garage", 34, 50.0, 1.0, SIG_AX},
    {"quad15/*.csv", "quad15", "quad15", 1, 90.2, 0.1, SIG_M1},
    {"inner_loop_id/*.csv", "inner_loop_id", "cf_inner_loop_id", 1, 500.0, 0.1, SIG_X},
    {"static_imu/est[AG]*.csv", "static_imu", "cf21_static_imu", 2, 500.0, 0.1, SIG_VBAT},
};

static void check_flight(const gap_flight_t *f) {
  int signals = 0;
  for (int s = 0; s < SIG_COUNT; s++) {
    if (!f->v[s] || s == SIG_RANGE) continue;
    int gaps = 0;
    for (int i = 0; i < f->n; i++) gaps += isnan(f->v[s][i]);
    CHECK(gaps < 0.05 * f->n);
    signals++;
  }
  CHECK(signals >= 3);
  for (int i = 1; i < f->n; i++)
    if (!CHECK(f->t_s[i] > f->t_s[i - 1])) break;
}

TEST(gap_reads_every_recorded_flight_by_the_files_of_the_tree) {
  if (!test_data_dir()) SKIP("no measured data");
  for (unsigned i = 0; i < sizeof FOLDER / sizeof *FOLDER; i++) {
    ROW("%s", FOLDER[i].files);
    char pattern[600], path[200];
    glob_t found = {0};
    columns_t columns;
    model_t vehicle;
    why_t why = {""};
    snprintf(pattern, sizeof pattern, "%s/%s", test_data_dir(), FOLDER[i].files);
    snprintf(path, sizeof path, "tools/columns/%s.toml", FOLDER[i].columns);
    CHECK_OK(columns_read(path, &columns, &why));
    CHECK_OK(model_builtin(FOLDER[i].vehicle, &vehicle, &why));
    glob(pattern, 0, NULL, &found);
    CHECK((int)found.gl_pathc >= FOLDER[i].least);
    for (size_t k = 0; k < found.gl_pathc; k++) {
      gap_flight_t f;
      CHECK_OK(gap_read(&f, found.gl_pathv[k], &columns, &vehicle, &why));
      CHECK_TEXT(why.text, "");
      CHECK_NEAR(f.rate_Hz, FOLDER[i].rate_Hz, FOLDER[i].tol_Hz);
      CHECK(f.v[FOLDER[i].null] == NULL);
      check_flight(&f);
      gap_flight_free(&f);
    }
    globfree(&found);
  }
}

TEST(gap_sees_the_recorded_inner_loop_turn_the_way_of_its_commands) {
  if (!test_data_dir()) SKIP("no measured data");
  char line[900], text[4000];
  snprintf(
      line, sizeof line,
      "gap --vehicle sim/vehicle/vehicles/cf_inner_loop_id.toml --columns tools/columns/inner_loop_id.toml "
      "%s/inner_loop_id/data_1901.csv",
      test_data_dir());
  CHECK(program_run(line, STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK(strstr(text, "turn_x ") && strstr(text, "turn_y ") && !strstr(text, "is left out"));
}

TEST(gap_reads_what_fly_writes) {
  static const struct {
    const char *scenario, *vehicle;
  } row[] = {
      {"appendix-a", "thesis_1d"}, {"close-flight", "cf21_legacy"}, {"ceiling-gap", "cf21_air_garage"}};
  const columns_t columns = columns_crazyflie();
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].scenario);
    char line[200], text[200];
    model_t vehicle;
    gap_flight_t f;
    why_t why = {""};
    snprintf(line, sizeof line, "fly %s --log $S/fly.csv", row[i].scenario);
    CHECK_NEAR(program_run(line, STREAM_ERROR, text, sizeof text), 0.0, 0.0);
    CHECK_OK(model_builtin(row[i].vehicle, &vehicle, &why));
    CHECK_OK(gap_read(&f, scratch_path("fly.csv"), &columns, &vehicle, &why));
    CHECK_TEXT(why.text, "");
    CHECK_NEAR(f.rate_Hz, 100.0, 1e-4);
    CHECK(f.v[SIG_Z] && f.v[SIG_AZ] && f.v[SIG_THRUST] && f.cells_bad == 0);
    gap_flight_free(&f);
  }
}

TEST(gap_finds_the_late_attitude_of_the_recorded_estimators) {
  if (!test_data_dir()) SKIP("no measured data");
  // The estimator runs at 100 Hz behind a gyro of 500 Hz: half a period.
  char path[600];
  columns_t columns;
  model_t vehicle;
  gap_flight_t f;
  why_t why = {""};
  snprintf(path, sizeof path, "%s/imu_rpm_500hz/jana05.csv", test_data_dir());
  CHECK_OK(columns_read("tools/columns/imrc.toml", &columns, &why));
  CHECK_OK(model_builtin("cf21_imrc", &vehicle, &why));
  CHECK_OK(gap_read(&f, path, &columns, &vehicle, &why));
  CHECK_NEAR(f.attitude_late_s, 0.005, 0.0005);
  CHECK_NEAR(f.velocity_late_s, 0.0, 0.001);
  CHECK(f.v[SIG_W1] && f.v[SIG_F1] && f.v[SIG_RANGE] == NULL);
  gap_flight_free(&f);
}
