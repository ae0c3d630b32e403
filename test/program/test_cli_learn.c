// test_cli_learn.c - `learn` as a person meets it: logs, bad files, its JSON.
#include "logs/learn_log.h"
#include "rig/programs.h"
#include "rig/scratch.h"
#include "rig/test.h"
#include "vehicle/model_file.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <string.h>

#define VEHICLE "--vehicle sim/vehicle/vehicles/thesis_1d.toml"

// Writes a learning flight; its first 15 s, with gaps above 7 cm; and logs with faults.
static void make_logs(void) {
  char text[400];
  CHECK(program_run("fly learning-1d --integrator rk4 --seed 7 --log $S/l_flight.csv; "
                    "head -n 1500 $S/l_flight.csv >$S/l_high.csv; "
                    "{ head -n 999 $S/l_flight.csv; printf 9980.000,0.4; } >$S/l_cut.csv; "
                    "head -n 1 $S/l_flight.csv >$S/l_names.csv; : >$S/l_empty.csv; mkdir -p $S/l_dir; "
                    "sed '9s/,1.0000000,0.0000000,/,1.0000000,x,/' $S/l_flight.csv >$S/l_word.csv; "
                    "sed '9,$ s/,1.0000000,0.0000000,/,1.0000000,x,/' $S/l_flight.csv >$S/l_words.csv; "
                    "sed '9s/^[0-9.]*/10.000/' $S/l_flight.csv >$S/l_back.csv; "
                    "sed '9s/,1.0000000,/,\"1,0\",/' $S/l_flight.csv >$S/l_comma.csv; "
                    "sed '9s/,1.0000000,/,1,0000000,/' $S/l_flight.csv >$S/l_more.csv",
                    STREAM_ERROR, text, sizeof text) == 0);
  CHECK_TEXT(text, "");
  scratch_file("l_other.toml",
               "[columns]\ntime = {column = \"timestamp\", unit = \"ms\"}\n"
               "z = {column = \"altitude\", unit = \"m\"}\n",
               -1);
  scratch_file("l_broken.toml", "acceleration = \"body\"\n[columns\n", -1);
  CHECK(program_run("sed 's/^mass_kg/mass_g/' sim/vehicle/vehicles/thesis_1d.toml >$S/l_unknown.toml",
                    STREAM_ERROR, text, sizeof text) == 0);
}

