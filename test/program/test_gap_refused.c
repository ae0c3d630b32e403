// test_gap_refused.c - the workflow's program and what it cannot use: one line, status 2, `refused`, and no
// file harmed.
#include "rig/flight_csv.h"
#include "rig/gap_logs.h"
#include "rig/programs.h"
#include "rig/scratch.h"
#include "rig/test.h"
#include "rig/verdicts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void write_logs(void) {
  char *const text = malloc(1u << 20);
  if (!text) abort();
  flight_csv_write(&(flight_csv_t){.rows = 500}, text, 1u << 20);
  scratch_file("a.csv", text, -1);
  scratch_file("b.csv", text, -1);
  // A cell in line 101 that is no number, and 30 more after it.
  char *at = text;
  for (int line = 1; line < 131; line++) {
    at = strchr(at, '\n') + 1;
    if (line >= 100) *strchr(at, ',') = ';';
  }
  scratch_file("bad.csv", text, -1);
  scratch_file("vehicle.toml", "name = \"x\"\nmass_kg = -1\n", -1);
  scratch_file("columns.toml", "[columns]\ntime = {column = \"t\", unit = \"fortnight\"}\n", -1);
  free(text);
}

// The line, without `gap: `.
static const struct {
  const char *arguments, *line;
} REFUSED[] = {
    {"$S/none.csv", "none.csv: cannot be opened: No such file or directory"},
    {"$S/bad.csv", "bad.csv:101: "},
    {"$S/a.csv $S/a.csv", "a.csv: given twice; allowed: once"},
    {"$S/a.csv $S/../$(basename $S)/a.csv", "/a.csv: given twice; allowed: once"},
    {"--hold-out $S/a.csv --hold-out $S/a.csv $S/b.csv", "--hold-out a.csv: given twice; allowed: once"},
    {"--hold-out $S/a.csv $S/a.csv", "every log is held out; allowed: one LOG or more to fit to"},
    {"--vehicle $S/none.toml $S/a.csv", "none.toml: cannot be opened: No such file or directory"},
    {"--vehicle $S/vehicle.toml $S/a.csv", "vehicle.toml:2: mass_kg: "},
    {"--columns $S/columns.toml $S/a.csv", "columns.toml:2: "},
};

// The verdict also gives the message's file and line separately.
static void check_where(const cJSON *refused, const char *line) {
  const char *const file = verdict_string(refused, "file"), *const name = strrchr(file, '/');
  const double at = verdict_number(refused, "line");
  char text[300] = "";
  if (file[0] && isfinite(at))
    snprintf(text, sizeof text, "%s:%.0f: ", name ? name + 1 : file, at);
  else if (file[0])
    snprintf(text, sizeof text, "%s: ", name ? name + 1 : file);
  CHECK(strstr(line, text));
  CHECK((file[0] != 0) == (strncmp(line, "every log", 9) != 0));
  CHECK(isfinite(at) == (strstr(line, ":2: ") || strstr(line, ":101: ")));
}

TEST(gap_refuses_with_one_line_status_two_and_a_verdict_that_says_where) {
  write_logs();
  for (unsigned i = 0; i < sizeof REFUSED / sizeof *REFUSED; i++) {
    ROW("%s", REFUSED[i].arguments);
    char line[600], text[2000], json[4000];
    snprintf(line, sizeof line, "rm -rf $S/o; gap --out $S/o %s", REFUSED[i].arguments);
    CHECK(program_run(line, STREAM_ERROR, text, sizeof text) == 2);
    CHECK(strncmp(text, "gap: ", 5) == 0 && strchr(text, '\n') == text + strlen(text) - 1);
    if (!strstr(text, REFUSED[i].line)) CHECK_TEXT(text, REFUSED[i].line);
    CHECK(program_run("cat $S/o/verdict.json", STREAM_OUTPUT, json, sizeof json) == 0);
    cJSON *const v = cJSON_Parse(json);
    const cJSON *const said = cJSON_GetArrayItem(cJSON_GetObjectItem(v, "warnings"), 0);
    CHECK(cJSON_IsString(said) && strncmp(text + 5, said->valuestring, strlen(said->valuestring)) == 0);
    const cJSON *const verdict = cJSON_GetObjectItem(v, "verdict");
    CHECK_TEXT(cJSON_IsString(verdict) ? verdict->valuestring : "", "refused");
    verdict_check(v);
    check_where(cJSON_GetObjectItem(v, "refused"), REFUSED[i].line);
    const cJSON *const made = cJSON_GetObjectItem(v, "made");
    CHECK(strncmp(cJSON_GetStringValue(cJSON_GetObjectItem(made, "command")), "gap --out ", 10) == 0);
    cJSON_Delete(v);
    CHECK(program_run("ls -A $S/o", STREAM_OUTPUT, text, sizeof text) == 0);
    CHECK_TEXT(text, "report.html\nverdict.json\n");
  }
}

