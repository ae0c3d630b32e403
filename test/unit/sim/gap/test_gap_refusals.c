// test_gap_refusals.c - stage 1: units, signs and sensors by which a log contradicts physics or itself.
#include "gap/1_read/flight.h"
#include "rig/flight_csv.h"
#include "rig/scratch.h"
#include "rig/test.h"
#include "vehicle/model_file.h"

#include <stdio.h>
#include <string.h>

static done_t read_made(gap_flight_t *f, const flight_csv_t *made, why_t *why) {
  const columns_t columns = flight_csv_columns();
  model_t vehicle;
  TRY(model_builtin("cf21_legacy", &vehicle, why));
  return gap_read(f, flight_csv_file(made, "f.csv"), &columns, &vehicle, why);
}

// Row 53 of the faults: wrong units; and signs and frames, which contradict.
static const struct {
  const char *what;
  flight_csv_t made;
  const char *want;
} contradicting[] = {
    {"acceleration in m/s2",
     {.column = FC_AX, .more = 2, .scale = 9.81},
     "column acc.z: mean |acceleration| 97.4 m/s2 over the whole flight; allowed: 4.905 to 30.41 m/s2; the "
     "unit "
     "m/s2 would fit (factor 0.1019)"},
    {"gyro in rad/s",
     {.column = FC_GX, .more = 2, .scale = 0.0174533},
     "column gyro.x: the attitude turns 57.3 times as far along axis x as the gyro says over the whole "
     "flight; "
     "allowed: 0.33 to 3; the unit rad/s would fit (factor 57.3)"},
    {"height in mm",
     {.column = FC_Z, .scale = 1000.0},
     "column stateEstimate.z: 738.041 m is not plausible; allowed: -30 to 100 m; the unit cm would fit "
     "(factor 0.01), or mm would fit (factor 0.001)"},
    {"height in cm",
     {.column = FC_Z, .scale = 100.0},
     "column stateEstimate.vz: the position moves 100 times as far along axis z as the velocity says over "
     "the "
     "whole flight; allowed: 0.33 to 3; of column stateEstimate.z the unit cm would fit (factor 0.01)"},
    {"climb in mm/s",
     {.column = FC_VZ, .scale = 1000.0},
     "column stateEstimate.vz: 452.525 m/s is not plausible"},
    {"volts in mV",
     {.column = FC_VBAT, .scale = 1000.0},
     "column pm.vbat: 3900 V is not plausible; allowed: 1 to 60 V; the unit mV would fit (factor 0.001)"},
    {"time in s",
     {.column = FC_TIME, .scale = 0.001},
     "column timestamp: rows are apart by 1e-05 s; allowed: 0.00045 to 0.025 s; the unit s would fit (factor "
     "1000)"},
    {"time in us",
     {.column = FC_TIME, .scale = 1000.0},
     "column timestamp: rows are apart by 10 s; allowed: 0.00045 to 0.025 s; the unit us would fit (factor "
     "0.001)"},
    {"motors in percent",
     {.column = FC_M1, .more = 3, .scale = 100.0 / 65535.0},
     "column motor.m1: the largest motor command is 72.8 pwm over the whole flight; allowed: 1000 to "
     "6.554e+04 "
     "pwm; "
     "the unit percent would fit (factor 655.4)"},
    {"range in m",
     {.column = FC_RANGE, .scale = 0.001},
     "column range.up: the largest range is 0.00109 m over the whole flight; allowed: 0.02 to 40 m; the unit "
     "m "
     "would fit (factor 1000)"},
    {"rotor speeds in rad/s",
     {.column = FC_W1, .more = 3, .scale = 0.1047198},
     "the unit rad/s would fit (factor 9.549)"},
    {"gyro of the other sign",
     {.column = FC_GY, .scale = -1.0},
     "column gyro.y: the attitude turns -1 times as far along axis y as the gyro says over the whole flight; "
     "allowed: 0.33 to 3; the other sign of one of both would fit (scale = -1 in a columns file)"},
    {"attitude inverse", {.column = FC_QX, .more = 2, .scale = -1.0}, "column gyro.x: the attitude turns -"},
    {"z down",
     {.column = FC_Z, .scale = -1.0},
     "column stateEstimate.vz: the position moves -1 times as far along axis z as the velocity says"},
    {"climb of the other sign",
     {.column = FC_VZ, .scale = -1.0},
     "column stateEstimate.vz: the position moves -1 times as far along axis z as the velocity says over the "
     "whole flight; allowed: 0.33 to 3; the other sign of one of both would fit"},
    {"climb of the other sign in a short log",
     {.column = FC_VZ, .scale = -1.0, .rows = 300},
     "column stateEstimate.vz: the position moves -1 times as far along axis z as the velocity says"},
    {"gravity taken out", {.column = FC_AZ, .offset = -1.0}, "column acc.z: mean |acceleration|"},
    {"acceleration down",
     {.column = FC_AZ, .scale = -1.0},
     "column acc.z: turned by the attitude, the mean specific force upwards is -9.48"},
    {"not a length", {.column = FC_QX, .offset = 0.7}, "column stateEstimate.qw: the quaternion's length is"},
    {"another vehicle's motors",
     {.column = FC_M1, .more = 3, .scale = 0.25},
     "column motor.m1: commands to vehicle Crazyflie 2.1, legacy propellers give 0"},
    {"accelerometer stuck",
     {.column = FC_AY, .from_s = 5.0, .hold_s = 0.8},
     "f.csv:502: column acc.y: stands at"},
    {"accelerometer at nothing",
     {.column = FC_AY, .cell = "0"},
     "column acc.y: stands at 0 m/s2 for 0.50 s and longer in flight; is the sensor stuck? (a simulator "
     "without noise: let it begin beside its set point)"},
    {"gyro stuck", {.column = FC_GZ, .from_s = 5.0, .hold_s = 0.8}, "f.csv:502: column gyro.z: stands at"},
    {"gyro dead", {.column = FC_GX, .scale = 1e-30}, "column gyro.x: "},
    {"attitude stuck",
     {.column = FC_QW, .more = 3, .from_s = 5.0, .hold_s = 0.8},
     "f.csv:502: column stateEstimate.qw: stands at"},
    {"height stuck",
     {.column = FC_X, .more = 2, .from_s = 5.0, .hold_s = 1.5},
     "f.csv:502: column stateEstimate.x: stands at"},
    {"motors stuck",
     {.column = FC_M1, .more = 3, .from_s = 5.0, .hold_s = 0.8},
     "f.csv:502: column motor.m1: stands at"},
    {"voltage stuck",
     {.column = FC_VBAT, .from_s = 5.0, .hold_s = 12.0},
     "f.csv:502: column pm.vbat: stands at 3.89 V for 10.00 s and longer in flight; is the sensor stuck? "
     "(without a battery: vbat = {value = ..., unit = \"V\"} in a columns file)"},
    {"half of a motor's commands",
     {.column = FC_M2, .scale = 0.5},
     "column motor.m2: the mean is 0.5 of the other motors' in flight; allowed: 0.65 to 1.5"},
    {"a motor's commands and a half", {.column = FC_M4, .scale = 1.55}, "column motor.m4: the mean is 1.5"},
    {"a rotor at half its speed",
     {.column = FC_W1, .scale = 0.5},
     "column rpm.m1: the mean is 0.5 of the other motors' in flight; allowed: 0.65 to 1.5"},
    {"gyro out of range", {.column = FC_GX, .offset = 5000.0, .from_s = 5.0}, "f.csv:502: column gyro.x: 8"},
};

