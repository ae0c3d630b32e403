// test_gap_times.c - what comes and goes in flight has no name, for effects are looked for as acting all the
// time; but it is told what it acts as.
#include "rig/gap_logs.h"
#include "rig/programs.h"
#include "rig/test.h"

#include <stdio.h>
#include <string.h>

TEST(gap_gives_no_name_to_what_begins_in_flight) {
  static const struct {
    const char *effect, *seen_in, *acts_as;
  } row[] = {
      {"motor_damage:rotor=3,loss=0.12,start=30", " at time 2", // was named thrust_curve
       "s it acts as motor_damage would (rotor 3, loss 0.12: 100 % of what is there more)\n"},
      {"mass:add=-0.0016,start=15,end=35", " at time 1",
       " mass would (add -0.001"}, // ended in a mass below none
      {"mass:add=0.003,start=25", " at time 2", " mass would (add 0.00"},
  };
  char text[6000], line[600];
  CHECK(program_run("{ echo 'ceiling_m = 0.5'; cat sim/vehicle/vehicles/cf21_legacy.toml; } >$S/own.toml",
                    STREAM_OUTPUT, text, sizeof text) == 0);
  for (unsigned i = 0; i < FEW_OR_ALL(row, 1); i++) {
    ROW("%s", row[i].effect);
    snprintf(line, sizeof line,
             "for s in %s; do fly test-flight --controller indi-theory --thesis-law --effect none --effect "
             "rotor_drag:k=1.7e-6 --effect %s --seed $s --log $S/t$s.csv --log-rate %s >/dev/null; done; "
             "gap --vehicle $S/own.toml --columns tools/columns/fly.toml $S/t?.csv",
             test_long() ? "1 2 3" : "2", row[i].effect, test_long() ? "500" : "100");
    CHECK(program_run(line, STREAM_OUTPUT, text, sizeof text) == 0);
    CHECK(strstr(text, "Something is missing in own.toml that cannot be named.\n") != NULL);
    const char *const unknown = strstr(text, "\nunknown: ");
    // A weak motor is seen in yaw as well; what falls with time falls with the voltage.
    CHECK(unknown && (strstr(unknown, "force_z,") || strstr(unknown, "turn_z,")) &&
          strstr(unknown, row[i].seen_in));
    CHECK(unknown && strstr(unknown, row[i].acts_as));
  }
}

// Flights so wild that the nominal ones are as wild: nothing stands out, and still far more is left than
// usual.
TEST(gap_does_not_say_that_nothing_is_missing_where_much_is_left) {
  char text[6000], file[20];
  fx_use_t broken = fx_use(fx_find("motor_damage"));
  broken.p[0] = 1.0;
  broken.p[1] = 0.2;
  broken.p[2] = 8.0;
  for (unsigned long i = 1; i <= 3; i++) {
    snprintf(file, sizeof file, "wild%lu.csv", i);
    CHECK(gap_logs_fly_one(file, i, true, &broken));
  }
  CHECK(program_run("gap --vehicle $S/room.toml --columns tools/columns/fly.toml $S/wild?.csv", STREAM_OUTPUT,
                    text, sizeof text) == 0);
  // The flights are so wild that another compiler's differ: a part of what is left may stand out.
  const bool unknown = strstr(text, "Something is missing in room.toml that cannot be named.\n") != NULL;
  CHECK(unknown || strstr(text, "Nothing can be named that is missing in room.toml, and more is left than "
                                "noise") != NULL);
  CHECK(unknown || strstr(text, "note: force_z: ") != NULL);
}
