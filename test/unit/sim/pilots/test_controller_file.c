// test_controller_file.c - the table [controller] of vehicle files: what is read, and what is refused with
// which line.
#include "pilots/controller_file.h"
#include "rig/programs.h"
#include "rig/scratch.h"
#include "rig/test.h"
#include "vehicle/model_file.h"

#include <stdio.h>
#include <string.h>

// As the programs do: the vehicle, and who flew it.
static done_t read_file(const char *path, flown_by_t *by, why_t *why) {
  model_t m;
  TRY(model_read(path, &m, why));
  return controller_read(path, NULL, &m, by, why);
}

#define VEHICLE                                                                                              \
  "name = \"v\"\nmass_kg = 0.03\nrotor_radius_m = 0.02\nmotor_tau_s = 0.06\nthrust_min_N = 0\nthrust_max_N " \
  "= 0.6\n[controller]\n"

TEST(controller_of_a_vehicle_file_has_the_firmware_s_gains_where_it_says_no_other) {
  const stock_pid_param_t shipped = stock_pid_default();
  flown_by_t by;
  why_t why = {""};
  CHECK_OK(read_file(scratch_file("v.toml",
                                  VEHICLE "kind = \"stock-pid\"\nposCtlPid.zKp = 3\nposCtlPid.xVelMax = 2\n"
                                          "velCtlPid.vyKi = 4\npid_attitude.yaw_kd = 0.5\n"
                                          "pid_rate.pitch_kp = 111\nposCtlPid.thrustBase = 30000\n",
                                  -1),
                     &by, &why));
  CHECK_TEXT(why.text, "");
  const stock_pid_param_t *const p = &by.pid;
  CHECK(by.kind == FLOWN_BY_STOCK_PID);
  CHECK_NEAR(p->position.pos[2].kp, 3.0, 0.0);
  CHECK_NEAR(p->position.pos[0].output_max, 2.2, 1e-12);
  CHECK_NEAR(p->position.vel[1].ki, 4.0, 0.0);
  CHECK_NEAR(p->position.thrust_base, 30000.0, 0.0);
  CHECK_NEAR(p->attitude[2].kd, 0.5, 0.0);
  CHECK_NEAR(p->rate[1].kp, 111.0, 0.0);
  CHECK_NEAR(p->rate[0].kp, shipped.rate[0].kp, 0.0);
  CHECK_NEAR(p->position.pos[0].kp, shipped.position.pos[0].kp, 0.0);
  CHECK_NEAR(p->power.thrust_max_N, 0.15, 1e-12);
}

TEST(controller_of_a_vehicle_file_may_be_the_flight_code) {
  flown_by_t by;
  why_t why = {""};
  CHECK_OK(read_file(
      scratch_file("v.toml", VEHICLE "kind = \"indi\"\nindiPos.cutoff = 9\nceil.mode = 0\n", -1), &by, &why));
  CHECK(by.kind == FLOWN_BY_INDI && by.n_set == 2);
  CHECK_TEXT(by.set[0].name, "indiPos.cutoff");
  CHECK_NEAR(by.set[0].value, 9.0, 0.0);
}

TEST(controller_of_a_vehicle_file_may_be_known_by_its_rate_alone) {
  flown_by_t by;
  why_t why = {""};
  CHECK_OK(read_file(scratch_file("v.toml", VEHICLE "kind = \"other\"\nrate_Hz = 100\n", -1), &by, &why));
  CHECK(by.kind == FLOWN_BY_OTHER);
  CHECK_NEAR(by.rate_Hz, 100.0, 0.0);
}