static const struct {
  const char *what, *arguments, *line;
} REFUSED[] = {
    {"missing", "$S/l_no.csv", "learn: l_no.csv: cannot be opened: No such file or directory\n"},
    {"empty", "$S/l_empty.csv",
     "learn: l_empty.csv:1: the file is empty; allowed: a row of names and rows of numbers\n"},
    {"header only", "$S/l_names.csv", "learn: l_names.csv:1: no row under the names; allowed: one or more\n"},
    {"truncated", "$S/l_cut.csv",
     "learn: l_cut.csv:1000: column stateEstimate.z: missing: the row has 2 cells, the first row names 41 "
     "(cut off here?)\n"},
    {"no numbers", "$S/l_words.csv",
     "learn: l_words.csv:9: column stateEstimate.qx: not a number, the first of 5994 such cells in 6001 "
     "rows; "
     "allowed: 5 %\n"},
    {"time runs back", "$S/l_back.csv",
     "learn: l_back.csv:9: column timestamp: 0.01 s after 0.06 s; allowed: time that increases from row to "
     "row\n"},
    {"decimal comma", "$S/l_comma.csv",
     "learn: l_comma.csv:9: column stateEstimate.qw: decimal comma in `1,0`; allowed: `.`\n"},
    {"decimal comma, not quoted", "$S/l_more.csv",
     "learn: l_more.csv:9: 42 cells where the first row names 41; allowed: `,` between cells and `.` in "
     "numbers\n"},
    {"a folder", "$S/l_dir",
     "learn: l_dir: cannot be read: Is a directory; allowed: a log, or a folder with the .csv files of one "
     "flight\n"},
    {"bad after a good one", "$S/l_flight.csv $S/l_cut.csv",
     "learn: l_cut.csv:1000: column stateEstimate.z: missing: the row has 2 cells, the first row names 41 "
     "(cut off here?)\n"},
    {"held out, missing", "$S/l_flight.csv --hold-out $S/l_no.csv",
     "learn: l_no.csv: cannot be opened: No such file or directory\n"},
    {"held out, truncated", "$S/l_flight.csv --hold-out $S/l_cut.csv",
     "learn: l_cut.csv:1000: column stateEstimate.z: missing: the row has 2 cells, the first row names 41 "
     "(cut off here?)\n"},
    {"unknown column", "$S/l_flight.csv --columns $S/l_other.toml",
     "learn: l_flight.csv:1: column altitude: missing; it is the signal `z` of this kind of log\n"},
    {"columns file missing", "$S/l_flight.csv --columns $S/l_no.toml",
     "learn: l_no.toml: cannot be opened: No such file or directory\n"},
    {"broken TOML", "$S/l_flight.csv --columns $S/l_broken.toml",
     "learn: l_broken.toml:2:9: Error while parsing table header: expected ']', saw '\\n'; allowed: a "
     "columns file in TOML (as "
     "tools/columns/fly.toml) with rest_height_m, acceleration, rows, columns\n"},
    {"unknown vehicle key", "$S/l_flight.csv --vehicle $S/l_unknown.toml",
     "learn: l_unknown.toml:3: mass_g: unknown key (did you mean mass_kg?); allowed: name, mass_kg, "
     "rotor_radius_m, motor_tau_s, "
     "motor_tau_down_s, lag_in, lag_square, thrust_min_N, thrust_max_N, ceiling_m, wall_y_m, floor_rise_x, "
     "floor_rise_y, "
     "thrust_map, body, rotors, battery, controller, range_up, range_down, "
     "effect\n"},
    {"written twice", "$S/l_flight.csv --points $S/l_new.json",
     "learn: l_new.json: to be written twice; allowed: a file for each output\n"},
    {"read and written", "$S/l_flight.csv --points $S/l_dir/../l_flight.csv",
     "learn: l_flight.csv: to be read and to be written; allowed: one of them\n"},
    {"no folder", "$S/l_flight.csv --points /no/such/p.csv",
     "learn: /no/such/p.csv: cannot be written: No such file or directory\n"},
};

TEST(learn_refuses_bad_files_with_one_line_and_writes_nothing) {
  make_logs();
  char before[4000], after[4000], line[600], text[2000];
  program_listing(before, sizeof before);
  for (unsigned i = 0; i < sizeof REFUSED / sizeof *REFUSED; i++) {
    ROW("%s", REFUSED[i].what);
    const bool vehicle = strstr(REFUSED[i].arguments, "--vehicle") != NULL;
    const bool points = strstr(REFUSED[i].arguments, "--points") != NULL;
    snprintf(line, sizeof line, "learn %s --json $S/l_new.json %s %s", REFUSED[i].arguments,
             vehicle ? "" : VEHICLE, points ? "" : "--points $S/l_new.csv");
    CHECK(program_run(line, STREAM_ERROR, text, sizeof text) == 2);
    CHECK_TEXT(text, REFUSED[i].line);
    program_listing(after, sizeof after);
    CHECK_TEXT(after, before);
  }
}

TEST(learn_exits_with_one_when_it_cannot_tell) {
  static const struct {
    const char *line, *message;
  } row[] = {
      {"learn $S/l_flight.csv " VEHICLE " --points $S/l_new.csv --json $S/l_new.json >/dev/full",
       "learn: standard output: cannot be written\n"},
      {"trap '' XFSZ; " PROGRAM_DISK_FULL "learn $S/l_flight.csv " VEHICLE
       " --json $S/l_new.json --points $S/l_new.csv",
       "learn: l_new.csv: cannot be written: File too large\n"},
      {"learn --help >/dev/full", "learn: standard output: cannot be written\n"},
  };
  make_logs();
  char before[4000], after[4000], text[2000];
  program_listing(before, sizeof before);
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].line);
    CHECK(program_run(row[i].line, STREAM_ERROR, text, sizeof text) == 1);
    CHECK_TEXT(text, row[i].message);
    program_listing(after, sizeof after);
    CHECK_TEXT(after, before);
  }
}

