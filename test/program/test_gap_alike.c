// test_gap_alike.c - which effect is named where flights cannot tell several apart.
#include "rig/programs.h"
#include "rig/test.h"

#include <string.h>

// The log has only the thrust of all motors. A thrust scale (two forms, by what it does to the torque), a
// mass (one) and a weak rotor (eight) cannot be told apart. The rotor used to be named, and nominal flights
// were flown without three tenths of it.
TEST(gap_names_of_effects_that_leave_the_same_the_one_with_fewest_forms) {
  char text[6000];
  CHECK(program_run(
            "for s in 201 202 203; do fly test-flight --effect mass:add=0.003 --seed $s --log $S/m$s.csv "
            ">/dev/null; done; gap $S/m20?.csv",
            STREAM_OUTPUT, text, sizeof text) == 0);
  const char *const named = strstr(text, "\nMissing in "), *const rivals = strstr(text, "would do as well: ");
  if (!CHECK(named && rivals)) return;
  CHECK(strstr(named, ": thrust_scale, ") || strstr(named, ": mass, "));
  const char *const end = strchr(rivals, ';');
  const char *const rotor = strstr(rivals, "motor_damage");
  CHECK(rotor && end && rotor < end);
}
