// appendix_a.c - the thesis's figures A.4 to A.15: take-off to 40 cm, then 43 and 48 cm, under a ceiling at
// 50 cm.
#include "flight/scenario.h"

static done_t run(const request_t *request, result_t *result, why_t *why) {
  setup_t setup;
  TRY(scenario_appendix_a_setup(&setup, FLY_INDI, why));
  TRY(setup_apply(&setup, request, why));
  flown_t flown;
  TRY(setup_fly(&setup, &flown, why));
  result_add_flight(result, &flown);
  return DONE;
}

const scenario_t scenario_appendix_a = {
    .name = "appendix-a",
    .brief = "take-off to 0.40 m, 0.43 m, 0.48 m under a ceiling at 0.50 m (thesis A.4-A.15)",
    .run = run,
};