TEST(learn_writes_all_that_was_asked_for) {
  char text[4000];
  make_logs();
  CHECK(program_run("learn $S/l_flight.csv " VEHICLE " --points $S/l_p.csv --json $S/l_p.json", STREAM_OUTPUT,
                    text, sizeof text) == 0);
  unsigned taught = 0, lines = 0;
  CHECK(sscanf(text, "# %u samples taught", &taught) == 1 && taught > 3000);
  CHECK(program_run("wc -l <$S/l_p.csv; head -n 1 $S/l_p.csv", STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK(sscanf(text, "%u", &lines) == 1 && lines == taught + 1);
  CHECK(strstr(text, "\ndistance_m,ratio\n") != NULL);
}

// A bad cell costs its row, as in `gap`, and is reported.
TEST(learn_leaves_single_bad_cells_out_and_says_so) {
  static const struct {
    const char *what, *edit, *told;
  } row[] = {
      {"a word", "9s/,1.0000000,0.0000000,/,1.0000000,x,/", "l_bad.csv:9: column stateEstimate.qx"},
      {"no turn", "5s/,1.0000000,0.0000000,/,0.3000000,0.0000000,/", "l_bad.csv:5: column stateEstimate.qw"},
      {"a leap", "3000s/,0.309571,/,309.571,/", "l_bad.csv:3000: column indi.thrust"},
  };
  make_logs();
  char text[4000], line[400];
  unsigned all = 0, taught = 0;
  CHECK(program_run("learn $S/l_flight.csv " VEHICLE, STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK(sscanf(text, "# %u samples taught", &all) == 1 && !strstr(text, "left out"));
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    snprintf(line, sizeof line,
             "sed '%s' $S/l_flight.csv >$S/l_bad.csv; learn $S/l_bad.csv " VEHICLE " --hold-out $S/l_bad.csv",
             row[i].edit);
    CHECK(program_run(line, STREAM_OUTPUT, text, sizeof text) == 0);
    CHECK(sscanf(text, "# %u samples taught", &taught) == 1 && taught <= all && taught > all - 5);
    const char *const first = strstr(text, row[i].told),
                      *again = first ? strstr(first + 1, row[i].told) : NULL;
    CHECK(again &&
          strstr(again, "the first of 1 cells that are no numbers or out of range; they are left out"));
  }
}

TEST(learn_says_where_its_mass_is_from) {
  static const struct {
    const char *arguments, *part;
    double mass_kg;
  } row[] = {
      {"$S/l_flight.csv", "mass 31.9 g (thrust over specific force above 0.2 m)", 0.03195},
      {"$S/l_flight.csv --set indiPos.mass=0.05", "mass 50.0 g (--set)", 0.05},
      {"$S/l_flight.csv --set indiPos.mass=0.02 --set rls.yMax=3", "mass 20.0 g (--set)", 0.02},
      {"$S/l_near.csv", "mass 32.0 g (vehicle file)", 0.032},
      {"$S/l_near.csv --set indiPos.mass=0.04", "mass 40.0 g (--set)", 0.04},
  };
  make_logs();
  char text[4000], line[400];
  // From 40 s on it hovers 6 cm and less below the ceiling, where no mass can be estimated.
  CHECK(program_run("sed 2,4000d $S/l_flight.csv >$S/l_near.csv", STREAM_OUTPUT, text, sizeof text) == 0);
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].arguments);
    snprintf(line, sizeof line, "learn %s " VEHICLE " --json $S/l_mass.json", row[i].arguments);
    CHECK(program_run(line, STREAM_OUTPUT, text, sizeof text) == 0);
    CHECK(strstr(text, row[i].part) != NULL);
    CHECK(program_run("cat $S/l_mass.json", STREAM_OUTPUT, text, sizeof text) == 0);
    cJSON *json = cJSON_Parse(text);
    const cJSON *mass = cJSON_GetObjectItem(json, "mass_kg");
    CHECK_NEAR(cJSON_IsNumber(mass) ? mass->valuedouble : 0.0, row[i].mass_kg, 5e-5);
    cJSON_Delete(json);
  }
}

