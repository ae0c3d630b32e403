// test_columns.c - columns files, and the rows of a log in SI and our frames.
#include "logs/columns.h"
#include "logs/log_rows.h"
#include "rig/scratch.h"
#include "rig/test.h"

#include <stdio.h>
#include <string.h>

#define PI 3.14159265358979323846

static const model_t CUBIC = {
    .name = "cubic", .thrust_max_N = 0.5, .map = {.kind = THRUST_MAP_VOLT_CUBIC, .c = {0.0, 0.1}}};
static const model_t NEWTON = {.name = "newton", .thrust_max_N = 0.5};

// The first row of a log.
static done_t first_row(const char *csv, const columns_t *c, const model_t *vehicle, signals_t need,
                        log_row_t *row, why_t *why) {
  log_rows_t rows;
  bool more;
  TRY(log_rows_open(&rows, scratch_file("log.csv", csv, -1), c, vehicle, LOG_STRICT, need, why));
  done_t status = log_rows_next(&rows, row, &more, why);
  if (status == DONE) status = log_rows_check_cells(&rows, 1, why);
  log_rows_close(&rows);
  return status;
}

TEST(columns_of_a_crazyflie_are_built_in) {
  const columns_t c = columns_crazyflie();
  const char *csv =
      "timestamp,acc.x,acc.y,acc.z,stateEstimate.z,stateEstimate.roll,stateEstimate.pitch,range.up,"
      "motor.m1,motor.m2,motor.m3,motor.m4,pm.vbat\n2000,0.1,0.2,1,0.4,0,-90,512,65535,0,0,32767.5,4\n";
  log_row_t row;
  why_t why = {""};
  CHECK_OK(first_row(csv, &c, &CUBIC, SIGNAL_BIT(SIG_THRUST), &row, &why));
  CHECK_TEXT(why.text, "");
  CHECK_NEAR(row.v[SIG_TIME], 2.0, 1e-12);
  CHECK_NEAR(row.v[SIG_AX], 0.981, 1e-12);
  CHECK_NEAR(row.v[SIG_RANGE], 0.512, 1e-12);
  CHECK_NEAR(row.v[SIG_THRUST], 0.1 * 4.0 * 1.5, 1e-12);
  CHECK(row.at_limit);
  // The firmware's pitch is nose up: -90 is nose down, a right-handed turn about y.
  CHECK_NEAR(row.v[SIG_QW], sqrt(0.5), 1e-12);
  CHECK_NEAR(row.v[SIG_QY], sqrt(0.5), 1e-12);
}

#define EULER                                                                                                \
  "[columns]\ntime = {column = \"t\", unit = \"us\"}\nax = {column = \"ax\", unit = \"m/s2\"}\n"             \
  "ay = {column = \"ay\", unit = \"m/s2\"}\naz = {column = \"az\", unit = \"m/s2\"}\n"                       \
  "roll = {column = \"r\", unit = \"deg\"}\npitch = {column = \"p\", unit = \"rad\"}\n"                      \
  "yaw = {column = \"y\", unit = \"deg\"}\nthrust = {column = \"T\", unit = \"mN\", scale = 2, offset = "    \
  "0.1}\n"

