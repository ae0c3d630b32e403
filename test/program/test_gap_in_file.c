// test_gap_in_file.c - effects that the vehicle file has, and the flights do not.
#include "rig/programs.h"
#include "rig/test.h"
#include "rig/verdicts.h"

#include <stdio.h>
#include <string.h>

#define VEHICLE "sim/vehicle/vehicles/cf21_legacy.toml" // with a rotor_drag of 1.7e-6 kg
#define ROOM    2000

// Flies two flights without any effect; false: they could not be flown.
static bool fly(const char *scenario, int rate_Hz) {
  char command[ROOM], text[ROOM];
  for (int seed = 1; seed <= 2; seed++) {
    snprintf(command, sizeof command, "fly %s --effect none --seed %d --log $S/in%d.csv --log-rate %d",
             scenario, seed, seed, rate_Hz);
    if (program_run(command, STREAM_OUTPUT, text, sizeof text) != 0) return false;
  }
  return true;
}

static cJSON *diagnose(void) {
  char text[4 * ROOM];
  CHECK(program_run("gap --vehicle " VEHICLE " --json $S/in.json $S/in1.csv $S/in2.csv", STREAM_OUTPUT, text,
                    sizeof text) == 0);
  return verdict_read("in.json");
}

static bool lists(const cJSON *verdict, const char *list, const char *effect) {
  const cJSON *one;
  cJSON_ArrayForEach(one, cJSON_GetObjectItem(verdict, list)) {
    if (strcmp(verdict_string(one, "effect"), effect) == 0) return true;
  }
  return false;
}

// In half of such flights the estimate is, by its errors, below zero. The nominal pilot must be as fast as
// the flight code: with a slow one the vehicle falls over, and what that makes hides the drag. Flown again
// the vehicle stays on its track.
TEST(gap_says_that_the_vehicle_file_has_a_drag_which_flights_have_not) {
  static const int rate_Hz[] = {100, 500};
  for (int i = 0; i < (test_long() ? 2 : 1); i++) {
    ROW("%d Hz", rate_Hz[i]);
    if (!CHECK(fly("inner-loop", rate_Hz[i]))) return;
    cJSON *const verdict = diagnose();
    const cJSON *const effects = cJSON_GetObjectItem(verdict, "effects");
    const cJSON *const drag = cJSON_GetArrayItem(effects, 0);
    const cJSON *const k = cJSON_GetObjectItem(cJSON_GetObjectItem(drag, "parameters"), "k");
    CHECK(cJSON_GetArraySize(effects) == 1);
    CHECK_TEXT(verdict_string(drag, "name"), "rotor_drag");
    CHECK_NEAR(verdict_number(k, "in_file"), 1.7e-6, 1e-12);
    CHECK(verdict_number(k, "value") < 2.0 * verdict_number(k, "stderr"));
    CHECK(verdict_number(cJSON_GetObjectItem(verdict, "resimulation"), "after") <
          0.1); // 0.04; with a slow pilot 1
    cJSON_Delete(verdict);
  }
}

// The answer says so by name, as here, where it says that there is none, or in the list of what the flights
// would show, or of what they cannot.
TEST(gap_says_of_what_the_vehicle_file_has_too_whether_flights_would_show_it) {
  if (!CHECK(fly("test-flight --controller indi-theory", 100))) return;
  cJSON *const verdict = diagnose();
  const cJSON *const effects = cJSON_GetObjectItem(verdict, "effects");
  const bool named = cJSON_GetArraySize(effects) == 1 &&
                     strcmp(verdict_string(cJSON_GetArrayItem(effects, 0), "name"), "rotor_drag") == 0;
  CHECK(named || cJSON_GetArraySize(effects) == 0);
  CHECK(named + lists(verdict, "not_testable", "rotor_drag") + lists(verdict, "would_show", "rotor_drag") ==
        1);
  cJSON_Delete(verdict);
}