// Refused before anything is read: there is no folder to write a verdict to, or it must not be touched.
static const struct {
  const char *arguments, *line;
} AT_ONCE[] = {
    {"", "gap: no log; allowed: gap [options] LOG...\n"},
    {"--wings $S/a.csv", "gap: --wings: not an option; allowed: --vehicle, --columns, --hold-out, --out, "
                         "--json, --seed, --help, --version\n"},
    {"--hold_out $S/a.csv", "gap: --hold_out: not an option (did you mean --hold-out?); allowed: --vehicle, "
                            "--columns, --hold-out, --out, "
                            "--json, --seed, --help, --version\n"},
    {"--seed -1 $S/a.csv", "gap: --seed -1: allowed is a whole number from 0 to 1000000000\n"},
    {"--seed 1.5 $S/a.csv", "gap: --seed 1.5: allowed is a whole number from 0 to 1000000000\n"},
    {"--out $S/a.csv $S/b.csv", "gap: --out a.csv: not a folder\n"},
    {"--out $S/a.csv/no/such $S/b.csv", "gap: --out a.csv: not a folder\n"},
    {"--json $S/b.csv $S/b.csv", "gap: b.csv: to be read and to be written; allowed: one of them\n"},
    {"--json $S/b.csv --hold-out $S/b.csv $S/a.csv",
     "gap: b.csv: to be read and to be written; allowed: one of them\n"},
};

TEST(gap_refuses_at_once_what_it_is_told_wrongly_and_writes_nothing) {
  char before[2000], after[2000];
  write_logs();
  program_listing(before, sizeof before);
  for (unsigned i = 0; i < sizeof AT_ONCE / sizeof *AT_ONCE; i++) {
    ROW("%s", AT_ONCE[i].arguments);
    char line[600], text[2000];
    snprintf(line, sizeof line, "gap %s", AT_ONCE[i].arguments);
    CHECK(program_run(line, STREAM_ERROR, text, sizeof text) == 2);
    CHECK_TEXT(text, AT_ONCE[i].line);
    CHECK(program_run(line, STREAM_OUTPUT, text, sizeof text) == 2);
    CHECK_TEXT(text, "");
    program_listing(after, sizeof after);
    CHECK_TEXT(after, before);
  }
}

