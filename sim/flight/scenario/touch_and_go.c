// touch_and_go.c - touching a ceiling on purpose: from 6 cm below it to its height and back, three times, in
// six degrees of freedom with real sensors. The top of the body touches 8 mm before the propellers are there.
// A set point beyond the ceiling would be flown 6 mm below it (OUTER_CLIP_M), which presses too little where
// the range sensors are wrong. A segment's overshoot after a touch is how far the vehicle fell below its set
// point.
#include "flight/scenario.h"

#define HOLD_S 5.0

static done_t run(const request_t *request, result_t *result, why_t *why) {
  static const double gap_m[] = {0.20, 0.06, 0.0, 0.06, 0.0, 0.06, 0.0, 0.06};
  setup_t setup;
  TRY(setup_thesis(&setup, FLY_INDI_RBF, why));
  setup.flight.gap_min_m = 0.0f;
  setup.flight.guard.blind_max_s = SETUP_BLIND_S;
  TRY(setup_apply(&setup, request, why));
  TRY(scenario_check_ladder(&setup.model, why));
  setup_ladder(&setup, gap_m, (int)(sizeof gap_m / sizeof *gap_m), HOLD_S);
  return scenario_fly(&setup, result, why);
}

const scenario_t scenario_touch_and_go = {
    .name = "touch-and-go",
    .brief = "six degrees of freedom, real sensors: from 6 cm up to a ceiling, 5 s against it, and back, "
             "three times",
    .run = run,
};
