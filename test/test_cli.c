// test_cli.c - the programs as a person meets them: options, bad input, exit status.
#define _POSIX_C_SOURCE 200809L
#include "test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

// Where the programs lie that belong to this build.
static const char *programs(void) {
  const char *dir = getenv("PROGRAMS");
  return dir ? dir : "out";
}

// Runs `PROGRAM ARGUMENTS`, returns the exit status; text gets what was written to standard output or error.
static int run(const char *arguments, const char *stream, char *text, size_t size) {
  char command[1024];
  snprintf(command, sizeof command, "%s/%s %s", programs(), arguments,
           strcmp(stream, "error") == 0 ? "2>&1 >/dev/null" : "2>/dev/null");
  FILE *pipe = popen(command, "r");
  if (!pipe) return -1;
  const size_t n = fread(text, 1, size - 1, pipe);
  text[n] = '\0';
  while (fgetc(pipe) != EOF) continue;
  const int status = pclose(pipe);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(fly_refuses_bad_input_with_one_line_and_status_two) {
  static const struct {
    const char *arguments, *line;
  } row[] = {
      {"fly", "fly: one scenario is needed; fly --list shows them\n"},
      {"fly loop-the-loop", "fly: loop-the-loop: no such scenario; fly --list shows them\n"},
      {"fly appendix-a appendix-a", "fly: one scenario is needed; fly --list shows them\n"},
      {"fly appendix-a --wings",
       "fly: --wings: not an option, or without its value; fly --help lists them\n"},
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
      {"fly appendix-a --set indiPos.kp=-1",
       "fly: --set indiPos.kp=-1: allowed is a number from 0.05 to 20\n"},
      {"fly appendix-a --set indiPos.kp=nan",
       "fly: --set indiPos.kp=nan: allowed is a number from 0.05 to 20\n"},
      {"fly appendix-a --set indiPos.kp=1x",
       "fly: --set indiPos.kp=1x: allowed is a number from 0.05 to 20\n"},
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
      {"fly pid-tables --set indiPos.kp=1", "fly: --set: the flight code does not fly in pid-tables\n"},
      {"fly rls-sweep --controller pid", "fly: --controller pid: knows no ceiling distance to learn from\n"},
      {"fly appendix-a --noise loud",
       "fly: --noise loud: allowed are none, n1, n2, n3 on the vertical axis, quiet, real in six degrees of "
       "freedom\n"},
      {"fly appendix-a --noise real",
       "fly: --noise real: this scenario is flown on the vertical axis; allowed are none, n1, n2, n3\n"},
      {"fly close-flight --noise n1",
       "fly: --noise n1: this scenario is flown in six degrees of freedom; allowed are quiet, real\n"},
      {"fly appendix-a --integrator euler",
       "fly: --integrator euler: allowed are sundials, rk4, reference\n"},
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
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].arguments);
    char text[2000];
    CHECK(run(row[i].arguments, "error", text, sizeof text) == 2);
    CHECK_TEXT(text, row[i].line);
    CHECK(run(row[i].arguments, "output", text, sizeof text) == 2);
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
    CHECK(run(arguments, "error", text, sizeof text) == 2);
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
    CHECK(run(row[i].arguments, "output", text, sizeof text) == 0);
    CHECK(strstr(text, row[i].part) != NULL);
  }
}

TEST(fly_changes_the_plant_and_not_the_controller_by_an_effect) {
  // The controller keeps its own theory: with a weaker plant it is the overestimation of figure A.14 and
  // slower.
  char text[4000];
  CHECK(run("fly appendix-a --controller indi-theory --set indiPos.cutoff=0 --effect ceiling:Ca=0 "
            "--integrator rk4",
            "output", text, sizeof text) == 0);
  const char *last = strstr(text, "0.48");
  double overshoot, peaks, t90 = 0.0;
  if (!CHECK(last && sscanf(last, "0.48 %lf %lf %lf", &overshoot, &peaks, &t90) == 3)) return;
  CHECK(t90 > 4.27);
}

TEST(fly_writes_the_same_flight_for_the_same_seed) {
  char dir[] = "/tmp/fly_test_XXXXXX", arguments[300], text[4000];
  if (!CHECK(mkdtemp(dir) != NULL)) return;
  for (int i = 0; i < 3; i++) {
    snprintf(arguments, sizeof arguments, "fly learning-1d --integrator rk4 --seed %d --log %s/%d.csv",
             i == 2 ? 8 : 7, dir, i);
    CHECK(run(arguments, "output", text, sizeof text) == 0);
  }
  char command[400];
  snprintf(command, sizeof command, "cmp -s %s/0.csv %s/1.csv", dir, dir);
  CHECK(system(command) == 0);
  snprintf(command, sizeof command, "cmp -s %s/0.csv %s/2.csv", dir, dir);
  CHECK(system(command) != 0);
  snprintf(command, sizeof command, "rm -r %s", dir);
  CHECK(system(command) == 0);
}

TEST(fly_writes_the_same_lines_however_the_work_was_cut) {
  static const struct { int from, to; } row[] = {{1, 6}, {1, 3}, {4, 6}};
  char dir[] = "/tmp/fly_test_XXXXXX", arguments[300], command[600];
  static char text[3][4000];
  if (!CHECK(mkdtemp(dir) != NULL)) return;
  for (int i = 0; i < 3; i++) {
    snprintf(arguments, sizeof arguments, "fly close-flight --integrator rk4 --from %d --to %d --json %s/%d",
             row[i].from, row[i].to, dir, i);
    CHECK(run(arguments, "output", text[i], sizeof text[i]) == 0);
  }
  snprintf(command, sizeof command, "cat %s/1 %s/2 | cmp -s - %s/0", dir, dir, dir);
  CHECK(system(command) == 0);
  const size_t first = strlen(text[1]);
  CHECK(strncmp(text[0], text[1], first) == 0);
  CHECK_TEXT(text[0] + first, text[2]);
  snprintf(command, sizeof command, "test $(wc -l <%s/0) = 6 && rm -r %s", dir, dir);
  CHECK(system(command) == 0);
}

TEST(learn_reads_what_fly_writes_of_six_degrees_of_freedom) {
  char dir[] = "/tmp/fly_test_XXXXXX", arguments[300], command[300], text[4000];
  if (!CHECK(mkdtemp(dir) != NULL)) return;
  snprintf(arguments, sizeof arguments, "fly learning-flight --integrator rk4 --log %s/f.csv", dir);
  CHECK(run(arguments, "output", text, sizeof text) == 0);
  CHECK(strstr(text, "ceil.w7") != NULL);
  snprintf(arguments, sizeof arguments, "learn %s/f.csv", dir);
  CHECK(run(arguments, "output", text, sizeof text) == 0);
  CHECK(strstr(text, "ceil.w7 = ") != NULL);
  snprintf(command, sizeof command, "rm -r %s", dir);
  CHECK(system(command) == 0);
}