TEST(gap_escapes_what_it_is_told_in_its_page) {
  char text[4000];
  CHECK(program_run("gap --out $S/o '$S/<i>&\"x\".csv'", STREAM_ERROR, text, sizeof text) == 2);
  CHECK(program_run("tail -n 5 $S/o/report.html", STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK(strstr(text, "&lt;i&gt;&amp;&quot;x&quot;.csv: cannot be opened") && !strstr(text, "<i>"));
}

TEST(gap_removes_its_own_model_beside_a_refusal_and_nothing_else) {
  char text[2000];
  write_logs();
  CHECK(program_run(
            "rm -rf $S/o; mkdir $S/o; echo mine >$S/o/notes; echo '# Written by gap: x' >$S/o/model.toml; "
            "gap --out $S/o $S/bad.csv",
            STREAM_OUTPUT, text, sizeof text) == 2);
  CHECK(program_run("ls -A $S/o", STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK_TEXT(text, "notes\nreport.html\nverdict.json\n");
  CHECK(program_run("echo 'name = 1' >$S/o/model.toml; gap --out $S/o $S/bad.csv", STREAM_OUTPUT, text,
                    sizeof text) == 2);
  CHECK(program_run("cat $S/o/model.toml", STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK_TEXT(text, "name = 1\n");
}

TEST(gap_refuses_motors_whose_order_turns_the_vehicle_the_other_way) {
  char text[4000];
  CHECK(gap_logs_fly("o", 1, NULL));
  CHECK(program_run("sed -e 's/indi.m1/indi.mX/' -e 's/indi.m2/indi.m1/' -e 's/indi.mX/indi.m2/' -e "
                    "'s/indi.m3/indi.mX/' -e 's/indi.m4/indi.m3/' -e 's/indi.mX/indi.m4/' "
                    "tools/columns/fly.toml >$S/order.toml; gap --vehicle $S/room.toml "
                    "--columns $S/order.toml $S/o0.csv",
                    STREAM_ERROR, text, sizeof text) == 2);
  CHECK(strstr(text, "o0.csv: turn_y goes against what the motor commands say") != NULL);
}

// With some motors exchanged, two of the three moments cancel, and none is reversed.
TEST(gap_refuses_motors_of_which_some_are_exchanged) {
  static const struct {
    const char *sed, *order, *column;
    int every; // one of so many rows of 500 Hz
  } row[] = {
      {"s/indi.m1/X/; s/indi.m2/indi.m1/; s/X/indi.m2/", "2, 1, 3 and 4", "indi.m1", 1},
      {"s/indi.m1/X/; s/indi.m3/indi.m1/; s/X/indi.m3/", "3, 2, 1 and 4", "indi.m1", 1},
      {"s/indi.m3/X/; s/indi.m4/indi.m3/; s/X/indi.m4/", "1, 2, 4 and 3", "indi.m3", 1},
      {"s/indi.m1/X/; s/indi.m2/indi.m1/; s/X/indi.m2/", "2, 1, 3 and 4", "indi.m1", 10},
      {"s/indi.m1/X/; s/indi.m3/indi.m1/; s/X/indi.m3/", "3, 2, 1 and 4", "indi.m1", 10},
      {"s/indi.m2/X/; s/indi.m4/indi.m2/; s/X/indi.m4/", "1, 4, 3 and 2", "indi.m2", 10},
      // what motor 1 did is called m2, motor 2's m3, motor 3's m1
      {"s/indi.m1/X/; s/indi.m2/Y/; s/indi.m3/indi.m1/; s/X/indi.m2/; s/Y/indi.m3/", "3, 1, 2 and 4",
       "indi.m1", 1},
      {"s/indi.m1/X/; s/indi.m2/Y/; s/indi.m3/indi.m1/; s/X/indi.m2/; s/Y/indi.m3/", "3, 1, 2 and 4",
       "indi.m1", 10},
  };
  CHECK(gap_logs_fly("x", 1, NULL));
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s, every row of %d", row[i].order, row[i].every);
    char line[400], text[4000], told[150];
    snprintf(line, sizeof line,
             "head -n 1 $S/x0.csv | sed '%s' >$S/e.csv; tail -n +2 $S/x0.csv | sed -n '1~%dp' >>$S/e.csv; "
             "gap --vehicle "
             "$S/room.toml --columns tools/columns/fly.toml $S/e.csv",
             row[i].sed, row[i].every);
    CHECK(program_run(line, STREAM_ERROR, text, sizeof text) == 2);
    snprintf(told, sizeof told,
             "e.csv: column %s: the rates contradict the motor commands, and follow them if m1 to m4 are "
             "motors %s",
             row[i].column, row[i].order);
    CHECK(strstr(text, told) != NULL);
  }
}
