// test_cli.c - the programs as a person meets them: options, bad input, exit status.
#include "programs.h"
#include "test.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <string.h>

static const struct {
  const char *arguments, *line;
} REFUSED[] = {
    {"fly", "fly: one scenario is needed; fly --list shows them\n"},
    {"fly loop-the-loop", "fly: loop-the-loop: no such scenario; fly --list shows them\n"},
    {"fly appendix-a appendix-a", "fly: one scenario is needed; fly --list shows them\n"},
    {"fly appendix-a --wings", "fly: --wings: not an option, or without its value; fly --help lists them\n"},
    {"fly appendix-a --seed", "fly: --seed: not an option, or without its value; fly --help lists them\n"},
    {"fly appendix-a --seed -3", "fly: --seed -3: allowed is a whole number from 0 to 1000000000\n"},
    {"fly appendix-a --seeds 0", "fly: --seeds 0: allowed is a whole number from 1 to 10000\n"},
    {"fly appendix-a --controller lqr",
     "fly: --controller lqr: allowed are indi, indi-theory, indi-rbf, indi-learned; on the vertical axis "
     "pid, "
     "pid-ff; in six degrees of freedom stock-pid, stock-indi, air-garage\n"},
    {"fly appendix-a --set indiPos.kp", "fly: --set indiPos.kp: allowed is group.name=value\n"},
    {"fly appendix-a --set indiPos.kq=1",
     "fly: --set indiPos.kq: no such parameter; fly --params lists them\n"},
    {"fly appendix-a --set indiPos.kp=-1", "fly: --set indiPos.kp=-1: allowed is a number from 0.05 to 20\n"},
    {"fly appendix-a --set indiPos.kp=nan",
     "fly: --set indiPos.kp=nan: allowed is a number from 0.05 to 20\n"},
    {"fly appendix-a --set indiPos.kp=1x", "fly: --set indiPos.kp=1x: allowed is a number from 0.05 to 20\n"},
    {"fly appendix-a --set ceil.mode=1.5",
     "fly: --set ceil.mode=1.5: allowed is a whole number from 0 to 3\n"},
    {"fly appendix-a --set rls.q=1e-3 --set rls.p0=1e-3 --set rls.q=1e-3 --set ceil.near=0.2 --set "
     "ceil.floor=0.2 "
     "--set ceil.near=0.1",
     "fly: --set: with rls.q=0.001, rls.p0=0.001, ceil.floor=0.2, ceil.near=0.1, ceil.far=0.5, "
     "rls.zMin=0.005, "
     "rls.zMax=0.1: allowed is rls.q <= rls.p0, ceil.floor <= ceil.near < ceil.far, rls.zMin < rls.zMax\n"},
    {"fly appendix-a --set indiPos.cutoff=0.001",
     "fly: --set indiPos.cutoff=0.001: allowed is 0, or 0.1 to 45 Hz\n"},
    {"fly test-flight --set indiAtt.cutoff=0.1",
     "fly: --set indiAtt.cutoff=0.1: allowed is 0, or 0.5 to 200 Hz\n"},
    {"fly pid-tables --set indiPos.kp=1", "fly: --set: the flight code does not fly in pid-tables\n"},
    {"fly rls-sweep --controller pid", "fly: --controller pid: knows no ceiling distance to learn from\n"},
    {"fly appendix-a --noise loud",
     "fly: --noise loud: allowed are none, n1, n2, n3 on the vertical axis, quiet, real in six degrees of "
     "freedom\n"},
    {"fly appendix-a --noise real",
     "fly: --noise real: this scenario is flown on the vertical axis; allowed are none, n1, n2, n3\n"},
    {"fly close-flight --noise n1",
     "fly: --noise n1: this scenario is flown in six degrees of freedom; allowed are quiet, real\n"},
    {"fly appendix-a --integrator euler", "fly: --integrator euler: allowed are sundials, rk4, reference\n"},
    {"fly appendix-a --seeds 2 --log x.csv", "fly: --log: one flight can be written; leave out --seeds\n"},
    {"fly close-flight --from 1", "fly: --from, --to: both are needed, and --from <= --to\n"},
    {"fly close-flight --from 2 --to 1", "fly: --from, --to: both are needed, and --from <= --to\n"},
    {"fly close-flight --from 1 --to 2 --seeds 3",
     "fly: --seeds: allowed is either that or --from and --to\n"},
    {"fly close-flight --from 1 --to 2 --log x.csv",
     "fly: --log: one flight can be written; leave out --from and --to\n"},
    {"fly close-flight --from 1 --to 2 --json /no/such/dir/x.json",
     "fly: /no/such/dir/x.json: cannot be written: No such file or directory\n"},
    {"fly hand-held --controller indi",
     "fly: --controller, --set: in hand-held nobody flies; allowed are --vehicle, --noise, --seed\n"},
    {"fly appendix-a --json /no/such/dir/x.json",
     "fly: /no/such/dir/x.json: cannot be written: No such file or directory\n"},
    {"fly appendix-a --vehicle /no/such.toml",
     "fly: /no/such.toml: cannot be opened: No such file or directory\n"},
    {"fly pid-tables --controller indi", "fly: --controller: pid-tables flies pid and pid-ff\n"},
    {"effectiveness", "effectiveness: one log is needed; allowed: effectiveness LOG.csv\n"},
    {"effectiveness a.csv b.csv", "effectiveness: one log is needed; allowed: effectiveness LOG.csv\n"},
    {"effectiveness a.csv --lag 0", "effectiveness: --lag 0: allowed is a number from 0.001 to 0.5\n"},
    {"effectiveness a.csv --poles 3", "effectiveness: --poles 3: allowed are 2, 4\n"},
    {"effectiveness a.csv --wings",
     "effectiveness: --wings: not an option, or without its value; allowed: --lag, --cutoff, --poles, "
     "--thrust-min, --as-stock, --json, --help\n"},
    {"effectiveness /no/such.csv",
     "effectiveness: /no/such.csv: cannot be opened: No such file or directory\n"},
};