TEST(columns_bring_every_frame_to_ours) {
  // Standing still, rolled and pitched: the specific force is what holds against gravity.
  const double g = 9.81, r = 10.0 * PI / 180.0, p = 0.3;
  const double want[3] = {-g * sin(p), g * cos(p) * sin(r), g * cos(p) * cos(r)};
  static const struct {
    const char *frame, *acc;
  } world[] = {{"world", "0,0,0"}, {"world_with_gravity", "0,0,9.81"}};
  for (unsigned i = 0; i < sizeof world / sizeof *world; i++) {
    ROW("%s", world[i].frame);
    char toml[600], csv[120];
    snprintf(toml, sizeof toml, "acceleration = \"%s\"\n" EULER, world[i].frame);
    snprintf(csv, sizeof csv, "t,ax,ay,az,r,p,y,T\n1500000,%s,10,0.3,77,100\n", world[i].acc);
    columns_t c;
    log_row_t row;
    why_t why = {""};
    CHECK_OK(columns_read(scratch_file("c.toml", toml, -1), &c, &why));
    CHECK_OK(first_row(csv, &c, &NEWTON, 0, &row, &why));
    CHECK_TEXT(why.text, "");
    CHECK_NEAR(row.v[SIG_TIME], 1.5, 1e-12);
    CHECK_NEAR(row.v[SIG_THRUST], 0.3, 1e-12);
    for (int k = 0; k < 3; k++) CHECK_NEAR(row.v[SIG_AX + k], want[k], 1e-12);
  }
}

TEST(columns_files_without_columns_are_about_the_crazyflie_s_own) {
  columns_t c, own = columns_crazyflie();
  why_t why = {""};
  CHECK_OK(columns_read(scratch_file("c.toml", "rest_height_m = 0.05\nrows = \"means\"\n", -1), &c, &why));
  CHECK(c.rest_height_m == 0.05 && c.rows_are_means && c.crazyflie && c.acc == own.acc);
  for (int i = 0; i < SIG_COUNT; i++) {
    CHECK_TEXT(c.of[i].column, own.of[i].column);
    CHECK(c.of[i].late_s == own.of[i].late_s && c.of[i].optional == own.of[i].optional);
  }
}

#define TIME "[columns]\ntime = {column = \"t\", unit = \"s\"}\n"

static const struct {
  const char *what, *text, *want;
} refused[] = {
    {"empty", "", "c.toml:1: columns: missing; allowed: a table"},
    {"no time", "[columns]\n", "c.toml:1: time: missing; allowed: a table"},
    {"key", "x = 1\n" TIME, "c.toml:1: x: unknown key; allowed: rest_height_m, acceleration, rows, columns"},
    {"signal", TIME "height = {column = \"z\", unit = \"m\"}\n",
     "c.toml:3: height: unknown key; allowed: time, x, y, z, vx, vy, vz, ax, ay, az, qw, qx, qy, qz, roll, "
     "pitch, yaw, "
     "gx, gy, gz, m1, m2, m3, m4, thrust, vbat, range, range_down, tx, ty, tz, w1, w2, w3, w4, set_x, "
     "set_y, set_z, "
     "set_vx, set_vy, set_vz, set_yaw"},
    {"unit", TIME "z = {column = \"z\", unit = \"foot\"}\n",
     "c.toml:3: unit: unknown unit `foot` of z; allowed: m, cm, mm"},
    {"motor unit", TIME "m1 = {column = \"z\", unit = \"rps\"}\n",
     "c.toml:3: unit: unknown unit `rps` of m1; allowed: pwm, percent, share, rad/s, rpm, N, mN, gram"},
    {"no unit", TIME "z = {column = \"z\"}\n", "c.toml:3: unit: missing; allowed: a text in quotes"},
    {"no voltage", TIME "vbat = {value = 0.2, unit = \"V\"}\n",
     "c.toml:3: value: 0.2 is out of range; allowed: 1 to 60"},
    {"a voltage twice", TIME "vbat = {value = 4, unit = \"V\", column = \"v\"}\n",
     "c.toml:3: column: unknown key; allowed: value, unit"},
    {"a value that is none", TIME "z = {value = 4, unit = \"m\"}\n",
     "c.toml:3: value: unknown key; allowed: column, unit, scale, offset, late_ms, optional"},
    {"scale", TIME "z = {column = \"z\", unit = \"m\", scale = 0}\n",
     "c.toml:3: scale: 0; allowed: any other number"},
    {"late", TIME "z = {column = \"z\", unit = \"m\", late_ms = 101}\n",
     "c.toml:3: late_ms: 101 is out of range; allowed: -100 to 100"},
    {"early", TIME "z = {column = \"z\", unit = \"m\", late_ms = -100.5}\n",
     "c.toml:3: late_ms: -100.5 is out of range; allowed: -100 to 100"},
    {"rows", "rows = \"mean\"\n" TIME, "c.toml:1: rows: unknown word `mean`; allowed: instants, means"},
    {"no frame", TIME "az = {column = \"z\", unit = \"g\"}\n",
     "c.toml:1: acceleration: missing; allowed: a text in quotes"},
    {"frame", "acceleration = \"x\"\n" TIME "az = {column = \"z\", unit = \"g\"}\n",
     "c.toml:1: acceleration: unknown frame `x`; allowed: body, world, world_with_gravity"},
    {"three motors",
     TIME "m1 = {column = \"a\", unit = \"N\"}\nm2 = {column = \"b\", unit = \"N\"}\n"
          "m4 = {column = \"d\", unit = \"N\"}\n",
     "c.toml:3: m1: without m3; allowed: m1 to m4, or none of them"},
    {"no first motor", TIME "m2 = {column = \"b\", unit = \"N\"}\n",
     "c.toml:3: m2: without m1; allowed: m1 to m4, or none of them"},
    {"one rotor's speed", TIME "w4 = {column = \"d\", unit = \"rpm\"}\n",
     "c.toml:3: w4: without w1; allowed: w1 to w4, or none of them"},
    {"both", TIME "m1 = {column = \"a\", unit = \"N\"}\nm2 = {column = \"b\", unit = \"pwm\"}\n",
     "c.toml:4: m2: a command in pwm beside one in N; allowed: all of one kind"},
};

