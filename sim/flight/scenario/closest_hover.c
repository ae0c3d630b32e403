// closest_hover.c - how near a controller can hover: from 7 cm one step to each gap from 30 to 8 mm, 20 s
// there. Shows by flights what a linear analysis says (standard INDI, 8 Hz: 22.8 mm).
#include "flight/scenario.h"

#include "base/constants.h"

#define FROM_M 0.07

static done_t fly_to(setup_t setup, int gap_mm, result_t *result, why_t *why) {
  const double ceiling_m = setup.model.ceiling_m;
  setup.plan.way[0] = (waypoint_t){0.0, ceiling_m - FROM_M};
  setup.plan.way[1] = (waypoint_t){5.0, ceiling_m - 1e-3 * gap_mm};
  setup.plan.n_way = 2;
  setup.plan.end_s = 25.0;
  setup.plan.start_z_m = setup.plan.way[0].setpoint_m;
  setup.plan.start_thrust_N = setup.model.mass_kg * G_MPS2;
  flown_t flown;
  TRY(setup_fly(&setup, &flown, why));
  char label[24];
  snprintf(label, sizeof label, "gap %d mm", gap_mm);
  result_add_segment(result, &flown, 1, label);
  return DONE;
}

static done_t run(const request_t *request, result_t *result, why_t *why) {
  setup_t setup;
  TRY(scenario_appendix_a_setup(&setup, FLY_INDI, why));
  TRY(setup_apply(&setup, request, why));
  for (int gap_mm = 30; gap_mm >= 8; gap_mm--) TRY(fly_to(setup, gap_mm, result, why));
  return DONE;
}

const scenario_t scenario_closest_hover = {
    .name = "closest-hover",
    .brief = "from 7 cm one step to each gap from 30 to 8 mm, 20 s there: which hold",
    .run = run,
};
