// test_gap_advice.c - what the report advises: to use, to add, to fly.
#include "gap/8_report/report.h"
#include "rig/test.h"

#include <stdlib.h>
#include <string.h>

// Keys that a vehicle file lacks, bit by bit as frame_lacks() counts them.
TEST(gap_advises_to_add_what_was_taken_from_a_crazyflie) {
  static const struct {
    unsigned lacks;
    const char *line;
  } cases[] = {
      {0, "add: nothing more to the vehicle file"},
      {1, "add: what the vehicle file does not say and is a Crazyflie's: body.inertia_kgm2"},
      {0x7e0, "add: what the vehicle file does not say and is a Crazyflie's: [rotors]"},
  };
  study_t *const study = calloc(1, sizeof *study);
  report_t *const r = calloc(1, sizeof *r);
  r->study = study;
  study->order.vehicle = "v.toml";
  for (unsigned i = 0; i < sizeof cases / sizeof *cases; i++) {
    ROW("%#x", cases[i].lacks);
    study->vehicle.frame_lacks = cases[i].lacks;
    memset(&r->to_do, 0, sizeof r->to_do);
    report_advise(r);
    CHECK(r->to_do.n == 3);
    CHECK_TEXT(r->to_do.line[1], cases[i].line);
  }
  free(study);
  free(r);
}

TEST(gap_advises_to_mind_what_has_no_name) {
  static const char *const alone = "use: the vehicle file as it is; these flights add nothing to it";
  static const char *const mind =
      "use: the vehicle file as it is, and mind that it leaves more than noise in these flights";
  static const struct {
    bool unknown, more;
    double left, jumps; // of the floor; share
  } cases[] = {
      {false, false, 1.9, 0.74}, {false, true, 1.0, 0.76}, {false, true, 2.1, 0.0}, {true, true, 1.9, 0.0}};
  study_t *const study = calloc(1, sizeof *study);
  report_t *const r = calloc(1, sizeof *r);
  r->study = study;
  study->diagnosis.nominal_flew = true;
  for (unsigned i = 0; i < sizeof cases / sizeof *cases; i++) {
    ROW("%g", cases[i].left);
    study->diagnosis.unknown = cases[i].unknown;
    study->diagnosis.held_out.channel[CH_WY] =
        (gap_part_t){.used = true, .after = cases[i].left, .floor = 1.0, .jumps = cases[i].jumps};
    memset(&r->to_do, 0, sizeof r->to_do);
    report_advise(r);
    CHECK_TEXT(r->to_do.line[0], cases[i].more ? mind : alone);
  }
  free(study);
  free(r);
}

TEST(gap_advises_to_fly_where_something_is_but_not_when) {
  static const gap_flight_t two = {.name = "/folder/two.csv"};
  static const struct {
    cell_t cell;
    const char *line;
  } cases[] = {
      {{.along = COORDINATE_HEIGHT, .coordinate = "height", .unit = "m", .from = 0.4, .to = 0.6},
       "fly: the same again with more time at height 0.4 to 0.6 m, and as much beside it"},
      {{.along = COORDINATE_TIME, .coordinate = "time", .unit = "s", .from = 3.0, .to = 3.2},
       "fly: the same again, and see whether what is at time 3 to 3.2 s comes once more; "},
      {{.along = COORDINATE_TIME, .from = 3.0, .to = 3.04, .is_pulse = true, .log = &two},
       "fly: the same again, and see whether what is at time 3.00 to 3.04 s of two.csv comes once more; "},
      {{.along = NOWHERE, .coordinate = "frequency", .unit = "Hz", .from = 2.4, .to = 2.6},
       "fly: the same again with another pilot or other gains, and see whether it stays at frequency "
       "2.4 to 2.6 Hz"},
      {{.along = BY_FLIGHT, .coordinate = "flight"}, "fly: twice with nothing touched in between, "},
  };
  study_t *const study = calloc(1, sizeof *study);
  report_t *const r = calloc(1, sizeof *r);
  r->study = study;
  study->diagnosis.unknown = true;
  for (unsigned i = 0; i < sizeof cases / sizeof *cases; i++) {
    ROW("%s", cases[i].cell.coordinate);
    study->diagnosis.left.cell = cases[i].cell;
    memset(&r->to_do, 0, sizeof r->to_do);
    report_advise(r);
    CHECK(strncmp(r->to_do.line[2], cases[i].line, strlen(cases[i].line)) == 0);
  }
  free(study);
  free(r);
}

// Nothing is named or unknown: what a faster log would show, or another flight that is held out.
static const struct {
  const char *what;
  bool more, by_time, left_out;
  double rows_Hz, command_Hz;
  const char *line;
} another[] = {
    {"all is explained", false, false, false, 500.0, 500.0,
     "fly: nothing more for the effects that are known"},
    {"more is left", true, false, false, 500.0, 500.0,
     "fly: nothing yet; hold out other flights (--hold-out LOG): what is held out now shows something that "
     "the fitted flights hardly do"},
    {"more is left by turns", true, true, false, 500.0, 500.0,
     "fly: nothing more for the effects that are known"},
    {"rows miss commands", false, false, true, 100.0, 250.0,
     "fly: the same again, logged 250 times a second, for what turns the vehicle: these rows miss "
     "commands"},
    {"rows are few", false, false, true, 100.0, 0.0,
     "fly: the same again, logged 500 times a second, for what turns the vehicle: these rows miss "
     "commands"},
    {"rows have all commands", false, false, true, 250.0, 250.0,
     "fly: nothing more for the effects that are known"},
};

TEST(gap_advises_another_log_where_no_other_flight_helps) {
  for (unsigned i = 0; i < sizeof another / sizeof *another; i++) {
    ROW("%s", another[i].what);
    study_t *const study = calloc(1, sizeof *study);
    report_t *const r = calloc(1, sizeof *r);
    diagnosis_t *const d = &study->diagnosis;
    gap_flight_t log = {.name = "logs/steps.csv", .rate_Hz = another[i].rows_Hz};
    grid_t grid = {.flight = &log, .command_Hz = another[i].command_Hz};
    r->study = study;
    study->by_time = another[i].by_time;
    d->nominal_flew = true;
    d->fit = d->held = (set_t){.grid = &grid, .n_grid = 1};
    d->fit.excluded[CH_WX] = another[i].left_out;
    d->held_out.channel[CH_FZ] =
        (gap_part_t){.used = true, .after = another[i].more ? 3.0 : 1.0, .floor = 1.0};
    report_advise(r);
    CHECK_TEXT(r->to_do.line[2], another[i].line);
    free(study);
    free(r);
  }
}
