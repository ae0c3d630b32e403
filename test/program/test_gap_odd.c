// test_gap_odd.c - what a newcomer may give the workflow: one clear line, exit status 2, and no file.
#include "rig/gap_logs.h"
#include "rig/programs.h"
#include "rig/test.h"

#include <stdio.h>
#include <string.h>

static const struct {
  const char *what, *made, *order, *want; // made: from odd0.csv, by awk
} odd[] = {
    {"0.4 s", "NR<=200", "$S/made.csv", "s of flight; allowed: 1 s or more"},
    {"3 rows", "NR<=4", "$S/made.csv", "0 samples without a gap; allowed: a second of flight or more"},
    {"motors off", "NR>1{for(i=18;i<=21;i++)$i=0}1", "$S/made.csv", "no instant at which motors carry it"},
    {"motors stand still", "NR>1{for(i=18;i<=21;i++)$i=0.08}1", "$S/made.csv", "is the sensor stuck?"},
    {"all zero", "NR>1{for(i=2;i<=NF;i++)$i=0}1", "$S/made.csv", "the quaternion's length is 0; allowed"},
    {"yaw alone", "{print $1,$17;next}", "$S/made.csv", "column stateEstimate.x: missing"},
    {"names alone", "NR==1", "$S/made.csv", "no row under the names"},
    {"time runs back", "NR==900{$1=1}1", "$S/made.csv", "allowed: time that increases from row to row"},
    {"a lower room", "1", "--vehicle $S/low.toml $S/made.csv", "above the ceiling of vehicle Crazyflie 2.1"},
    {"another vehicle", "1", "--vehicle sim/vehicle/vehicles/quad15.toml $S/made.csv",
     "is it the right vehicle"},
    {"another laboratory's columns", "1", "--columns tools/columns/imrc.toml $S/made.csv",
     "column t_s: missing"},
    {"a vehicle for columns", "1", "--columns $S/room.toml $S/made.csv",
     "unknown key; allowed: rest_height_m"},
    {"a log for a vehicle", "1", "--vehicle $S/made.csv $S/made.csv",
     "allowed: a vehicle file in TOML (as sim/vehicle/vehicles/cf21_legacy.toml) with name, mass_kg, "},
    {"a folder of flights", "1", "$S", "allowed: "},
    {"every log held out", "1", "--hold-out $S/made.csv $S/made.csv", "every log is held out"},
    {"the same log twice", "1", "$S/made.csv $S/made.csv", "given twice; allowed: once"},
    {"two vehicles", "1", "--vehicle $S/low.toml --vehicle $S/room.toml $S/made.csv",
     "--vehicle: given twice; allowed: once"},
    {"no path", "1", "--json '' $S/made.csv", "--json: an empty path"},
    {"a path in no folder", "1", "--json $S/none/x.json $S/made.csv", "cannot be written"},
    {"the log as output", "1", "--json $S/made.csv $S/made.csv", "to be read and to be written"},
};

TEST(gap_says_in_one_line_why_it_cannot_use_what_it_is_given) {
  char text[2000], before[4000], after[4000], line[900];
  CHECK(gap_logs_fly("odd", 1, NULL));
  CHECK(program_run("sed 's/^ceiling_m.*/ceiling_m = 0.3/' $S/room.toml >$S/low.toml; : >$S/made.csv",
                    STREAM_OUTPUT, text, sizeof text) == 0);
  program_listing(before, sizeof before);
  for (unsigned i = 0; i < sizeof odd / sizeof *odd; i++) {
    ROW("%s", odd[i].what);
    snprintf(line, sizeof line, "awk 'BEGIN{FS=OFS=\",\"} %s' $S/odd0.csv >$S/made.csv; gap %s %s %s",
             odd[i].made, strstr(odd[i].order, "--vehicle") ? "" : "--vehicle $S/room.toml",
             strstr(odd[i].order, "--columns") ? "" : "--columns tools/columns/fly.toml", odd[i].order);
    CHECK(program_run(line, STREAM_ERROR, text, sizeof text) == 2);
    CHECK(strstr(text, "gap: ") == text && strchr(text, '\n') == text + strlen(text) - 1);
    CHECK(strstr(text, odd[i].want) != NULL);
    program_listing(after, sizeof after);
    CHECK_TEXT(after, before);
  }
}

// Another simulator's controller answers each step of its set point by a kick of two rows. In flight is what
// carries more than a share of the largest thrust, and the kicks alone did.
TEST(gap_reads_commands_that_kick) {
  char text[4000];
  CHECK(gap_logs_fly("odd", 1, NULL));
  CHECK(program_run("sed 's/^thrust_max_N.*/thrust_max_N = 6/' $S/room.toml >$S/strong.toml; "
                    "awk 'BEGIN {FS = OFS = \",\"} NR > 1 && (NR % 150 < 2 || NR > 9990) {for (i = 18; i <= "
                    "21; i++) $i = 1.2} 1' "
                    "$S/odd0.csv >$S/kicks.csv; "
                    "gap --vehicle $S/strong.toml --columns tools/columns/fly.toml $S/kicks.csv 2>&1",
                    STREAM_OUTPUT, text, sizeof text) == 0);
  ROW("%s", text);
  CHECK(strstr(text, " s in the air") != NULL);
}

// Another simulator's hover: its controller knows the truth and settles, and only the logged states have
// noise.
TEST(gap_reads_a_hover_in_which_the_commands_stand_still) {
  char text[4000];
  CHECK(gap_logs_fly("odd", 1, NULL));
  CHECK(
      program_run(
          "awk 'function e(sd) {return sd * (rand() + rand() + rand() + rand() - 2) * 1.73} "
          "BEGIN {FS = OFS = \",\"; srand(3)} NR > 1 {$2 = e(0.001); $3 = e(0.001); $4 = 0.5 + e(0.001); "
          "for (i = 5; i <= 7; i++) $i = e(0.009); $8 = e(0.003); $9 = e(0.003); $10 = 1 + e(0.003); "
          "$11 = 1; for (i = 12; i <= 14; i++) $i = e(0.001); for (i = 15; i <= 17; i++) $i = e(0.3); "
          "for (i = 18; i <= 21; i++) $i = 0.0785 + (NR < 500 ? e(0.002) : 0)} 1' $S/odd0.csv >$S/hover.csv; "
          "gap --vehicle $S/room.toml --columns tools/columns/fly.toml $S/hover.csv 2>&1",
          STREAM_OUTPUT, text, sizeof text) == 0);
  ROW("%s", text);
  CHECK(strstr(text, " s in the air") != NULL);
}