TEST(gap_refuses_units_signs_and_signals_that_contradict_with_column_and_factor) {
  for (unsigned i = 0; i < sizeof contradicting / sizeof *contradicting; i++) {
    ROW("%s", contradicting[i].what);
    gap_flight_t f;
    why_t why = {""};
    CHECK_STATUS(BAD_INPUT, read_made(&f, &contradicting[i].made, &why));
    CHECK(f.n == 0 && f.t_s == NULL);
    if (!strstr(why.text, contradicting[i].want)) CHECK_TEXT(scratch_short(why.text), contradicting[i].want);
  }
}

// The log by these columns; the refusal ends with `want` (empty: it is read).
static void check_read(const columns_t *columns, const model_t *vehicle, const char *want) {
  gap_flight_t f;
  why_t why = {""};
  const char *const path = flight_csv_file(&(flight_csv_t){.dt_ms = 10.0}, "f.csv");
  CHECK_STATUS(want[0] ? BAD_INPUT : DONE, gap_read(&f, path, columns, vehicle, &why));
  const char *const end = strstr(why.text, want);
  if (!want[0] || !end || strcmp(end, want) != 0) CHECK_TEXT(scratch_short(why.text), want);
  gap_flight_free(&f);
}

// What a columns file says wrongly: the factor is what is read over what the column has.
static const struct {
  const char *what;
  signal_id_t signal;
  const char *column, *unit;
  double factor;
  const char *want; // empty: read
} moving[] = {
    {"a height in m, said to be cm", SIG_Z, "stateEstimate.z", "cm", 0.01,
     "column stateEstimate.vz: the position moves 0.01 times as far along axis z as the velocity says over "
     "the whole flight; allowed: 0.33 to 3; the unit cm/s would fit (factor 0.01), or of column "
     "stateEstimate.z the unit m would fit (factor 100)"},
    {"a range in cm, said to be mm", SIG_RANGE, "range.up", "mm", 1e-4,
     "column range.up: the range moves 0.0999 times as far as the place along axis z over the whole "
     "flight; "
     "allowed: 0.33 to 3; the unit cm would fit (factor 10)"},
    {"a range in mm, said to be cm", SIG_RANGE, "range.up", "cm", 0.01, "the unit mm would fit (factor 0.1)"},
    {"a range downwards in cm, said to be mm", SIG_RANGE_DOWN, "stateEstimate.z", "mm", 0.1,
     "the range moves 0.1 times as far as the place along axis z over the whole flight; allowed: 0.33 to "
     "3; the unit cm would fit (factor 10)"},
    {"a range over things", SIG_RANGE_DOWN, "stateEstimate.x", "mm", 0.1, ""},
    {"a range upwards said to look downwards", SIG_RANGE_DOWN, "range.up", "mm", 1e-4, ""},
    {"a set point in mm, said to be m", SIG_SET_Z, "stateEstimate.z", "m", 1000.0,
     "the set point moves 1e+03 times as far as the place along axis z over the whole flight; allowed: "
     "0.33 to 3; the unit mm would fit (factor 0.001)"},
    {"a set point in m, said to be cm", SIG_SET_X, "stateEstimate.x", "cm", 0.01,
     "the set point moves 0.01 times as far as the place along axis x over the whole flight; allowed: 0.33 "
     "to 3; the unit m would fit (factor 100)"},
    {"a set point that is not followed", SIG_SET_Z, "stateEstimate.x", "m", 1000.0, ""},
    {"a set point in no unit", SIG_SET_Z, "stateEstimate.z", "m", 5.0, ""},
};

