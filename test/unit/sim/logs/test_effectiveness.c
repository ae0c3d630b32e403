// test_effectiveness.c - G1 and G2 from flights whose effectiveness is known, and from the firmware's own
// log.
#include "crazyflie/stock_pid.h"
#include "logs/effectiveness.h"
#include "rig/splitmix.h"
#include "rig/rig6.h"
#include "rig/scratch.h"
#include "rig/test.h"

#include <stdio.h>
#include <string.h>

#define HEAD                                                                                                 \
  "tick,controller.r_roll,controller.r_pitch,controller.r_yaw,controller.cmd_thrust,controller.cmd_roll,"    \
  "controller.cmd_pitch,controller.cmd_yaw\n"

// What the rig says about itself: newton per unit, moment per newton, inertia. Yaw clockwise.
static void truth(const rig6_param_t *body, double unit_N, double g1[3], double *g2) {
  const double hover_N = body->mass_kg * 9.81 / 4.0;
  g1[0] = 2.0 * body->arm_m * unit_N / body->inertia_kgm2.x; // roll and pitch are halved in the mixer
  g1[1] = 2.0 * body->arm_m * unit_N / body->inertia_kgm2.y;
  g1[2] = 4.0 * body->torque_m * unit_N / body->inertia_kgm2.z;
  *g2 = 4.0 * body->rotor_kgm2 * unit_N / (2.0 * sqrt(body->speed_N * hover_N)) / body->inertia_kgm2.z;
}

// A minute of small steps, logged at 500 Hz as the firmware does; every gap_every-th 10 rows are lost.
static const char *simulated(const rig6_param_t *body, double noise_radps, int gap_every) {
  static const d3_t corner[4] = {{0.1, 0, 1}, {0.1, 0.1, 1}, {0, 0.1, 1}, {0, 0, 1}};
  const char *path = scratch_path("simulated.csv");
  FILE *file = fopen(path, "w");
  if (!file) return path;
  fputs(HEAD, file);
  const stock_pid_param_t param = stock_pid_default();
  stock_pid_t pid;
  const pilot_t pilot = stock_pid_pilot(&pid, &param);
  rig6_t r = rig6_at(body, corner[3], 0.0, true);
  splitmix_t random = {.state = 7};
  for (int i = 0; i < 60000; i++) {
    const pilot_setpoint_t set = rig6_hold(corner[i / 600 % 4], i / 450 % 2 ? 0.1 : -0.1);
    pilot_in_t in = rig6_sense(&r, &set);
    in.gyro_b_radps.x += splitmix_normal(&random, noise_radps);
    in.gyro_b_radps.y += splitmix_normal(&random, noise_radps);
    in.gyro_b_radps.z += splitmix_normal(&random, noise_radps);
    double motor_N[4];
    pilot.step(pilot.state, &in, motor_N);
    const stock_command_t *c = &pid.command;
    const bool lost = gap_every > 0 && i / 2 % gap_every < 10 && i > 100;
    if (i % 2 == 0 && !lost)
      fprintf(file, "%d,%.9g,%.9g,%.9g,%.9g,%g,%g,%g\n", 3000 + i, in.gyro_b_radps.x, -in.gyro_b_radps.y,
              in.gyro_b_radps.z, c->thrust, c->roll, c->pitch, c->yaw);
    rig6_step(&r, motor_N);
  }
  fclose(file);
  return path;
}

TEST(effectiveness_is_recovered_from_simulated_flights) {
  static const struct {
    const char *what;
    double rotor_kgm2, noise_radps;
    int gap_every, poles;
  } row[] = {
      {"clean", 1.4e-8, 0, 0, 4},
      {"clean, two poles", 1.4e-8, 0, 0, 2},
      {"heavy rotors", 5e-8, 0, 0, 4},
      {"gyro noise of 0.15 deg/s", 1.4e-8, 0.0026, 0, 4},
      {"one row in eighty and nine more are lost", 1.4e-8, 0, 80, 4},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    rig6_param_t body = rig6_crazyflie();
    body.rotor_kgm2 = row[i].rotor_kgm2;
    effectiveness_job_t job = effectiveness_default();
    job.lag_s = body.tau_s;
    job.poles = row[i].poles;
    effectiveness_t found;
    why_t why;
    double g1[3], g2;
    truth(&body, 0.12 / 65535.0, g1, &g2);
    const char *path = simulated(&body, row[i].noise_radps, row[i].gap_every);
    if (!CHECK_OK(effectiveness_fit(path, &job, &found, &why))) return;
    for (int k = 0; k < 3; k++) CHECK_NEAR(found.g1[k] / g1[k], 1.0, 0.05);
    CHECK_NEAR(found.g2 / g2, 1.0, 0.05);
    if (row[i].gap_every == 0) CHECK(found.bridged == 0 && found.starts == 1);
  }
}

