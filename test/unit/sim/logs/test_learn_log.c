// test_learn_log.c - the learner over logs: a curve that is known, and flights that were flown.
#include "base/csv.h"
#include "logs/learn_log.h"
#include "rig/scratch.h"
#include "rig/test.h"
#include "vehicle/model_file.h"

#include <stdio.h>
#include <string.h>

#define G_MPS2 9.81

// --- a made flight ------------------------------------------------------------------------------------

static double curve_at_m(double d_m) {
  return 1.0 + 0.2 * exp(-d_m / 0.03);
}

// Slow sweeps between 1 and 30 cm from a surface, thrust in newton, 31 g; what the motors' lag does is put
// into the command, as a perfect controller would. The first second stands at the surface.
static const char *write_sweeps(const char *name, int ceiling, double phase) {
  char text[700000];
  size_t used = (size_t)snprintf(text, sizeof text,
                                 "timestamp,stateEstimate.z,stateEstimate.qw,stateEstimate.qx,"
                                 "stateEstimate.qy,stateEstimate.qz,acc.x,acc.y,acc.z,indi.thrust\n");
  double thrust_last_N = 0.0;
  for (int i = 0; i < 6000; i++) {
    const double t_s = 0.01 * i, w = 0.7, mean_m = 0.155, swing_m = 0.145;
    const double d_m = mean_m + swing_m * sin(w * t_s + phase), acc = -swing_m * w * w * sin(w * t_s + phase);
    const double force_mps2 = G_MPS2 + (ceiling ? -acc : acc);
    const double thrust_N = 0.031 * force_mps2 / curve_at_m(d_m);
    const double command_N = thrust_N + (i > 0 ? 0.05 * (thrust_N - thrust_last_N) / 0.01 : 0.0);
    thrust_last_N = thrust_N;
    used += (size_t)snprintf(text + used, sizeof text - used, "%d,%.6f,1,0,0,0,0,0,%.6f,%.6f\n", 10 * i,
                             ceiling ? 0.5 - d_m : d_m, force_mps2 / G_MPS2, command_N);
  }
  return scratch_file(name, text, -1);
}

static learn_job_t made_job(int surface) {
  const model_t vehicle = {
      .name = "made", .mass_kg = 0.03, .motor_tau_s = 0.05, .thrust_max_N = 1.0, .ceiling_m = 0.5};
  learn_job_t job;
  learn_job_init(&job, &vehicle, surface);
  job.rest_height_m = 0.0;
  return job;
}

TEST(learn_log_finds_the_curve_that_was_put_in) {
  static const int surfaces[] = {SURFACE_CEILING, SURFACE_GROUND};
  for (int i = 0; i < 2; i++) {
    ROW("%s", i == 0 ? "ceiling" : "ground");
    learn_job_t job = made_job(surfaces[i]);
    learn_mass_t mass = {0};
    learn_t learn;
    learn_score_t score;
    why_t why = {""};
    const char *path = write_sweeps("learn.csv", i == 0, 0.3);
    CHECK_OK(learn_log_mass(&job, path, &mass, NULL, &why));
    // The curve is 0.13 % above 1 at 15 cm, less beyond: that much the mass is too small.
    CHECK_NEAR(learn_mass_kg(&mass), 0.031, 0.031 * 0.002);
    job.param.pos.mass_kg = (float)learn_mass_kg(&mass);
    CHECK_OK(learn_init(&learn, &job.param.learn, &job.param.curve.fixed));
    CHECK_OK(learn_log_teach(&job, path, &learn, &why));
    CHECK_OK(learn_log_score(&job, write_sweeps("held_out.csv", i == 0, 1.7), &learn.rls.theta, &score, NULL,
                             &why));
    CHECK_TEXT(why.text, "");
    // Seven bells are no exponential; a centimetre is the nearest that was flown.
    for (double d_m = 0.012; d_m < 0.1; d_m += 0.004)
      CHECK_NEAR(rbf_at(&learn.rls.theta, (float)d_m).ratio, curve_at_m(d_m), 0.006);
    CHECK(score.all_after_N < 0.2 * score.all_before_N && score.near_after_N < 0.1 * score.near_before_N);
    CHECK_NEAR(score.bias_N, 0.0, 5e-4);
    CHECK_NEAR(score.nearest_m, 0.010, 0.001);
  }
}