TEST(gap_refuses_what_moves_as_far_as_the_place_only_in_another_unit) {
  for (unsigned i = 0; i < sizeof moving / sizeof *moving; i++) {
    ROW("%s", moving[i].what);
    columns_t columns = flight_csv_columns();
    column_t *const to = &columns.of[moving[i].signal];
    to->factor = moving[i].factor;
    snprintf(to->column, sizeof to->column, "%s", moving[i].column);
    snprintf(to->unit, sizeof to->unit, "%s", moving[i].unit);
    model_t vehicle;
    why_t why;
    CHECK_OK(model_builtin("cf21_legacy", &vehicle, &why));
    check_read(&columns, &vehicle, moving[i].want);
  }
}

// Thrust goes with the square of a speed.
TEST(gap_says_which_unit_of_commanded_speeds_fits) {
  static const struct {
    const char *what;
    double scale;     // of the column, which has rpm
    const char *want; // empty: read
  } row[] = {
      {"rpm", 1.0, ""},
      {"rad/s, said to be rpm", 0.1047198,
       "give 0.011 times what its acceleration takes; allowed: 0.33 to 3 (is it the right vehicle and "
       "unit?); "
       "the unit rad/s would fit (factor 9.549)"},
      {"a third of the speed, in no unit", 0.33, "(is it the right vehicle and unit?)"},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    columns_t columns = flight_csv_columns();
    model_t vehicle;
    why_t why;
    CHECK_OK(model_builtin("cf21_legacy", &vehicle, &why));
    vehicle.map = (thrust_map_t){THRUST_MAP_SPEED, {0.0, 0.0, vehicle.frame.kf_Ns2}};
    columns.motors = MOTORS_RADPS;
    for (int k = 0; k < 4; k++) {
      column_t *const to = &columns.of[SIG_M1 + k];
      *to = columns.of[SIG_W1 + k];
      columns.of[SIG_W1 + k].column[0] = 0;
      to->factor *= row[i].scale;
    }
    check_read(&columns, &vehicle, row[i].want);
  }
}

