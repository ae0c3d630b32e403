// test_gap_judged.c - what the workflow takes back: names that held-out flights contradict, and everything
// where nobody knows what feedback alone would show.
#include "rig/gap_logs.h"
#include "rig/programs.h"
#include "rig/test.h"

#include <string.h>

#define GAP "gap --vehicle $S/room.toml --columns "

static fx_use_t offset(void) {
  fx_use_t use = fx_use(fx_find("cg_offset"));
  use.p[0] = 0.0015;
  use.p[1] = -0.001;
  return use;
}

TEST(gap_withdraws_a_name_that_makes_the_held_out_flight_worse) {
  char text[6000];
  const fx_use_t hidden = offset();
  CHECK(gap_logs_fly("kept", 1, NULL));
  CHECK(gap_logs_fly("fit", 2, &hidden));
  CHECK(program_run(GAP "tools/columns/fly.toml --hold-out $S/fit1.csv $S/fit?.csv", STREAM_OUTPUT, text,
                    sizeof text) == 0);
  CHECK(strstr(text, "Missing in room.toml: cg_offset.\n") && !strstr(text, "withdrawn"));
  CHECK(program_run(GAP "tools/columns/fly.toml --json $S/w.json --hold-out $S/kept0.csv $S/fit?.csv",
                    STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK(strstr(text, "Missing") == NULL);
  CHECK(strstr(text, "note: cg_offset is withdrawn: the fitted flights show it, but it grows turn_") != NULL);
  CHECK(program_run("grep -A2 cg_offset $S/w.json", STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK(strstr(text, "the held-out ones contradict it") != NULL);
}

// The last third is a hover, in which velocities are mostly errors: they grow its residual by 3 to 10 %.
TEST(gap_keeps_a_name_that_a_hover_cannot_contradict) {
  char text[6000];
  fx_use_t drag = fx_use(fx_find("rotor_drag"));
  drag.p[0] = 3e-6;
  CHECK(gap_logs_fly_one("hover.csv", 6, true, &drag));
  CHECK(program_run(GAP "tools/columns/fly.toml $S/hover.csv", STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK(strstr(text, "Missing in room.toml: rotor_drag.\n") == text && !strstr(text, "withdrawn"));
}

TEST(gap_says_that_rates_alone_cannot_tell_however_large_the_gap_is) {
  char text[6000];
  const fx_use_t hidden = offset();
  CHECK(gap_logs_fly("blind", 2, &hidden));
  CHECK(program_run(
            "grep -vE '^(x|y|z|v[xyz]|q[wxyz]|a[xyz]|range)\\b' tools/columns/fly.toml >$S/rates.toml; " GAP
            "$S/rates.toml --json $S/blind.json $S/blind?.csv",
            STREAM_OUTPUT, text, sizeof text) == 0);
  CHECK(strstr(text, "These flights cannot tell what is missing in room.toml.\n") == text);
  CHECK(strstr(text, "turn_x") && strstr(text, "not known"));
  CHECK(program_run("grep -A1 'motor_lag\\|\"verdict\\|\"unknown' $S/blind.json", STREAM_OUTPUT, text,
                    sizeof text) == 0);
  CHECK(strstr(text, "\"none\"") && strstr(text, "what feedback alone would show is not known"));
}
