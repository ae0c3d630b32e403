// learning_flight.c - the thesis's learning flight (section 5.3) in six degrees of freedom with real sensors:
// 20 cm below the ceiling, then 10 to 2 cm in 2 cm steps, 10 s each; the curve is learned on the way from
// nothing, and its weights are printed. `indi-learned` flies this first, with the same seed, and then with
// the weights frozen.
#include "flight/scenario.h"

static done_t run(const request_t *request, result_t *result, why_t *why) {
  setup_t setup;
  TRY(scenario_thesis_setup(&setup, FLY_INDI_LIVE, request, why));
  if (setup.flight.curve.mode != CURVE_LIVE)
    return error_set(why,
                     "--controller, --set ceil.mode: nothing learns then; allowed in learning-flight are "
                     "neither, and ceil.mode=2");
  setup_close_ladder(&setup);
  flown_t flown;
  TRY(setup_fly(&setup, &flown, why));
  result_add_weights(result, &flown.weights);
  result_add_flight(result, &flown);
  return DONE;
}

const scenario_t scenario_learning_flight = {
    .name = "learning-flight",
    .brief = "six degrees of freedom: 20, 10, 8, 6, 4 and 2 cm, learning the curve on the way (thesis 5.3)",
    .run = run,
};
