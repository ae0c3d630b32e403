// test_effectiveness_flown.c - G1 and G2 from logs of the complete loop.
#include "flight/scenario.h"
#include "logs/effectiveness.h"
#include "rig/programs.h"
#include "rig/scratch.h"
#include "rig/test.h"
#include "vehicle/model_file.h"

#include <stdio.h>

// What the vehicle file says: newton per unit, moment per newton, inertia. Yaw clockwise.
static void truth(const model_t *m, double g1[3], double *g2) {
  const frame_t *f = &m->frame;
  const double unit_N = 0.25 * m->thrust_max_N / 65535.0, *J = f->inertia_kgm2;
  const double speed_radps = sqrt(0.25 * m->mass_kg * 9.81 / f->kf_Ns2);
  g1[0] = 2.0 * f->rotor_x_m[0] * unit_N / J[0]; // roll and pitch are halved in the mixer
  g1[1] = 2.0 * f->rotor_x_m[0] * unit_N / J[1];
  g1[2] = 4.0 * f->torque_ratio_m * unit_N / J[2];
  *g2 = 4.0 * f->rotor_inertia_kgm2 * unit_N / (2.0 * f->kf_Ns2 * speed_radps) / J[2];
}

// A log of the complete loop, real noise and the filters of the inertial sensors included.
static const char *flown(fly_kind_t kind, model_t *model) {
  const char *path = scratch_path("inner_loop.csv");
  request_t request = {.kind = &kind, .log_500_Hz = true, .integrate = INTEGRATE_RK4, .seed = 1};
  result_t result;
  why_t why;
  if (!CHECK_OK(result_init(&result, &why))) return path;
  CHECK_OK(scenario_find("inner-loop")->run(&request, &result, &why));
  FILE *file = fopen(path, "w");
  if (file) record_write(&result.record, file);
  if (file) fclose(file);
  result_free(&result);
  CHECK_OK(model_builtin("cf21_legacy", model, &why));
  return path;
}

TEST(effectiveness_is_recovered_from_flights_of_fly) {
  static const struct {
    const char *what;
    fly_kind_t kind;
  } row[] = {{"INDI", FLY_INDI}, {"stock PID", FLY_STOCK_PID}, {"stock INDI", FLY_STOCK_INDI}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    model_t model;
    const char *path = flown(row[i].kind, &model);
    const frame_t *f = &model.frame;
    double g1[3], g2;
    truth(&model, g1, &g2);
    effectiveness_job_t job = effectiveness_default();
    job.lag_s = model.motor_tau_s;
    job.delay_s = f->motor_delay_s + 0.0028; // and the gyro's low-pass, sense/imu.h
    effectiveness_t found;
    why_t why;
    if (!CHECK_OK(effectiveness_fit(path, &job, &found, &why))) return;
    CHECK(found.bridged == 0 && found.rows > 32000); // 500 Hz
    for (int k = 0; k < 3; k++) CHECK_NEAR(found.g1[k] / g1[k], 1.0, 0.05);
    CHECK_NEAR(found.g2 / g2, 1.0, 0.05);
  }
}

// On the vehicle controller.* stand still while the app flies.
TEST(effectiveness_is_recovered_from_what_the_deck_writes_of_the_app) {
  static const char *const log[] = {"log00", "calls.csv"};
  char text[400];
  CHECK(program_run("fly inner-loop --integrator rk4 --usd $S/log00 --usd-config tools/usd/config.txt "
                    "--log $S/calls.csv --log-rate 1000 >$S/said",
                    STREAM_OUTPUT, text, sizeof text) == 0);
  for (unsigned i = 0; i < sizeof log / sizeof *log; i++) {
    ROW("%s", log[i]);
    model_t model;
    why_t why;
    effectiveness_t found;
    double g1[3], g2;
    if (!CHECK_OK(model_builtin("cf21_legacy", &model, &why))) return;
    truth(&model, g1, &g2);
    effectiveness_job_t job = effectiveness_default();
    job.lag_s = model.motor_tau_s;
    job.delay_s = model.frame.motor_delay_s + 0.0028;
    job.motor_max_N = 0.25 * model.thrust_max_N;
    char path[400];
    snprintf(path, sizeof path, "%s", scratch_path(log[i]));
    if (!CHECK_OK(effectiveness_fit(path, &job, &found, &why))) return;
    CHECK(found.bridged == 0 && found.rows > 32000);
    for (int k = 0; k < 3; k++) CHECK_NEAR(found.g1[k] / g1[k], 1.0, 0.05);
    CHECK_NEAR(found.g2 / g2, 1.0, 0.05);
  }
}

// It believes half of the published number, which is marked doubtful: too little is borne at any lag of the
// motors from half to twice, too much is not (test_att_indi.c).
TEST(effectiveness_of_the_rotors_inertia_is_twice_what_the_controller_believes) {
  model_t model;
  why_t why;
  flight_param_t param;
  double g1[3], g2;
  if (!CHECK_OK(model_builtin("cf21_legacy", &model, &why))) return;
  params_default(&param);
  truth(&model, g1, &g2);
  CHECK_NEAR(g2 / g1[2], 2.0 * (double)param.att.g2_s, 0.001);
}
