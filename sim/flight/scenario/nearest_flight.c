// nearest_flight.c - how near a vehicle can be flown: 20, 10, 6 and 4 cm below the ceiling, then 20 to 12 mm
// in steps of 2 and 1 mm, 10 s each, in six degrees of freedom with real sensors. The top of the body is 8 mm
// above the propellers.
#include "flight/scenario.h"

static done_t run(const request_t *request, result_t *result, why_t *why) {
  static const double gap_m[] = {0.20, 0.10, 0.06, 0.04, 0.020, 0.018, 0.016, 0.015, 0.014, 0.013, 0.012};
  setup_t setup;
  TRY(setup_thesis(&setup, FLY_INDI_RBF, why));
  setup.flight.gap_min_m = 0.01f;
  setup.flight.guard.blind_max_s = 2.0f * SETUP_BLIND_S;
  TRY(setup_apply(&setup, request, why));
  TRY(scenario_check_ladder(&setup.model, why));
  setup_ladder(&setup, gap_m, (int)(sizeof gap_m / sizeof *gap_m), 10.0);
  return scenario_fly(&setup, result, why);
}

const scenario_t scenario_nearest_flight = {
    .name = "nearest-flight",
    .brief =
        "six degrees of freedom, real sensors: gaps of 10, 6, 4 cm, then 20 to 12 mm in steps of 2 and 1",
    .run = run,
};
