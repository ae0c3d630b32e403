// test_flight.c - the thesis's first experiment (section 5.3): hover 20 cm below the ceiling, then 9, 5 and 3
// cm 10 s each, in six degrees of freedom with real sensors.
#include "flight/scenario.h"

static done_t run(const request_t *request, result_t *result, why_t *why) {
  static const double gap_m[] = {0.20, 0.09, 0.05, 0.03};
  setup_t setup;
  TRY(scenario_thesis_setup(&setup, FLY_INDI, request, why));
  setup_ladder(&setup, gap_m, 4, 10.0);
  return scenario_fly(&setup, result, why);
}

const scenario_t scenario_test_flight = {
    .name = "test-flight",
    .brief = "six degrees of freedom, real sensors: gaps of 20, 9, 5 and 3 cm (thesis 5.3)",
    .run = run,
};