static const struct {
  const char *what, *text, *want;
} REFUSED[] = {
    {"no kind", "", "v.toml:7: kind: missing; allowed: a text in quotes"},
    {"kind", "kind = \"lqr\"\n", "v.toml:8: kind: unknown kind `lqr`; allowed: stock-pid, indi, other"},
    {"group", "kind = \"stock-pid\"\nposCtl.xKp = 1\n",
     "v.toml:9: posCtl: unknown key; allowed: kind, full_scale_N, posCtlPid, velCtlPid, pid_attitude, "
     "pid_rate"},
    {"gain", "kind = \"stock-pid\"\npid_rate.roll_kff = 1\n",
     "v.toml:9: roll_kff: unknown key (did you mean roll_kp?); allowed: roll_kp, roll_ki, roll_kd, "
     "pitch_kp, pitch_ki, pitch_kd, "
     "yaw_kp, yaw_ki, yaw_kd"},
    {"below 0", "kind = \"stock-pid\"\npid_rate.roll_kp = -1\n",
     "v.toml:9: roll_kp: -1 is out of range; allowed: 0 to 100000"},
    {"nan", "kind = \"stock-pid\"\nvelCtlPid.vzKi = nan\n",
     "v.toml:9: vzKi: nan is out of range; allowed: 0 to 100000"},
    {"no speed", "kind = \"stock-pid\"\nposCtlPid.xVelMax = 0\n",
     "v.toml:9: xVelMax: 0; allowed: more than 0, to 100"},
    {"a gain is a table", "kind = \"stock-pid\"\nposCtlPid = 1\n",
     "v.toml:9: posCtlPid: wrong type; allowed: a table"},
    {"parameter", "kind = \"indi\"\nindiPos.kq = 1\n",
     "v.toml:9: kq: unknown parameter (did you mean indiPos.kp?); allowed: those of fly --params"},
    {"range", "kind = \"indi\"\nindiPos.mass = 99\n",
     "v.toml:9: mass: 99 is out of range; allowed: 0.01 to 2"},
    {"fraction", "kind = \"indi\"\nceil.mode = 0.5\n", "v.toml:9: mode: 0.5; allowed: a whole number"},
    {"no rate", "kind = \"other\"\n",
     "v.toml:7: rate_Hz: missing; allowed: how often the controller commands the motors, 10 to 10000 Hz"},
    {"rate", "kind = \"other\"\nrate_Hz = 1\n", "v.toml:9: rate_Hz: 1 is out of range; allowed: 10 to 10000"},
    {"gains of another", "kind = \"other\"\nrate_Hz = 100\npid_rate.roll_kp = 1\n",
     "v.toml:10: pid_rate: unknown key; allowed: kind, rate_Hz"},
    {"together", "kind = \"indi\"\nceil.floor = 0.2\n",
     "v.toml:8: kind: parameters that contradict each other; allowed: what fly --set takes together"},
};

TEST(controller_of_a_vehicle_file_is_refused_with_line_and_key) {
  for (unsigned i = 0; i < sizeof REFUSED / sizeof *REFUSED; i++) {
    ROW("%s", REFUSED[i].what);
    char text[600];
    flown_by_t by;
    why_t why = {""};
    snprintf(text, sizeof text, "%s%s", VEHICLE, REFUSED[i].text);
    CHECK_STATUS(BAD_INPUT, read_file(scratch_file("v.toml", text, -1), &by, &why));
    CHECK_TEXT(scratch_short(why.text), REFUSED[i].want);
    CHECK(by.kind == FLOWN_BY_UNKNOWN);
  }
}

TEST(programs_take_a_vehicle_with_a_controller_and_refuse_a_wrong_one_with_2) {
  char text[2000];
  CHECK(program_run("cp sim/vehicle/vehicles/cf21_legacy.toml $S/c.toml && printf '[controller]\\nkind = "
                    "\"stock-pid\"\\n'"
                    " >>$S/c.toml && fly hand-held --vehicle $S/c.toml",
                    STREAM_ERROR, text, sizeof text) == 0);
  CHECK(program_run("echo 'velCtlPid.vxKp = -2' >>$S/c.toml; gap --vehicle $S/c.toml none.csv", STREAM_ERROR,
                    text, sizeof text) == 2);
  CHECK(strstr(text, "vxKp: -2 is out of range; allowed: 0 to 100000") != NULL);
}