TEST(learn_log_carries_weights_from_flight_to_flight) {
  learn_job_t job = made_job(SURFACE_GROUND);
  learn_t learn;
  why_t why;
  const char *path = write_sweeps("learn.csv", 0, 0.0);
  CHECK_OK(learn_init(&learn, &job.param.learn, &job.param.curve.fixed));
  CHECK_OK(learn_log_teach(&job, path, &learn, &why));
  const unsigned once = learn.rls.count;
  CHECK_OK(learn_log_teach(&job, path, &learn, &why));
  CHECK(once > 2000 && learn.rls.count == 2 * once);
}

TEST(learn_log_does_not_take_flying_for_standing_with_a_mass_set_by_hand) {
  learn_job_t job = made_job(SURFACE_GROUND);
  const char *path = write_sweeps("learn.csv", 0, 0.3);
  learn_mass_t mass[2] = {{.n = 0}, {.n = 0}};
  learn_score_t score[2];
  why_t why;
  static const float mass_kg[] = {0.031f, 0.062f};
  for (int i = 0; i < 2; i++) {
    job.param.pos.mass_kg = mass_kg[i];
    CHECK_OK(learn_log_mass(&job, path, &mass[i], NULL, &why));
    CHECK_OK(learn_log_score(&job, path, &job.param.curve.fixed, &score[i], NULL, &why));
  }
  CHECK(mass[0].n > 1000 && mass[1].n == mass[0].n);
  CHECK(score[0].ticks > 4000 && score[1].ticks == score[0].ticks);
  CHECK_NEAR(learn_mass_kg(&mass[1]), 0.031, 0.031 * 0.002);
}

TEST(learn_log_refuses_what_does_not_say_where_the_surface_is) {
  learn_job_t job = made_job(SURFACE_CEILING);
  job.vehicle.ceiling_m = HUGE_VAL;
  learn_mass_t mass = {0};
  why_t why;
  CHECK_STATUS(BAD_INPUT, learn_log_mass(&job, write_sweeps("a.csv", 1, 0.0), &mass, NULL, &why));
  CHECK_TEXT(scratch_short(why.text),
             "a.csv:1: column range.up: missing; --surface ceiling needs the upward range "
             "sensor, or a vehicle with ceiling_m");
  CHECK(mass.n == 0);
}

// --- measured flights ---------------------------------------------------------------------------------

static const char *data_path(const char *name) {
  static char path[400];
  snprintf(path, sizeof path, "%s/%s", test_data_dir(), name);
  return path;
}

static bool measured_job(learn_job_t *job, const char *vehicle, const char *columns) {
  model_t m;
  why_t why = {""};
  CHECK_OK(model_builtin(vehicle, &m, &why));
  learn_job_init(job, &m, SURFACE_GROUND);
  CHECK_OK(columns_read(columns, &job->columns, &why));
  job->rest_height_m = job->columns.rest_height_m;
  return CHECK_TEXT(why.text, "");
}

static void check_held_out(const char *first, const char *second, const char *held_out) {
  const char *learn_from[] = {first, second};
  learn_job_t job;
  learn_mass_t mass = {0};
  learn_t learn;
  learn_score_t score;
  why_t why = {""};
  ROW("%s held out", held_out);
  if (!measured_job(&job, "cf21_neural_swarm", "tools/columns/neural_swarm.toml")) return;
  for (int i = 0; i < 2; i++) CHECK_OK(learn_log_mass(&job, data_path(learn_from[i]), &mass, NULL, &why));
  CHECK_NEAR(learn_mass_kg(&mass), 0.0333, 0.0004); // the data's README: 33.2-33.5 g
  job.param.pos.mass_kg = (float)learn_mass_kg(&mass);
  CHECK_OK(learn_init(&learn, &job.param.learn, &job.param.curve.fixed));
  for (int i = 0; i < 2; i++) CHECK_OK(learn_log_teach(&job, data_path(learn_from[i]), &learn, &why));
  CHECK_OK(learn_log_score(&job, data_path(held_out), &learn.rls.theta, &score, NULL, &why));
  CHECK_TEXT(why.text, "");
  CHECK(score.all_before_N > 7e-3 && score.near_before_N > 15e-3);
  CHECK(score.all_after_N <= score.all_before_N / 2.0);
  CHECK(score.near_after_N <= score.near_before_N / 3.0);
}

