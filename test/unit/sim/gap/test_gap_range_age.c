// test_gap_range_age.c - a range sensor's sample is old when it comes: known of the sensor, and no effect.
#include "flight/setup.h"
#include "logs/columns.h"
#include "rig/programs.h"
#include "rig/scratch.h"
#include "rig/test.h"
#include "sense/range.h"

#include <stdio.h>
#include <string.h>

#define STEPS 12

// Up and down below the ceiling, as nothing of the thesis flies: at up to 0.25 m/s.
static void fly_steps(int i, unsigned long seed) {
  setup_t setup;
  flown_t flown;
  why_t why;
  double gap_m[STEPS];
  char name[24];
  request_t request = {
      .seed = seed, .log = true, .log_500_Hz = test_long(), .no_effects = true, .n_effect = 1};
  request.effect[0] = fx_use(fx_find("rotor_drag")); // as the vehicle file has it, and no ceiling effect
  request.effect[0].p[0] = 1.7e-6;
  for (int k = 0; k < STEPS; k++) gap_m[k] = k % 2 ? 0.06 : 0.30;
  if (!CHECK_OK(setup_thesis(&setup, FLY_INDI_THEORY, &why))) return;
  if (!CHECK_OK(setup_apply(&setup, &request, &why))) return;
  setup.flight.bias.pole_radps = 0.0f; // with it the flights show too little of the latency
  setup.flight.guard.blind_max_s = SETUP_BLIND_S;
  setup_ladder(&setup, gap_m, STEPS, 2.0);
  if (!CHECK_OK(setup_fly(&setup, &flown, &why))) return;
  snprintf(name, sizeof name, "age%d.csv", i);
  FILE *const file = fopen(scratch_path(name), "w");
  if (CHECK(file != NULL)) {
    record_write(&flown.record, file);
    CHECK(fclose(file) == 0);
  }
  flown_free(&flown);
}

TEST(gap_takes_the_age_of_a_range_sample_for_no_effect) {
  static const struct {
    const char *columns, *said, *not_said;
  } row[] = {
      {"tools/columns/fly.toml", "Nothing is missing in ", "Missing in"},
      {"$S/young.toml", "Missing in", "Nothing is"}, // where nobody says how old they are, it is an effect
      {"$S/unsaid.toml", "Nothing is missing in ", "Missing in"}, // the vehicle file says it
  };
  char text[6000];
  for (int i = 0; i < (test_long() ? 3 : 1); i++) fly_steps(i, 1 + (unsigned long)i);
  CHECK(program_run("{ echo 'ceiling_m = 0.5'; cat sim/vehicle/vehicles/cf21_legacy.toml; } >$S/age.toml && "
                    "sed 's/, late_ms = 70//' tools/columns/fly.toml >$S/unsaid.toml && "
                    "sed 's/, late_ms = 70/, late_ms = 0/' tools/columns/fly.toml >$S/young.toml",
                    STREAM_OUTPUT, text, sizeof text) == 0);
  for (unsigned i = 0; i < FEW_OR_ALL(row, 2); i++) {
    char line[300];
    ROW("%s", row[i].columns);
    snprintf(line, sizeof line, "gap --vehicle $S/age.toml --columns %s $S/age?.csv", row[i].columns);
    CHECK(program_run(line, STREAM_OUTPUT, text, sizeof text) == 0);
    CHECK(strstr(text, row[i].said) != NULL && !strstr(text, row[i].not_said));
    CHECK((strstr(text, "tof_latency: what the range sensors read") != NULL) == (i == 1));
  }
}

TEST(columns_know_how_old_the_samples_of_the_range_sensors_are) {
  const columns_t own = columns_crazyflie();
  columns_t fly;
  why_t why;
  CHECK_OK(columns_read("tools/columns/fly.toml", &fly, &why));
  CHECK_NEAR(own.of[SIG_RANGE].late_s, 5e-4 * (RANGE_UP_AGE_MIN_MS + RANGE_UP_AGE_MAX_MS), 1e-9);
  CHECK_NEAR(own.of[SIG_RANGE_DOWN].late_s, 1e-3 * RANGE_DOWN_AGE_MS, 1e-9);
  CHECK_NEAR(fly.of[SIG_RANGE].late_s, own.of[SIG_RANGE].late_s, 1e-9);
}