// What is right within a factor of three is read; more than 2 % is told.
TEST(gap_tells_of_a_scale_that_attitude_or_velocity_contradict) {
  static const struct {
    const char *what;
    flight_csv_t made;
    const char *want; // null: nothing is told
  } row[] = {
      {"all as it is", {.column = FC_GX, .more = 2, .scale = 1.0}, NULL},
      {"a gyro that reads 5 % more", {.column = FC_GX, .more = 2, .scale = 1.05}, "the attitude turns 0.95"},
      {"a gyro that reads 5 % less", {.column = FC_GX, .more = 2, .scale = 0.95}, "the attitude turns 1.0"},
      {"1 %, as a right form leaves", {.column = FC_GX, .more = 2, .scale = 1.01}, NULL},
      {"an accelerometer", {.column = FC_AX, .more = 2, .scale = 1.05}, "the velocity changes 0.9"}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    gap_flight_t f;
    why_t why = {""};
    bool told = false, any = false;
    ROW("%s", row[i].what);
    if (!CHECK_OK(read_made(&f, &row[i].made, &why))) continue;
    for (int k = 0; k < f.n_note; k++) {
      any = any || strstr(f.note[k], "another scale");
      told = told || (row[i].want && strstr(f.note[k], row[i].want));
    }
    CHECK(any == (row[i].want != NULL) && told == any);
    gap_flight_free(&f);
  }
}

// A hover that turns about the vertical, twice one way and back: at a steady place, or on a circle of 0.3 m
// about which it goes once in 3 s, with an accelerometer that errs by a steady 0.5 m/s2 forwards.
// Spoilt: the accelerometer's axes; the velocity, but for noise; nothing, but it turns evenly and slowly.
// Or it turns to and fro more slowly than its attitude errs.
typedef enum { AS_IT_IS, EXCHANGED, DEAD, EVENLY, SLOWLY } spoilt_t;
static void turn_at(double t_s, spoilt_t spoilt, double noise, double *yaw, double *rate) {
  *yaw = 4.0 * 3.14159265 * sin(0.3 * t_s) + 0.001 * sin(50.0 * t_s);
  *rate = 1.2 * 3.14159265 * cos(0.3 * t_s) + 0.05 * cos(50.0 * t_s);
  if (spoilt == EVENLY) {
    *yaw = 0.12 * (t_s - 10.0 * (1.0 - exp(-0.1 * t_s))) + 0.001 * sin(50.0 * t_s);
    *rate = 0.12 * (1.0 - exp(-0.1 * t_s)) + noise;
  }
  if (spoilt == SLOWLY) {
    *yaw = 0.08 * sin(0.3 * t_s) + 0.0048 * sin(41.0 * t_s * t_s);
    *rate = 0.024 * cos(0.3 * t_s) + 0.003 * sin(53.0 * t_s * t_s);
  }
}

