// test_cli_not_finite.c - a flight that is no longer finite: what is written, and the exit status.
#include "rig/programs.h"
#include "rig/test.h"

#include <stdio.h>

TEST(fly_tells_of_a_flight_that_is_not_finite_and_ends_with_one) {
  static const char *const how[] = {"--json $S/nf", "--integrator rk4 --json $S/nf",
                                    "--from 1 --to 1 --json $S/nf", "--seeds 1 --json $S/nf"};
  for (unsigned i = 0; i < sizeof how / sizeof *how; i++) {
    ROW("%s", how[i]);
    char line[200], text[4000];
    snprintf(line, sizeof line, "rm -f $S/nf; fly close-flight --effect gyroscopic:k=0.001 %s", how[i]);
    CHECK(program_run(line, STREAM_ERROR, text, sizeof text) == 1);
    CHECK_TEXT(text, "fly: not finite: 1 of the flights\n"); // and no messages of the solver
    CHECK(program_run("grep -q '\"finite\":[[:space:]]*false' $S/nf", STREAM_OUTPUT, text, sizeof text) == 0);
  }
}
