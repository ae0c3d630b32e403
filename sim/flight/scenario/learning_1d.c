// learning_1d.c - the learning flight on the vertical axis: hover 20 cm below the ceiling, then 10 to 2 cm in
// 2 cm steps; the curve is learned on the way from nothing, with the thesis's form and numbers (section 5.3,
// appendix B), and its weights are printed.
#include "flight/scenario.h"

static done_t run(const request_t *request, result_t *result, why_t *why) {
  setup_t setup;
  TRY(scenario_learning_setup(&setup, request, why));
  flown_t flown;
  TRY(setup_fly(&setup, &flown, why));
  if (setup.flight.curve.mode == CURVE_LIVE) result_add_weights(result, &flown.weights);
  result_add_flight(result, &flown);
  return DONE;
}

const scenario_t scenario_learning_1d = {
    .name = "learning-1d",
    .brief = "vertical axis: hover at gaps of 20, 10, 8, 6, 4 and 2 cm with noise N1, learning the curve "
             "(thesis 5.3)",
    .run = run,
};
