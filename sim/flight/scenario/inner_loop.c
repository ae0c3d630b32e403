// inner_loop.c - a hover in free air with steps in position and heading, for out/effectiveness.
#include "flight/scenario.h"

#include <math.h>

#define HOVER_M  1.0
#define START_S  5.0
#define END_S    65.0
#define SIDE_M   0.1 // side of the square that is flown
#define CORNER_S 0.6
#define YAW_RAD  0.1
#define YAW_S    0.45 // does not divide the other period: the signals can be told apart

static void shake(void *context, const body_t *truth, pilot_in_t *in) {
  (void)context;
  static const double x[4] = {0.0, 1.0, 1.0, 0.0}, y[4] = {0.0, 0.0, 1.0, 1.0};
  const double t_s = truth->t_s - START_S;
  if (t_s < 0.0) return;
  const int corner = (int)(t_s / CORNER_S) % 4;
  in->set.pos_w_m.x = SIDE_M * x[corner];
  in->set.pos_w_m.y = SIDE_M * y[corner];
  in->set.yaw_rad = (int)(t_s / YAW_S) % 2 ? YAW_RAD : -YAW_RAD;
}

static done_t run(const request_t *request, result_t *result, why_t *why) {
  setup_t setup;
  TRY(setup_thesis(&setup, FLY_INDI, why));
  setup.model.ceiling_m = HUGE_VAL;
  setup.model.n_fx = 0;
  TRY(setup_apply(&setup, request, why));
  setup.plan.take_off_s = 1.0;
  setup.plan.edit = shake;
  setup.plan.way[0] = (waypoint_t){0.0, HOVER_M};
  setup.plan.n_way = 1;
  setup.plan.end_s = END_S;
  return scenario_fly(&setup, result, why);
}

const scenario_t scenario_inner_loop = {
    .name = "inner-loop",
    .brief = "six degrees of freedom, free air: steps in place and heading, for out/effectiveness "
             "(--log-rate 500)",
    .run = run,
};