TEST(columns_files_are_refused_with_line_and_key) {
  for (unsigned i = 0; i < sizeof refused / sizeof *refused; i++) {
    ROW("%s", refused[i].what);
    columns_t c = {.rest_height_m = 7.0};
    why_t why = {""};
    CHECK_STATUS(BAD_INPUT, columns_read(scratch_file("c.toml", refused[i].text, -1), &c, &why));
    CHECK_TEXT(scratch_short(why.text), refused[i].want);
    CHECK_NEAR(c.rest_height_m, 7.0, 0.0);
  }
}

#define ALL_BAD ", the first of 1 such cells in 1 rows; allowed: 5 %"

TEST(rows_are_refused_with_column_and_factor) {
  const columns_t c = columns_crazyflie();
  static const struct {
    const char *what, *csv, *want;
  } row[] = {
      {"no time", "time,acc.z\n1,2\n",
       "log.csv:1: column timestamp: missing; it is the signal `time` of this kind of log"},
      {"no height", "timestamp\n1\n",
       "log.csv:1: column stateEstimate.z: missing; needed: the signal `z`, named by --columns FILE"},
      {"height in mm", "timestamp,stateEstimate.z\n1,412\n",
       "log.csv:2: column stateEstimate.z: 412 m is not plausible; allowed: -30 to 100 m; the unit cm would "
       "fit (factor 0.01), or mm would fit (factor 0.001)" ALL_BAD},
      {"volts in mV", "timestamp,stateEstimate.z,pm.vbat\n1,0.4,3700\n",
       "log.csv:2: column pm.vbat: 3700 V is not plausible; allowed: 1 to 60 V; the unit mV would fit "
       "(factor 0.001)" ALL_BAD},
      {"acceleration in m/s2", "timestamp,stateEstimate.z,acc.z\n1,0.4,30\n",
       "log.csv:2: column acc.z: 294.3 m/s2 is not plausible; allowed: -240 to 240 m/s2; the unit m/s2 would "
       "fit (factor 0.1019), or mg would fit (factor 0.001)" ALL_BAD},
      {"quaternion",
       "timestamp,stateEstimate.z,stateEstimate.qw,stateEstimate.qx,stateEstimate.qy,stateEstimate.qz\n"
       "1,0.4,0.5,0,0,0\n",
       "log.csv:2: column stateEstimate.qw: the quaternion's length is 0.5; allowed: 0.9 to 1.1" ALL_BAD},
      {"no map", "timestamp,stateEstimate.z,motor.m1,motor.m2,motor.m3,motor.m4\n1,0.4,1,1,1,1\n",
       "log.csv:1: column motor.m1: a motor command, but vehicle newton has no [thrust_map]; choose one that "
       "has "
       "(--vehicle)"},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    log_row_t got;
    why_t why = {""};
    CHECK_STATUS(BAD_INPUT, first_row(row[i].csv, &c, &NEWTON, SIGNAL_BIT(SIG_Z), &got, &why));
    CHECK_TEXT(scratch_short(why.text), row[i].want);
  }
}

