// test_cli_replay.c - replays a flight's logged inputs through the flight code.
#include "rig/programs.h"
#include "rig/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FLY "fly inner-loop --integrator rk4 --log $S/calls.csv --log-rate 1000 --params-to $S/flown.txt"

TEST(replay_commands_what_was_logged_to_the_bit) {
  static const char *const flight[] = {("fly learning-flight --integrator rk4 --log $S/calls.csv --log-rate "
                                        "1000 --params-to $S/flown.txt"),
                                       FLY " --set indiPos.kp=1.5 --set rls.q=2e-6 --controller indi", FLY};
  for (unsigned i = 0; i < FEW_OR_ALL(flight, 1); i++) {
    ROW("%s", flight[i]);
    char text[400], shell[600];
    snprintf(shell, sizeof shell, "%s >/dev/null && fly --replay $S/calls.csv --set-from $S/flown.txt",
             flight[i]);
    CHECK(program_run(shell, STREAM_OUTPUT, text, sizeof text) == 0);
    CHECK(strtol(text, NULL, 10) > 20000);
    CHECK(
        strstr(text,
               " calls replayed, 0 between them left out, 0 differ in a motor's command, by 0 N at most\n") !=
        NULL);
  }
}

// Long: replays a whole flight, else its first 6 s.
TEST(replay_sees_another_parameter_and_a_call_that_was_changed) {
  char text[400], shell[400];
  snprintf(shell, sizeof shell,
           FLY " >/dev/null && head -n %s $S/calls.csv >$S/few.csv && fly --replay $S/few.csv "
               "--set-from $S/flown.txt --set indiAtt.kp=5.5",
           test_long() ? "-0" : "6001");
  CHECK(program_run(shell, STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK(strstr(text, "; the first in line ") != NULL);
  CHECK(program_run("awk 'NR != 5000' $S/few.csv >$S/less.csv && "
                    "fly --replay $S/less.csv --set-from $S/flown.txt",
                    STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK(strstr(text, "1 between them left out") != NULL);
  // One cell of one call: line 3003, step 3001, one of the inner loop.
  CHECK(program_run("awk -F, -v OFS=, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == \"indiIn.p\") p = i } "
                    "NR == 3003 { $p += 1e-3 } 1' $S/few.csv >$S/other.csv && "
                    "fly --replay $S/other.csv --set-from $S/flown.txt",
                    STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK(strstr(text, "; the first in line 3003\n") != NULL);
}

TEST(replay_refuses_what_it_cannot_play) {
  static const struct {
    const char *shell, *line;
  } row[] = {
      {"fly learning-1d --log $S/l.csv >/dev/null && fly --replay $S/l.csv",
       "missing; fly --log-rate 1000 writes it"},
      {"fly --replay $S/none.csv", "none.csv"},
      {"fly close-flight --replay $S/l.csv", "--replay: no scenario is flown; leave out close-flight\n"},
      {"echo indiPos.kp=1e9 >$S/p.txt; fly --replay $S/l.csv --set-from $S/p.txt",
       "p.txt:1: --set indiPos.kp=1e9: allowed is a number from 0.05 to 20\n"},
      {"fly --replay $S/l.csv --set-from $S/none.txt", "none.txt: cannot be read\n"},
      // Too large for a float: line 4's command of motor 2.
      {FLY
       " >/dev/null; awk -F, -v OFS=, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == \"indi.m2\") m = i } "
       "NR == 4 { $m = \"1e300\" } 1' $S/calls.csv >$S/huge.csv; fly --replay $S/huge.csv",
       "huge.csv:4: column indi.m2: 1e+300 N is not plausible; allowed: -200 to 200 N\n"},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    char text[600];
    ROW("%s", row[i].shell);
    CHECK(program_run(row[i].shell, STREAM_ERROR, text, sizeof text) == 2);
    CHECK(strstr(text, row[i].line) != NULL);
  }
}
