// close_flight.c - the thesis's second experiment (section 5.3): hover 20 cm below the ceiling, then 10 to 2
// cm in 2 cm steps, 10 s each, in six degrees of freedom with real sensors.
#include "flight/scenario.h"

static done_t run(const request_t *request, result_t *result, why_t *why) {
  setup_t setup;
  TRY(scenario_thesis_setup(&setup, FLY_INDI, request, why));
  setup_close_ladder(&setup);
  return scenario_fly(&setup, result, why);
}

const scenario_t scenario_close_flight = {
    .name = "close-flight",
    .brief = "six degrees of freedom, real sensors: gaps of 20, 10, 8, 6, 4 and 2 cm (thesis 5.3)",
    .run = run,
};