TEST(rows_without_voltage_are_refused_where_the_map_needs_it) {
  const columns_t c = columns_crazyflie();
  const char *csv = "timestamp,motor.m1,motor.m2,motor.m3,motor.m4\n1,1,1,1,1\n";
  log_row_t row;
  why_t why;
  CHECK_STATUS(BAD_INPUT, first_row(csv, &c, &CUBIC, 0, &row, &why));
  CHECK_TEXT(scratch_short(why.text),
             "log.csv:1: column pm.vbat: missing; the motor commands are there, and the thrust map needs the "
             "battery's voltage beside them");
}

TEST(columns_say_what_a_row_is) {
  static const struct {
    const char *text;
    bool means;
  } row[] = {{TIME, false}, {"rows = \"instants\"\n" TIME, false}, {"rows = \"means\"\n" TIME, true}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    columns_t c;
    why_t why = {""};
    CHECK_OK(columns_read(scratch_file("c.toml", row[i].text, -1), &c, &why));
    CHECK(c.rows_are_means == row[i].means);
  }
}

#define MOTORS4(unit)                                                                                        \
  "m1 = {column = \"a\", unit = \"" unit "\"}\nm2 = {column = \"b\", unit = \"" unit                         \
  "\"}\nm3 = {column = \"c\", unit = \"" unit "\"}\nm4 = {column = \"d\", unit = \"" unit "\"}\n"
#define MIXED(force, torque)                                                                                 \
  "thrust = {column = \"a\", unit = \"" force "\"}\ntx = {column = \"b\", unit = \"" torque                  \
  "\"}\nty = {column = \"c\", unit = \"" torque "\"}\ntz = {column = \"d\", unit = \"" torque "\"}\n"

// Arms of 0.1 m, torque over thrust 0.01 m; rotors at front right, back right, back left, front left.
#define FRAME                                                                                                \
  .frame = {.rotor_x_m = {0.1, -0.1, -0.1, 0.1},                                                             \
            .rotor_y_m = {-0.1, -0.1, 0.1, 0.1},                                                             \
            .rotor_spin = {1.0, -1.0, 1.0, -1.0},                                                            \
            .torque_ratio_m = 0.01}

static const model_t PWM = {
    .name = "pwm", .thrust_max_N = 4.0, FRAME, .map = {.kind = THRUST_MAP_PWM_CUBIC, .c = {0.0, 1.0}}};
static const model_t SPEED = {
    .name = "speed", .thrust_max_N = 4.0, FRAME, .map = {.kind = THRUST_MAP_SPEED, .c = {0.0, 0.0, 1e-6}}};