TEST(learn_log_explains_a_held_out_flight_near_the_ground) {
  if (!test_data_dir()) SKIP("no measured data");
  static const char *const flight[] = {"ground_effect/21_randomwalk_s_cf50_00.csv",
                                       "ground_effect/21_randomwalk_s_cf50_04.csv",
                                       "ground_effect/21_randomwalk_s_cf50_02.csv"};
  for (int i = 0; i < 3; i++) check_held_out(flight[i], flight[(i + 1) % 3], flight[(i + 2) % 3]);
}

TEST(learn_log_finds_no_curve_where_there_was_no_surface) {
  if (!test_data_dir()) SKIP("no measured data");
  learn_job_t job;
  learn_mass_t mass = {0};
  learn_t learn;
  why_t why = {""};
  if (!measured_job(&job, "cf21_imrc", "tools/columns/imrc.toml")) return;
  const char *path = data_path("imu_rpm_500hz/jana05.csv");
  job.param.learn.far_m = 1.0f; // it flies 0.5 m above the ground
  CHECK_OK(learn_log_mass(&job, path, &mass, NULL, &why));
  CHECK_NEAR(learn_mass_kg(&mass), 0.0347, 0.0347 * 0.02);
  job.param.pos.mass_kg = (float)learn_mass_kg(&mass);
  CHECK_OK(learn_init(&learn, &job.param.learn, &job.param.curve.fixed));
  CHECK_OK(learn_log_teach(&job, path, &learn, &why));
  CHECK(learn.rls.count > 3000);
  CHECK_NEAR(learn.rls.theta.w[0], 1.0, 0.01);
  for (int i = 1; i < RBF_N; i++) CHECK_NEAR(learn.rls.theta.w[i], 0.0, 0.01);
}

TEST(vehicle_maps_agree_with_the_thrust_stand) {
  if (!test_data_dir()) SKIP("no measured data");
  // Mean and largest relative error over the stand's points; the firmware's cubics are of other motors and
  // batteries.
  static const struct {
    const char *vehicle, *stand, *grams;
    double mean, max;
  } row[] = {
      {"cf21_imrc", "thrust_stand/imrc_cf21_legacy.csv", "weight", 0.005, 0.08},
      {"cf21_legacy", "thrust_stand/imrc_cf21_legacy.csv", "weight", 0.03, 0.18},
      {"cf21_plus", "thrust_stand/imrc_cf21plus_250mah.csv", "thrust[g]", 0.06, 0.14},
      {"cf21_neural_swarm", "thrust_stand/imrc_cf21_legacy.csv", "weight", 0.05, 0.12},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].vehicle);
    model_t m;
    csv_file_t *file;
    why_t why = {""};
    if (!CHECK_OK(model_builtin(row[i].vehicle, &m, &why))) continue;
    if (!CHECK_OK(csv_open(&file, data_path(row[i].stand), &why))) continue;
    const int pwm_at = csv_find(file, "pwm"), volts_at = csv_find(file, "vbat[V]"),
              grams_at = csv_find(file, row[i].grams);
    double sum = 0.0, max = 0.0, pwm = 0.0, volts = 0.0, grams = 0.0;
    int n = 0;
    bool more;
    while (csv_next(file, &more, &why) == DONE && more) {
      CHECK_OK(csv_number(file, pwm_at, CSV_GAP_REFUSED, &pwm, &why));
      CHECK_OK(csv_number(file, volts_at, CSV_GAP_REFUSED, &volts, &why));
      CHECK_OK(csv_number(file, grams_at, CSV_GAP_REFUSED, &grams, &why));
      const double error = 4.0 * thrust_map_N(&m.map, pwm, volts) / (grams * 9.81e-3) - 1.0;
      sum += error;
      max = fabs(error) > max ? fabs(error) : max;
      n++;
    }
    csv_close(file);
    CHECK(n > 50);
    CHECK_NEAR(sum / n, 0.0, row[i].mean);
    CHECK_NEAR(max, 0.0, row[i].max);
  }
}