TEST(fly_refuses_bad_input_with_one_line_and_status_two) {
  for (unsigned i = 0; i < sizeof REFUSED / sizeof *REFUSED; i++) {
    ROW("%s", REFUSED[i].arguments);
    char text[2000];
    CHECK(program_run(REFUSED[i].arguments, STREAM_ERROR, text, sizeof text) == 2);
    CHECK_TEXT(text, REFUSED[i].line);
    CHECK(program_run(REFUSED[i].arguments, STREAM_OUTPUT, text, sizeof text) == 2);
    CHECK_TEXT(text, "");
  }
}

TEST(fly_names_what_is_allowed_of_an_effect) {
  static const struct {
    const char *spec, *part;
  } row[] = {
      {"sealing", "ceiling"},
      {"ceiling:form=cubic", "square-root"},
      {"ceiling:Cq=1", "Ca"},
      {"ceiling:Ca=99", "0"},
      {"ceiling:form=linear", "exponential"},
      {"ceiling:form=table", "file"},
      {"ceiling:form=table,file=/no/such.csv", "/no/such.csv"},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].spec);
    char arguments[200], text[2000];
    snprintf(arguments, sizeof arguments, "fly appendix-a --effect %s", row[i].spec);
    CHECK(program_run(arguments, STREAM_ERROR, text, sizeof text) == 2);
    CHECK(strstr(text, row[i].part) != NULL);
    CHECK(strchr(text, '\n') == text + strlen(text) - 1); // one line
  }
}

TEST(fly_says_what_it_can_do) {
  static const struct {
    const char *arguments, *part;
  } row[] = {
      {"fly --help", "--effect NAME"}, {"fly --list", "appendix-a"},   {"fly --list", "form=four-rotor"},
      {"fly --params", "indiPos.kp"},  {"fly --params", "ceil.w7"},    {"fly --params", "rls.lambda"},
      {"fly appendix-a", "0.48"},      {"learn --help", "--hold-out"}, {"effectiveness --help", "--as-stock"},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].arguments);
    static char text[20000];
    CHECK(program_run(row[i].arguments, STREAM_OUTPUT, text, sizeof text) == 0);
    CHECK(strstr(text, row[i].part) != NULL);
  }
}

