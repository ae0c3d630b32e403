// test_made.c - how a file was made: version, command line, date, seed and rows.
#define _POSIX_C_SOURCE 200809L // setenv
#include "base/made.h"
#include "base/version.h"
#include "rig/programs.h"
#include "rig/scratch.h"
#include "rig/test.h"
#include "rig/verdicts.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

TEST(made_quotes_a_command_as_a_shell_reads_it) {
  static const struct {
    const char *word, *quoted;
  } row[] = {
      {"--set", "--set"},
      {"indiPos.kp=1.5", "indiPos.kp=1.5"},
      {"", "''"},
      {"two words", "'two words'"},
      {"don't", "'don'\\''t'"},
      {"$S/*.csv", "'$S/*.csv'"},
      {"a\nb", "'a\nb'"},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].word);
    char word[40], *argv[] = {"out/fly", word}, want[80];
    snprintf(word, sizeof word, "%s", row[i].word);
    made_t made = made_by("fly", 2, argv);
    snprintf(want, sizeof want, "fly %s", row[i].quoted);
    CHECK_TEXT(made.command, want);
    made_free(&made);
  }
}

TEST(made_takes_the_date_that_a_build_sets) {
  static const struct {
    const char *epoch, *date; // null: now
  } row[] = {
      {"0", "1970-01-01T00:00:00Z"},
      {"1700000000", "2023-11-14T22:13:20Z"},
      {"253402300799", "9999-12-31T23:59:59Z"},
      {"253402300800", NULL},
      {"-1", NULL},
      {"soon", NULL},
      {"", NULL},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].epoch);
    setenv("SOURCE_DATE_EPOCH", row[i].epoch, 1);
    made_t made = made_by("fly", 0, NULL);
    if (row[i].date)
      CHECK_TEXT(made.date, row[i].date);
    else
      CHECK(strlen(made.date) == 20 && strcmp(made.date, "2026") > 0 && strcmp(made.date, "2200") < 0);
    made_free(&made);
  }
  unsetenv("SOURCE_DATE_EPOCH");
}

TEST(made_comments_in_letters_that_any_file_takes) {
  char *argv[] = {"gap", "a\nmass_kg = 1", "\xff"}, text[300] = "";
  made_t made = made_by("gap", 3, argv);
  FILE *const file = fopen(scratch_path("comment"), "w+");
  if (!CHECK(file != NULL)) return;
  made_comment(&made, file);
  rewind(file);
  text[fread(text, 1, sizeof text - 1, file)] = '\0';
  fclose(file);
  const char *const second = strchr(text, '\n') + 1;
  CHECK(strncmp(text, "# made by gap ", 14) == 0);
  CHECK_TEXT(second, "# gap 'a?mass_kg = 1' '?'\n");
  made_free(&made);
}

TEST(every_program_says_its_version) {
  static const char *const program[] = {"fly", "learn", "effectiveness", "gap"};
  for (unsigned i = 0; i < sizeof program / sizeof *program; i++) {
    ROW("%s", program[i]);
    char line[80], text[200], want[200];
    snprintf(line, sizeof line, "%s --version", program[i]);
    snprintf(want, sizeof want, "%s %s\n", program[i], version_text);
    CHECK(program_run(line, STREAM_OUTPUT, text, sizeof text) == 0);
    CHECK_TEXT(text, want);
  }
  CHECK(strstr(version_text, " (commit ") != NULL);
}