static done_t read_yaw(double circle_m, spoilt_t spoilt, why_t *why) {
  const columns_t columns = flight_csv_columns();
  model_t vehicle;
  gap_flight_t f = {.n = 0};
  const char *const path = scratch_path("yaw.csv");
  TRY(model_builtin("cf21_legacy", &vehicle, why));
  FILE *const out = fopen(path, "w");
  if (!out) return FAILED;
  for (int k = 0; k <= FC_VBAT; k++) fprintf(out, "%s%s", k ? "," : "", flight_csv_name[k]);
  for (int i = 0; i < 5000; i++) {
    const double t_s = 0.01 * i, w = 2.0 * 3.14159265 / 3.0, at = w * t_s,
                 noise = 0.002 * sin(37.0 * t_s * t_s);
    double yaw, rate;
    turn_at(t_s, spoilt, noise, &yaw, &rate);
    const double x = circle_m * cos(at), y = circle_m * sin(at), a_x = -w * w * x, a_y = -w * w * y;
    double v[FC_COLUMNS];
    flight_csv_values(t_s, v);
    v[FC_X] = x + noise, v[FC_Y] = y - noise, v[FC_Z] = 1.0 + noise;
    v[FC_VX] = -w * y + noise, v[FC_VY] = w * x - noise, v[FC_VZ] = 2.0 * noise;
    v[FC_AX] = (cos(yaw) * a_x + sin(yaw) * a_y + 0.5) / 9.81 - noise;
    v[FC_AY] = (cos(yaw) * a_y - sin(yaw) * a_x) / 9.81 + noise;
    v[FC_AZ] = 1.0 + noise;
    v[FC_QW] = cos(0.5 * yaw), v[FC_QX] = 0.0, v[FC_QY] = 0.0, v[FC_QZ] = sin(0.5 * yaw);
    v[FC_GX] = 57.3 * noise, v[FC_GY] = -57.3 * noise, v[FC_GZ] = rate * 180.0 / 3.14159265;
    for (int k = 0; k < 3 && spoilt == DEAD; k++) v[FC_VX + k] = (k + 1) * noise;
    if (spoilt == EXCHANGED) {
      const double keep = v[FC_AX];
      v[FC_AX] = v[FC_AY], v[FC_AY] = keep;
    }
    for (int k = 0; k <= FC_VBAT; k++) fprintf(out, "%s%.9g", k ? "," : "\n", v[k]);
  }
  fclose(out);
  const done_t status = gap_read(&f, path, &columns, &vehicle, why);
  gap_flight_free(&f);
  return status;
}

TEST(gap_refuses_no_hover_for_an_accelerometer_that_errs_while_it_turns) {
  why_t why = {""};
  CHECK_OK(read_yaw(0.0, AS_IT_IS, &why));
  CHECK_OK(read_yaw(0.3, AS_IT_IS, &why));
  CHECK_OK(read_yaw(0.3, EVENLY, &why)); // the attitude was told to turn 4.93 times as far as the gyro says
  CHECK_OK(read_yaw(0.3, SLOWLY, &why)); // it was told to turn 7.81 times as far
  for (spoilt_t spoilt = EXCHANGED; spoilt <= DEAD; spoilt++) {
    ROW("%s", spoilt == DEAD ? "a velocity that is noise" : "axes that are exchanged");
    CHECK_STATUS(BAD_INPUT, read_yaw(0.3, spoilt, &why));
    CHECK(strstr(why.text, "the velocity changes") != NULL);
  }
}
