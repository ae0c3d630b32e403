// ceiling_gap.c - the stock PID between a deck and a ceiling 71 mm apart, as the air garage flew it.
#include "flight/scenario.h"

#include "flight/slot.h"
#include <math.h>

static void tell(result_t *result, const slot_seen_t *seen) {
  cJSON *const row = result_add_row(result, "gap");
  cJSON_AddNumberToObject(row, "captured", seen->captured);
  if (!isnan(seen->median_m)) cJSON_AddNumberToObject(row, "captured_median_mm", 1e3 * seen->median_m);
  cJSON_AddNumberToObject(row, "closest_mm", 1e3 * seen->closest_m);
  if (!isnan(seen->lift_s)) cJSON_AddNumberToObject(row, "lift_s", seen->lift_s);
}

static done_t run(const request_t *request, result_t *result, why_t *why) {
  setup_t setup;
  TRY(slot_setup(&setup, request->seed, true, SLOT_RISE_M, why));
  TRY(setup_apply(&setup, request, why));
  flown_t flown;
  TRY(setup_fly(&setup, &flown, why));
  slot_seen_t seen;
  const done_t status = slot_judge_flight(&flown, &setup.model, &seen, why);
  if (status == DONE) {
    tell(result, &seen);
    result_add_segment(result, &flown, flown.n_segment - 1, "hover");
  }
  flown_free(&flown);
  return status;
}

const scenario_t scenario_ceiling_gap = {
    .name = "ceiling-gap",
    .brief = "the stock PID's hover in a gap of 71 mm, by motion capture (the air garage's, August 2024)",
    .run = run,
};