// The tree's version in a copy: with git, of git's archive, and of neither.
TEST(version_is_of_this_tree_or_not_known) {
  static const struct {
    const char *what, *shell, *want;
  } row[] = {
      {"a plain copy", "true", "9.8.7 (commit not known)"},
      {"an archive by git", "echo 0123456789ab >.doc/commit", "9.8.7 (commit 0123456789ab)"},
      {"inside another repository", "git init -q .. && printf '$Format:%%h$' >.doc/commit",
       "9.8.7 (commit not known)"},
      {"no changelog", "rm .doc/CHANGELOG.md", "0 (commit not known)"},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    char line[800], text[200], want[200];
    snprintf(line, sizeof line,
             "d=$S/up/v; here=$PWD; rm -rf $S/up; mkdir -p $d/.doc; cd $d; echo '## 9.8.7' "
             ">.doc/CHANGELOG.md; %s; "
             "$here/tools/version.sh o/version.c; tail -n 1 o/version.c",
             row[i].shell);
    snprintf(want, sizeof want, "const char version_text[] = \"%s\";\n", row[i].want);
    CHECK(program_run(line, STREAM_OUTPUT, text, sizeof text) == 0);
    CHECK_TEXT(text, want);
  }
  char text[200];
  CHECK(program_run("cd $S/up/v; t=$(stat -c %y o/version.c); sleep 0.05; v=$(readlink -f o/version.c); "
                    "$OLDPWD/tools/version.sh o/version.c; [ \"$t\" = \"$(stat -c %y $v)\" ]",
                    STREAM_OUTPUT, text, sizeof text) == 0);
}

static void check_made(const cJSON *json, const char *program, const char *command, double seed,
                       double rows) {
  const cJSON *const made = cJSON_GetObjectItem(json, "made");
  char by[200];
  snprintf(by, sizeof by, "%s %s", program, version_text);
  CHECK_TEXT(verdict_string(made, "by"), by);
  CHECK_TEXT(verdict_string(made, "date"), "2023-11-14T22:13:20Z");
  CHECK(strncmp(verdict_string(made, "command"), command, strlen(command)) == 0);
  if (isnan(seed))
    CHECK(cJSON_IsNull(cJSON_GetObjectItem(made, "seed")));
  else
    CHECK_NEAR(verdict_number(made, "seed"), seed, 0.0);
  if (rows > 0.0)
    CHECK_NEAR(verdict_number(made, "rows"), rows, 0.0);
  else
    CHECK(verdict_number(made, "rows") > 100.0);
}

TEST(what_the_programs_write_says_how_it_was_made) {
  static const struct {
    const char *program, *arguments;
    double seed, rows; // 0: more than a hundred
  } row[] = {
      {"fly", "learning-1d --integrator rk4 --seed 7 --log $S/m.csv", 7.0, 0.0},
      {"fly", "learning-1d --integrator rk4 --seed 3 --seeds 2", 3.0, 0.0},
      {"learn", "$S/m.csv", (double)NAN, 0.0},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s %s", row[i].program, row[i].arguments);
    char line[400], text[4000], command[20];
    snprintf(line, sizeof line, "SOURCE_DATE_EPOCH=1700000000 %s --json $S/made.json %s", row[i].program,
             row[i].arguments);
    CHECK(program_run(line, STREAM_OUTPUT, text, sizeof text) == 0);
    cJSON *const json = verdict_read("made.json");
    snprintf(command, sizeof command, "%s --json ", row[i].program);
    check_made(json, row[i].program, command, row[i].seed, row[i].rows);
    cJSON_Delete(json);
  }
}

TEST(a_line_of_many_flights_says_what_flies_it_alone) {
  char text[4000], line[600];
  CHECK(program_run("SOURCE_DATE_EPOCH=1700000000 fly close-flight --integrator rk4 --from 4 --to 5 --json "
                    "$S/made.json; "
                    "sed -i 1d $S/made.json",
                    STREAM_OUTPUT, text, sizeof text) == 0);
  cJSON *const json = verdict_read("made.json");
  check_made(json, "fly", "fly --integrator rk4 close-flight --seed 5", 5.0, 0.0);
  snprintf(line, sizeof line, "%s --json $S/alone.json",
           verdict_string(cJSON_GetObjectItem(json, "made"), "command"));
  CHECK(program_run(line, STREAM_OUTPUT, text, sizeof text) == 0);
  cJSON *const alone = verdict_read("alone.json");
  CHECK(cJSON_Compare(cJSON_GetObjectItem(json, "segments"), cJSON_GetObjectItem(alone, "segments"), true));
  cJSON_Delete(json);
  cJSON_Delete(alone);
}