// The same by the module that the program calls.
static bool learn_here(learn_t *learn, learn_score_t score[2]) {
  static const char *const held_out[] = {"l_flight.csv", "l_high.csv"};
  model_t vehicle;
  learn_job_t job;
  learn_mass_t mass = {0};
  why_t why = {""};
  if (!CHECK_OK(model_read("sim/vehicle/vehicles/thesis_1d.toml", &vehicle, &why))) return false;
  learn_job_init(&job, &vehicle, SURFACE_CEILING);
  CHECK_OK(learn_log_mass(&job, scratch_path("l_flight.csv"), &mass, NULL, &why));
  job.param.pos.mass_kg = job.stands_mass_kg = (float)learn_mass_kg(&mass);
  CHECK_OK(learn_init(learn, &job.param.learn, &job.param.curve.fixed));
  CHECK_OK(learn_log_teach(&job, scratch_path("l_flight.csv"), learn, &why));
  for (int i = 0; i < 2; i++)
    CHECK_OK(learn_log_score(&job, scratch_path(held_out[i]), &learn->rls.theta, &score[i], NULL, &why));
  return CHECK_TEXT(why.text, "");
}

// Checks one held-out flight. gaps: it may lack a number.
static void check_score(const cJSON *item, const learn_score_t *score, const char *flight, bool gaps) {
  const struct {
    const char *key;
    double want; // NaN: null
  } field[] = {
      {"all_mN_before", 1e3 * score->all_before_N},
      {"all_mN_after", 1e3 * score->all_after_N},
      {"below_7cm_mN_before", 1e3 * score->near_before_N},
      {"below_7cm_mN_after", 1e3 * score->near_after_N},
      {"bias_mN", 1e3 * score->bias_N},
  };
  CHECK(cJSON_GetArraySize(item) == 6);
  const cJSON *file = cJSON_GetObjectItem(item, "file");
  CHECK_TEXT(cJSON_IsString(file) ? file->valuestring : "", flight);
  for (unsigned k = 0; k < sizeof field / sizeof *field; k++) {
    ROW("%s, %s", flight, field[k].key);
    const cJSON *value = cJSON_GetObjectItemCaseSensitive(item, field[k].key);
    if (isnan(field[k].want))
      CHECK(cJSON_IsNull(value) && gaps);
    else if (CHECK(cJSON_IsNumber(value)))
      CHECK_NEAR(value->valuedouble, field[k].want, 1e-9);
  }
}

TEST(learn_tells_weights_and_residuals_in_its_json) {
  learn_t learn;
  learn_score_t score[2];
  static char text[8000];
  make_logs();
  if (!learn_here(&learn, score)) return;
  CHECK(program_run("learn $S/l_flight.csv " VEHICLE " --hold-out $S/l_flight.csv --hold-out $S/l_high.csv "
                    "--json $S/l_all.json; cat $S/l_all.json",
                    STREAM_OUTPUT, text, sizeof text) == 0);
  const char *const begin = strchr(text, '{');
  cJSON *json = cJSON_Parse(begin ? begin : "");
  const cJSON *weights = cJSON_GetObjectItem(json, "weights"), *held = cJSON_GetObjectItem(json, "held_out");
  CHECK(cJSON_GetArraySize(weights) == RBF_N);
  for (int i = 0; i < RBF_N && i < cJSON_GetArraySize(weights); i++)
    CHECK_NEAR(cJSON_GetArrayItem(weights, i)->valuedouble, learn.rls.theta.w[i], 1e-9);
  CHECK(cJSON_GetArraySize(held) == 2);
  check_score(cJSON_GetArrayItem(held, 0), &score[0], "l_flight.csv", false);
  check_score(cJSON_GetArrayItem(held, 1), &score[1], "l_high.csv", true);
  CHECK(isnan(score[1].near_before_N) && score[0].near_before_N > 5e-3);
  cJSON_Delete(json);
}
