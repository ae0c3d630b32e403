// test_gap_errors.c - what stands behind a number: the truth lies within it.
#include "gap_case.h"
#include "programs.h"
#include "test.h"

#include <stdio.h>
#include <stdlib.h>

TEST(gap_gives_errors_that_hold_what_was_hidden) {
  static const struct {
    const char *name;
    double value;
  } row[] = {
      {"delay", 0.010},      {"motor_lag", 0.025}, {"tof_latency", 0.025},
      {"tof_latency", 0.06}, {"flapping", 1.3e-8}, {"climb_inflow", 3e-6},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s %g", row[i].name, row[i].value);
    const gap_hidden_t hidden = {1, {gap_effect(row[i].name, row[i].value, 0.0)}};
    gap_case_t *const c = gap_case(&hidden, &hidden);
    const named_t *const named = gap_case_named(c, row[i].name);
    if (CHECK(named)) {
      CHECK_NEAR(named->value[0], row[i].value, 2.0 * named->stderr_[0]);
      CHECK(named->stderr_[0] < 0.5 * row[i].value); // it is no wild guess either
    }
    gap_case_free(c);
  }
}

// The gyro's filter and the hold of a command are late, too, and no log tells how much.
TEST(gap_gives_errors_that_hold_the_lateness_of_instruments) {
  static const struct {
    const char *name, *effect;
    double value;
  } row[] = {{"delay", "delay:add=0.01", 0.01}, {"motor_lag", "motor_lag:add=0.025", 0.025}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].effect);
    char line[600], text[200];
    double value = 0.0, stderr_ = 0.0;
    snprintf(
        line, sizeof line,
        "(echo 'ceiling_m = 0.5'; cat sim/vehicles/cf21_legacy.toml) >$S/vehicle.toml; for k in 1 2 3; do "
        "fly test-flight --controller indi-theory --effect none --effect rotor_drag:k=1.7e-6 --effect %s "
        "--seed $k --log $S/late$k.csv --log-rate 500; done >$S/fly.txt; gap --vehicle $S/vehicle.toml "
        "--columns tools/columns/fly.toml --json $S/late.json $S/late?.csv >$S/gap.txt; "
        "grep -A6 '\"name\".*%s' $S/late.json | tr -dc 'a-z0-9.:,e\n-' | sed -n 's/^value:\\|^stderr://p'",
        row[i].effect, row[i].name);
    CHECK(program_run(line, STREAM_OUTPUT, text, sizeof text) == 0);
    CHECK(sscanf(text, "%lf,%lf", &value, &stderr_) == 2);
    CHECK_NEAR(value, row[i].value, 2.0 * stderr_);
  }
}

// A wind that blew in the fitted flights alone would else go into the accelerometer's bias.
TEST(gap_keeps_the_values_of_the_others_when_it_withdraws_a_name) {
  const fx_use_t bias = gap_effect("accel_bias", 0.3, 0.0), wind = gap_effect("wind", 0.006, 0.0);
  const gap_hidden_t fit = {2, {bias, wind}}, held = {1, {bias}};
  gap_case_t *const c = gap_case(&fit, &held);
  const named_t *const named = gap_case_named(c, "accel_bias");
  CHECK(c->d.n_withdrawn == 1 && c->d.withdrawn[0].fx == fx_find("wind"));
  if (CHECK(named)) CHECK_NEAR(named->value[0], 0.3, 3.0 * named->stderr_[0]);
  gap_case_free(c);
}
