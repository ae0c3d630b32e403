// bias_hover.c - what a constant error b of the accelerometer does to the height (thesis C.3): a hover at 0.4
// m in free air, measured from 20 s on, beside the prediction of the loop's and the estimator's equations:
//
//   error = -(b / Kd + 0.153 b) / Kp - 0.0122 b
//
// (0.153 s of wrong climb and 0.0122 s2 of wrong height are the estimator's, see sense/ekf.h). shift_mm is
// the difference to the same flight, same seed, without the error.
#include "flight/scenario.h"

#include <math.h>

#define HOVER_M      0.4
#define MEASURE_S    20.0
#define END_S        60.0
#define EKF_CLIMB_S  0.153
#define EKF_HEIGHT_S 0.0122 // s2

static double mean_height_m(const record_t *r) {
  double sum = 0.0;
  int n = 0;
  for (int i = 0; i < r->n; i++) {
    if (r->sample[i].t_s < MEASURE_S) continue;
    sum += r->sample[i].z_m;
    n++;
  }
  return sum / n;
}

static done_t hover(setup_t setup, double bias_mps2, result_t *result, double *height_m, why_t *why) {
  setup.plan.noise.imu.acc_bias_b_mps2.z = bias_mps2;
  flown_t flown;
  TRY(setup_fly(&setup, &flown, why));
  *height_m = mean_height_m(&flown.record);
  snprintf(flown.segment[0].label, sizeof flown.segment[0].label, "bias %g m/s2", bias_mps2);
  result_add_flight(result, &flown);
  return DONE;
}

static void tell(const setup_t *setup, double bias_mps2, double height_m, double level_m, result_t *result) {
  const double kp = (double)setup->flight.pos.kp_z_per_s, kd = (double)setup->flight.pos.kd_z_per_s;
  const double climb_mps = bias_mps2 / kd + EKF_CLIMB_S * bias_mps2;
  const double predicted_m = -climb_mps / kp - EKF_HEIGHT_S * bias_mps2;
  // The equation holds for this INDI's law; its peers have others.
  const bool known = setup->kind <= FLY_INDI_LIVE;
  cJSON *row = result_add_row(result, "bias");
  cJSON_AddNumberToObject(row, "bias_mps2", bias_mps2);
  cJSON_AddNumberToObject(row, "error_mm", 1e3 * (height_m - HOVER_M));
  cJSON_AddNumberToObject(row, "shift_mm", 1e3 * (height_m - level_m));
  cJSON_AddNumberToObject(row, "predicted_mm", known ? 1e3 * predicted_m : (double)NAN);
}

static done_t run(const request_t *request, result_t *result, why_t *why) {
  static const double bias_mps2[] = {-0.1, -0.05, 0.05, 0.1};
  setup_t setup;
  TRY(setup_thesis(&setup, FLY_INDI, why));
  setup.flight.bias.pole_radps = 0.0f; // no bias observer: what the error costs where nothing finds it
  setup.model.ceiling_m = HUGE_VAL;
  setup.model.n_fx = 0;
  TRY(setup_apply(&setup, request, why));
  setup.plan.take_off_s = 1.0;
  setup.plan.way[0] = (waypoint_t){0.0, HOVER_M};
  setup.plan.n_way = 1;
  setup.plan.end_s = END_S;
  double level_m, height_m;
  TRY(hover(setup, 0.0, result, &level_m, why));
  for (unsigned i = 0; i < sizeof bias_mps2 / sizeof *bias_mps2; i++) {
    TRY(hover(setup, bias_mps2[i], result, &height_m, why));
    tell(&setup, bias_mps2[i], height_m, level_m, result);
  }
  return DONE;
}

const scenario_t scenario_bias_hover = {
    .name = "bias-hover",
    .brief = "six degrees of freedom, free hover at 0.4 m: the height that a wrong accelerometer costs "
             "(thesis C.3)",
    .run = run,
};