static const struct {
  const char *what, *columns;
  double cell[4];
  const model_t *vehicle;
  double want_N[4];
  bool at_limit;
} motor_row[] = {
    {"pwm", MOTORS4("pwm"), {6553.5, 13107.0, 19660.5, 26214.0}, &PWM, {0.1, 0.2, 0.3, 0.4}, false},
    {"percent", MOTORS4("percent"), {10.0, 20.0, 30.0, 40.0}, &PWM, {0.1, 0.2, 0.3, 0.4}, false},
    {"full percent", MOTORS4("percent"), {10.0, 20.0, 30.0, 100.0}, &PWM, {0.1, 0.2, 0.3, 1.0}, true},
    {"share", MOTORS4("share"), {0.1, 0.2, 0.3, 0.4}, &PWM, {0.1, 0.2, 0.3, 0.4}, false},
    {"rad/s", MOTORS4("rad/s"), {100.0, 200.0, 300.0, 400.0}, &SPEED, {0.01, 0.04, 0.09, 0.16}, false},
    {"rpm", MOTORS4("rpm"), {954.929659, 1909.859317, 0.0, 0.0}, &SPEED, {0.01, 0.04, 0.0, 0.0}, false},
    {"mN", MOTORS4("mN"), {100.0, 200.0, 300.0, 400.0}, &NEWTON, {0.1, 0.2, 0.3, 0.4}, true},
    // Thrust 1; right to left 0.1 (0.3 + 0.4 - 0.1 - 0.2), back to front 0.1 (0.2 + 0.3 - 0.1 - 0.4),
    // drag 0.01 (0.2 + 0.4 - 0.1 - 0.3).
    {"thrust and torques", MIXED("N", "Nm"), {1.0, 0.04, 0.0, 0.002}, &PWM, {0.1, 0.2, 0.3, 0.4}, false},
    {"mixer's pwm",
     MIXED("pwm", "pwm"),
     {32767.5, 13107.0, 6553.5, 655.35},
     &PWM,
     {0.46, 0.34, 0.56, 0.64},
     false},
    {"mixer at its limit",
     MIXED("pwm", "pwm"),
     {60000.0, 20000.0, 0.0, 0.0},
     &PWM,
     {50000.0 / 65535.0, 50000.0 / 65535.0, 1.0, 1.0},
     true},
};

TEST(motor_commands_of_every_kind_become_newton_of_each_motor) {
  for (unsigned i = 0; i < sizeof motor_row / sizeof *motor_row; i++) {
    ROW("%s", motor_row[i].what);
    char toml[700], csv[200];
    const double *const x = motor_row[i].cell;
    snprintf(toml, sizeof toml, TIME "%s", motor_row[i].columns);
    snprintf(csv, sizeof csv, "t,a,b,c,d\n0,%.9g,%.9g,%.9g,%.9g\n", x[0], x[1], x[2], x[3]);
    columns_t c;
    log_row_t got;
    why_t why = {""};
    CHECK_OK(columns_read(scratch_file("c.toml", toml, -1), &c, &why));
    CHECK_OK(first_row(csv, &c, motor_row[i].vehicle, SIGNAL_BIT(SIG_THRUST), &got, &why));
    CHECK_TEXT(why.text, "");
    double sum_N = 0.0;
    for (int k = 0; k < 4; k++) {
      CHECK_NEAR(got.v[SIG_F1 + k], motor_row[i].want_N[k], 1e-8);
      sum_N += motor_row[i].want_N[k];
    }
    CHECK_NEAR(got.v[SIG_THRUST], sum_N, 1e-8);
    CHECK(got.at_limit == motor_row[i].at_limit);
  }
}

TEST(motor_commands_that_the_vehicle_cannot_tell_in_newton_are_refused) {
  columns_t c;
  log_row_t row;
  why_t why = {""};
  CHECK_OK(columns_read(scratch_file("c.toml", TIME MOTORS4("rpm"), -1), &c, &why));
  CHECK_STATUS(BAD_INPUT, first_row("t,a,b,c,d\n0,1,1,1,1\n", &c, &CUBIC, 0, &row, &why));
  CHECK_TEXT(scratch_short(why.text),
             "log.csv:1: column a: a command in rad/s, but the [thrust_map] of vehicle cubic takes pwm");
}