TEST(effectiveness_without_rotor_inertia_has_no_g2) {
  const rig6_param_t body = rig6_crazyflie();
  effectiveness_job_t job = effectiveness_default();
  job.lag_s = body.tau_s;
  effectiveness_t found;
  why_t why;
  if (!CHECK_OK(effectiveness_fit(simulated(&body, 0, 0), &job, &found, &why))) return;
  CHECK_NEAR(found.g2, 0.0, 0.05 * 4.35e-5);
  // A lag that is 20 ms too short looks like a negative one.
  job.lag_s -= 0.02;
  if (!CHECK_OK(effectiveness_fit(simulated(&body, 0, 0), &job, &found, &why))) return;
  CHECK(found.g2 < -0.005 * found.g1[2]);
}

TEST(effectiveness_as_stock_gives_the_numbers_of_the_firmware) {
  const char *dir = test_data_dir();
  if (!dir) SKIP("no measured data");
  char path[512];
  snprintf(path, sizeof path, "%s/inner_loop_id/data_1901.csv", dir);
  static const double stock_g1[3] = EFFECTIVENESS_STOCK_G1;
  effectiveness_job_t job = effectiveness_stock();
  effectiveness_t found;
  why_t why;
  if (!CHECK_OK(effectiveness_fit(path, &job, &found, &why))) return;
  CHECK(found.rows == 19092);
  for (int i = 0; i < 3; i++)
    CHECK_NEAR(found.g1[i], stock_g1[i], 5e-7); // the digits in which they are given
  // Its size is that of the firmware, its sign is not; and the firmware uses it per tick, not per second.
  CHECK_NEAR(found.g2, -EFFECTIVENESS_STOCK_G2, 5e-9);
  // Gaps bridged, flight alone, u where w' is: the same within what is put in there.
  job = effectiveness_default();
  if (!CHECK_OK(effectiveness_fit(path, &job, &found, &why))) return;
  CHECK_NEAR(found.g1[0] / stock_g1[0], 1.0, 0.05);
  CHECK_NEAR(found.g1[1] / stock_g1[1], 1.0, 0.05);
  CHECK_NEAR(found.g1[2] / stock_g1[2], 1.23, 0.05);
  CHECK(found.explained[0] > 0.8 && found.explained[1] > 0.7);
}

