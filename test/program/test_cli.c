// test_cli.c - the programs as a person meets them: options, bad input, exit status.
#include "rig/programs.h"
#include "rig/test.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <string.h>

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
      {"fly --help", "--effect NAME"},   {"fly --list", "appendix-a"},
      {"fly --list", "form=four-rotor"}, {"fly --effects", "F = -c \\|v\\| v - (linear_x v_x"},
      {"fly --params", "indiPos.kp"},    {"fly --params", "ceil.w7"},
      {"fly --params", "rls.lambda"},    {"fly appendix-a", "0.48"},
      {"learn --help", "--hold-out"},    {"effectiveness --help", "--as-stock"},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].arguments);
    static char text[20000];
    CHECK(program_run(row[i].arguments, STREAM_OUTPUT, text, sizeof text) == 0);
    CHECK(strstr(text, row[i].part) != NULL);
  }
}

// Built without OpenMP they have one thread, and nothing is told.
TEST(programs_of_many_threads_sleep_while_these_wait) {
  static const struct {
    const char *said, *line, *want;
  } row[] = {
      {"", "gap --version", "'0'"},
      {"", "fly close-flight --integrator rk4 --from 1 --to 2", "'0'"},
      {"GOMP_SPINCOUNT=7", "gap --version", "'7'"},
      {"OMP_WAIT_POLICY=active", "gap --version", "'30000000000'"},
      {"OMP_NUM_THREADS=1", "gap --version", "'300000'"}, // nobody waits
  };
  static const char *const told = "GOMP_SPINCOUNT = ",
                           *const unset = "env -u OMP_WAIT_POLICY -u GOMP_SPINCOUNT -u OMP_NUM_THREADS";
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s %s", row[i].said, row[i].line);
    char line[200], text[8000];
    snprintf(line, sizeof line, "%s %s OMP_DISPLAY_ENV=verbose %s", unset, row[i].said, row[i].line);
    CHECK(program_run(line, STREAM_ERROR, text, sizeof text) == 0);
    const char *last = text;
    for (const char *at = text; (at = strstr(at, told));) last = at += strlen(told);
    CHECK(last == text ? !strstr(text, "OMP_") : strncmp(last, row[i].want, strlen(row[i].want)) == 0);
  }
}

TEST(fly_changes_the_plant_and_not_the_controller_by_an_effect) {
  // --effect changes the plant only. The controller keeps its theoretical curve, and so overestimates the
  // weaker plant as in figure A.14, and is slower.
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
      {"trap '' XFSZ; " PROGRAM_DISK_FULL "fly appendix-a --json $S/c_old --log $S/new.csv",
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
  CHECK(program_run("mkdir -p $S/c_dir; cp sim/vehicle/vehicles/thesis_1d.toml $S/c_own.toml; "
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
  const char *const begin = strchr(text, '{'); // after what is printed
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
    snprintf(line, sizeof line,
             "SOURCE_DATE_EPOCH=1 fly close-flight --integrator rk4 --from %d --to %d --json $S/cut_%d",
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

TEST(fly_merges_summaries_to_what_one_run_writes) {
  char text[12000], merged[12000];
  const char *const fly = "fly close-flight --integrator rk4 --noise flown";
  char line[400];
  snprintf(line, sizeof line,
           "%s --from 1 --to 2 --summary $S/a >/dev/null && %s --from 3 --to 5 --summary $S/b >/dev/null && "
           "%s --from 1 --to 5 --summary $S/ab",
           fly, fly, fly);
  CHECK(program_run(line, STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK(strstr(text, "fly --integrator rk4 --noise flown close-flight\n  flights 5, touched ") == text);
  CHECK(program_run("fly --merge $S/b $S/a --summary $S/joined && cmp $S/joined $S/ab", STREAM_OUTPUT, merged,
                    sizeof merged) == 0);
  CHECK_TEXT(merged, text);
}

// A changed vehicle file is another plant. Cells are written in one order, whatever the order of the files.
TEST(fly_keeps_summaries_of_different_files_apart) {
  char text[12000];
  CHECK(
      program_run("cp sim/vehicle/vehicles/cf21_legacy.toml $S/v.toml && "
                  "fly test-flight --integrator rk4 --vehicle $S/v.toml --from 1 --to 1 --summary $S/one && "
                  "sed -i 's/^motor_tau_s = 0.08/motor_tau_s = 0.09/' $S/v.toml && "
                  "fly test-flight --integrator rk4 --vehicle $S/v.toml --from 2 --to 2 --summary $S/other",
                  STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK(program_run(
            "fly --merge $S/one $S/other --summary $S/ab && fly --merge $S/other $S/one --summary $S/ba && "
            "cmp $S/ab $S/ba && test $(wc -l <$S/ab) = 2",
            STREAM_OUTPUT, text, sizeof text) == 0);
}

TEST(learn_reads_what_fly_writes_of_six_degrees_of_freedom) {
  char text[4000];
  CHECK(program_run("fly learning-flight --integrator rk4 --log $S/six.csv", STREAM_OUTPUT, text,
                    sizeof text) == 0);
  CHECK(strstr(text, "ceil.w7") != NULL);
  CHECK(program_run("learn $S/six.csv", STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK(strstr(text, "ceil.w7 = ") != NULL);
}

TEST(bound_says_what_it_was_asked) {
  char text[500], stiff[500];
  CHECK(program_run("bound --noise real 20", STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK_TEXT(text, " gap_mm   k_per_s2   still_mm    walk_mm\n     20         64       0.80       1.02\n");
  // A stronger ceiling is felt more, in the accelerometer too.
  CHECK(program_run("bound --noise real --effect ceiling:Ca=0.8 20", STREAM_OUTPUT, stiff, sizeof stiff) ==
        0);
  CHECK(strstr(stiff, "\n     20 ") != NULL && strcmp(text, stiff) != 0);
}

TEST(a_word_that_no_test_has_is_told_and_is_no_success) {
  char text[500];
  CHECK(program_run("tests no_such_test", STREAM_ERROR, text, sizeof text) == 2);
  CHECK_TEXT(text, "tests: no test's file or name has the word `no_such_test`\n");
  // A part of a name is enough.
  CHECK(program_run("tests quadrature_of_a", STREAM_OUTPUT, text, sizeof text) == 2);
  CHECK(program_run("tests oracle_gives_the_eigenvalues", STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK(strstr(text, "\n1 passed, 0 failed\n") != NULL);
}
