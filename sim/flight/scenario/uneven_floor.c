// uneven_floor.c - take-off to 0.4 m from a floor that rises by 5 degrees, a hover, and half a metre aside.
#include "flight/scenario.h"

#include <math.h>

#define RISE    0.087488663525924 // tan 5 deg
#define HOVER_M 0.4
#define ASIDE_M 0.5

static void aside(void *context, const body_t *truth, pilot_in_t *in) {
  (void)context;
  if (truth->t_s >= 10.0) in->set.pos_w_m.x = ASIDE_M;
}

static done_t run(const request_t *request, result_t *result, why_t *why) {
  setup_t setup;
  TRY(setup_thesis(&setup, FLY_INDI, why));
  setup.model.ceiling_m = HUGE_VAL;
  setup.model.n_fx = 0;
  setup.model.floor_rise_x = RISE;
  TRY(setup_apply(&setup, request, why));
  setup.plan.take_off_s = 3.0;
  setup.plan.edit = aside;
  setup.plan.way[0] = (waypoint_t){0.0, HOVER_M};
  setup.plan.n_way = 1;
  setup.plan.end_s = 20.0;
  return scenario_fly(&setup, result, why);
}

const scenario_t scenario_uneven_floor = {
    .name = "uneven-floor",
    .brief = "six degrees of freedom: take-off from a floor that rises by 5 degrees",
    .run = run,
};