TEST(effectiveness_refuses_bad_logs_with_one_line) {
  static const struct {
    const char *text, *line;
  } row[] = {
      {"", "bad.csv:1: the file is empty; allowed: a row of names and rows of numbers"},
      {"tick,controller.r_roll\n1,2\n", "bad.csv:1: column controller.r_pitch: missing"},
      {"time,controller.r_roll\n1,2\n", "bad.csv:1: column tick: missing; allowed: tick or timestamp, in ms"},
      {HEAD "2,0,0,0,0,0,0,0\n4,0,0,x,0,0,0,0\n",
       "bad.csv:3: column controller.r_yaw: not a number: `x`; allowed: a number"},
      {HEAD "2,0,0,0,0,0,0,0\n2,0,0,0,0,0,0,0\n", "bad.csv:3: column tick: 2 after 2; allowed: rising"},
      {HEAD "2,0,0,0,0,0,0,0\n3,0,0,0,0,0,0,0\n",
       "bad.csv:3: column tick: 1 ms after the row before; allowed: multiples of 2 ms"},
      {HEAD "0,0,0,0,0,0,0,0\n10,0,0,0,0,0,0,0\n",
       "bad.csv: 2 rows and 4 ticks missing between them; allowed: a log at 500 Hz"},
      {HEAD "0,0,0,0,0,0,0,0\n2,0,0,0,0,0,0,0\n", "bad.csv: no row counts; allowed: controller.cmd_thrust of "
                                                  "10000 and more (--thrust-min), 0.5 s after a "
                                                  "start"},
      {"tick,controller.r_roll,controller.r_pitch,controller.r_yaw,controller.cmd_roll,controller.cmd_pitch,"
       "controller.cmd_yaw\n0,0,0,0,0,0,0\n2,0,0,0,0,0,0\n",
       "bad.csv: column controller.cmd_roll: never moves while it counts (0 ticks); allowed: a flight that "
       "turns"},
      {"indiIn.step,indiIn.p,indiIn.q,indiIn.r,indi.m1,indi.m2,indi.m3,indi.m4\n2,0,0,0,0,0,0,0\n4,0,0,0,0,0,"
       "0,0\n",
       "bad.csv:3: column indiIn.step: even in all rows; allowed: those of odd steps, in which the inner "
       "loop "
       "runs, or of every call"},
  };
  const effectiveness_job_t job = effectiveness_default();
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].line);
    effectiveness_t found = {.rows = -1};
    why_t why;
    const char *path = scratch_file("bad.csv", row[i].text, -1);
    CHECK_STATUS(BAD_INPUT, effectiveness_fit(path, &job, &found, &why));
    CHECK_TEXT(scratch_short(why.text), row[i].line);
    CHECK(found.rows == -1);
  }
}

// A second and a half of one row every 2 ms: sines in every column, but for one that stands still or is 1e200
// times as large.
static const char *spoilt(int column, double times) {
  const char *path = scratch_path("spoilt.csv");
  FILE *file = fopen(path, "w");
  if (!file) return path;
  fputs(HEAD, file);
  for (int i = 0; i < 750; i++) {
    double v[8];
    for (int k = 0; k < 8; k++) v[k] = k == 4 ? 40000.0 : (k < 4 ? 0.3 : 900.0) * sin(0.02 * (k + 3) * i);
    if (column > 0) v[column] = times > 0.0 ? times * v[column] : 0.3;
    fprintf(file, "%d", 2 * i);
    for (int k = 1; k < 8; k++) fprintf(file, ",%.9g", v[k]);
    fputc('\n', file);
  }
  fclose(file);
  return path;
}

TEST(effectiveness_is_a_number_or_refused) {
  static const struct {
    const char *what;
    int column;
    double times; // 0: the column stands still
    const char *line;
  } row[] = {
      {"all move", 0, 0.0, ""},
      {"the gyro's roll stands", 1, 0.0,
       "spoilt.csv: column controller.r_roll: never moves while it counts (500 ticks); "
       "allowed: a flight that turns"},
      {"the gyro's yaw stands", 3, 0.0,
       "spoilt.csv: column controller.r_yaw: never moves while it counts (500 ticks); "
       "allowed: a flight that turns"},
      {"the command of pitch stands", 6, 0.0,
       "spoilt.csv: column controller.cmd_pitch: never moves while it counts (500 ticks); "
       "allowed: a flight that turns"},
      {"the command of yaw stands", 7, 0.0,
       "spoilt.csv: column controller.cmd_yaw: never moves while it counts (500 ticks); "
       "allowed: a flight that turns"},
      {"a gyro without bounds", 2, 1e200,
       "spoilt.csv: columns controller.r_pitch, controller.cmd_pitch: too large to be fitted; "
       "allowed: rad/s and 16-bit units"},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    const effectiveness_job_t job = effectiveness_default();
    effectiveness_t found = {.rows = -1};
    why_t why = {""};
    const done_t status = effectiveness_fit(spoilt(row[i].column, row[i].times), &job, &found, &why);
    CHECK_STATUS(row[i].line[0] ? BAD_INPUT : DONE, status);
    CHECK_TEXT(scratch_short(why.text), row[i].line);
    if (status != DONE) continue;
    for (int k = 0; k < 3; k++) CHECK(isfinite(found.g1[k]) && isfinite(found.explained[k]));
  }
}