TEST(fly_changes_the_plant_and_not_the_controller_by_an_effect) {
  // The controller keeps its own theory: with a weaker plant it is the overestimation of figure A.14 and
  // slower.
  char text[4000];
  CHECK(program_run("fly appendix-a --controller indi-theory --set indiPos.cutoff=0 --effect ceiling:Ca=0 "
                    "--integrator rk4",
                    STREAM_OUTPUT, text, sizeof text) == 0);
  const char *last = strstr(text, "0.48");
  double overshoot, peaks, t90 = 0.0;
  if (!CHECK(last && sscanf(last, "0.48 %lf %lf %lf", &overshoot, &peaks, &t90) == 3)) return;
  CHECK(t90 > 4.27);
}

TEST(fly_writes_the_same_flight_for_the_same_seed) {
  char line[300], text[4000];
  for (int i = 0; i < 3; i++) {
    snprintf(line, sizeof line, "fly learning-1d --integrator rk4 --seed %d --log $S/c_%d.csv",
             i == 2 ? 8 : 7, i);
    CHECK(program_run(line, STREAM_OUTPUT, text, sizeof text) == 0);
  }
  CHECK(program_run("cmp -s $S/c_0.csv $S/c_1.csv", STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK(program_run("cmp -s $S/c_0.csv $S/c_2.csv", STREAM_OUTPUT, text, sizeof text) == 1);
}

TEST(fly_writes_nothing_when_something_is_wrong) {
  static const struct {
    const char *line, *message;
    int status;
  } row[] = {
      {"fly appendix-a --log $S/new.csv --json /no/such/x.json",
       "fly: /no/such/x.json: cannot be written: No such file or directory\n", 2},
      {"fly appendix-a --json $S/new.json --log $S/c_dir", "fly: c_dir: a folder; allowed: a file\n", 2},
      {"fly appendix-a --log $S/new --json $S/c_dir/../new",
       "fly: c_dir/../new: to be written twice; allowed: a file for each output\n", 2},
      {"fly pid-tables --controller indi --log $S/new --json $S/c_old",
       "fly: --controller: pid-tables flies pid and pid-ff\n", 2},
      {"fly appendix-a --json $S/c_own.toml --vehicle $S/c_own.toml",
       "fly: c_own.toml: to be read and to be written; allowed: one of them\n", 2},
      // A disk that is full after 512 bytes or 1 KB, as the shell counts.
      {"trap '' XFSZ; ulimit -f 1; fly appendix-a --json $S/c_old --log $S/new.csv",
       "fly: new.csv: cannot be written: File too large\n", 1},
      {"fly appendix-a --json $S/c_old --log $S/new.csv >/dev/full",
       "fly: standard output: cannot be written\n", 1},
      {"fly --help >/dev/full", "fly: standard output: cannot be written\n", 1},
      {"fly --list >/dev/full", "fly: standard output: cannot be written\n", 1},
      {"fly --params >/dev/full", "fly: standard output: cannot be written\n", 1},
      {"fly appendix-a --json $S/new.json >&-", "fly: standard output: it is closed\n", 1},
      {"fly appendix-a --seeds x", "fly: --seeds x: allowed is a whole number from 1 to 10000\n", 2},
  };
  char before[4000], after[4000], text[2000];
  CHECK(program_run("mkdir -p $S/c_dir; cp sim/vehicles/thesis_1d.toml $S/c_own.toml; "
                    "printf old >$S/c_old",
                    STREAM_ERROR, text, sizeof text) == 0);
  program_listing(before, sizeof before);
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].line);
    CHECK(program_run(row[i].line, STREAM_ERROR, text, sizeof text) == row[i].status);
    CHECK_TEXT(text, row[i].message);
    program_listing(after, sizeof after);
    CHECK_TEXT(after, before);
  }
  CHECK(program_run("cat $S/c_old", STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK_TEXT(text, "old");
}

TEST(fly_tells_all_of_every_segment_in_its_json) {
  static const char *const field[] = {"setpoint_m",    "overshoot_mm", "peaks",  "t90_s",      "settle_1mm_s",
                                      "mean_error_mm", "sd_mm",        "rms_mm", "min_gap_mm", "contacts"};
  static char text[20000];
  // Standard INDI touches the ceiling and never settles there; without a ceiling there is no gap to it.
  CHECK(program_run("fly appendix-a --set indiPos.cutoff=8 --json /dev/stdout >$S/c.json; cat $S/c.json",
                    STREAM_OUTPUT, text, sizeof text) == 0);
  const char *const begin = strchr(text, '{'); // behind what is printed
  cJSON *json = cJSON_Parse(begin ? begin : "");
  const cJSON *segments = cJSON_GetObjectItem(json, "segments");
  if (CHECK(cJSON_GetArraySize(segments) == 3)) {
    for (int i = 0; i < 3; i++) {
      const cJSON *s = cJSON_GetArrayItem(segments, i);
      CHECK(cJSON_GetArraySize(s) == 10);
      for (unsigned k = 0; k < sizeof field / sizeof *field; k++) {
        ROW("segment %d, %s", i, field[k]);
        const cJSON *item = cJSON_GetObjectItemCaseSensitive(s, field[k]);
        const int not_reached = i == 2 && strcmp(field[k], "settle_1mm_s") == 0;
        CHECK(item && (not_reached ? cJSON_IsNull(item) : cJSON_IsNumber(item)));
      }
    }
    const cJSON *last = cJSON_GetArrayItem(segments, 2);
    CHECK(cJSON_GetObjectItem(last, "contacts")->valuedouble > 0.0);
    CHECK_NEAR(cJSON_GetObjectItem(last, "setpoint_m")->valuedouble, 0.48, 1e-12);
  }
  ROW("%s", "the flight");
  CHECK(cJSON_IsNumber(cJSON_GetObjectItem(json, "contacts")));
  CHECK(cJSON_IsTrue(cJSON_GetObjectItem(json, "finite")));
  CHECK(cJSON_IsNumber(cJSON_GetObjectItem(json, "realtime_factor")));
  cJSON_Delete(json);
}

TEST(fly_writes_the_same_lines_however_the_work_was_cut) {
  static const struct { int from, to; } row[] = {{1, 6}, {1, 3}, {4, 6}};
  static char text[3][4000];
  char line[300];
  for (int i = 0; i < 3; i++) {
    snprintf(line, sizeof line, "fly close-flight --integrator rk4 --from %d --to %d --json $S/cut_%d",
             row[i].from, row[i].to, i);
    CHECK(program_run(line, STREAM_OUTPUT, text[i], sizeof text[i]) == 0);
  }
  const size_t first = strlen(text[1]);
  CHECK(strncmp(text[0], text[1], first) == 0);
  CHECK_TEXT(text[0] + first, text[2]);
  CHECK(program_run("cat $S/cut_1 $S/cut_2 | cmp -s - $S/cut_0", STREAM_OUTPUT, text[0], sizeof text[0]) ==
        0);
  CHECK(program_run("test $(wc -l <$S/cut_0) = 6", STREAM_OUTPUT, text[0], sizeof text[0]) == 0);
}

TEST(learn_reads_what_fly_writes_of_six_degrees_of_freedom) {
  char text[4000];
  CHECK(program_run("fly learning-flight --integrator rk4 --log $S/six.csv", STREAM_OUTPUT, text,
                    sizeof text) == 0);
  CHECK(strstr(text, "ceil.w7") != NULL);
  CHECK(program_run("learn $S/six.csv", STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK(strstr(text, "ceil.w7 = ") != NULL);
}
