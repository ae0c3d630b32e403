// bound_plant.c - a vehicle below a ceiling, and a level's sensors, for the bound of the height error.
#include "flight/bound_plant.h"

#include "base/constants.h"
#include <math.h>

#define STEP_M 1e-5 // for the curve's slope

static double ratio_at(const model_t *model, double gap_m) {
  const fx_place_t place = {gap_m, HUGE_VAL, model->rotor_radius_m};
  return model_thrust_ratio(model, &place);
}

// Returns the sd before the filter, where the noise is white.
static double before_filter(double filtered) {
  imu_t imu;
  imu_init(&imu);
  return filtered / imu.acc.gain;
}

// Adds rounding to whole millimetres: uniform within half of one.
static double with_rounding(double sd_m, double rounding) {
  return rounding > 0.5 ? hypot(sd_m, 1e-3 / sqrt(12.0)) : sd_m;
}

bound_plant_t bound_plant(const model_t *model, const noise_t *noise, double gap_m, bound_force_t force) {
  const range_param_t *const range = &noise->range;
  const lag_t lag = model_lag(model, 0.0);
  const double ratio = ratio_at(model, gap_m),
               slope = (ratio_at(model, gap_m + STEP_M) - ratio_at(model, gap_m - STEP_M)) / (2.0 * STEP_M);
  const bool seen = gap_m > 1e-3 * RANGE_UP_FLOOR_MM;
  return (bound_plant_t){
      .stiffness_per_s2 = -G_MPS2 * slope / ratio,
      .tau_s = fmax(0.5 * (lag.up_s + lag.down_s), LAG_LEAST_S),
      .delay_s = model->frame.motor_delay_s,
      .room_mps2 = ratio * model->thrust_max_N / model->mass_kg - G_MPS2,
      .acc_mps2 = before_filter(noise->imu.acc_z_mps2),
      .down = {with_rounding(range->down_m, range->rounding), RANGE_DOWN_PERIOD_MS, RANGE_DOWN_AGE_MS},
      .up = {seen ? with_rounding(range->up_m, range->rounding) : HUGE_VAL, RANGE_UP_PERIOD_MS,
             (RANGE_UP_AGE_MIN_MS + RANGE_UP_AGE_MAX_MS) / 2},
      .force = force,
  };
}

// By Simpson's rule over the range in which the sd is drawn evenly.
bound_t bound_of_gusts(const model_t *model, const noise_t *noise, double gap_m) {
  static const double share[] = {1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0};
  const vary_t *const v = &noise->vary;
  bound_t all = {0.0, 0.0, 0.0};
  for (int i = 0; i < 3; i++) {
    const double gust = v->gust_min_mps2 + 0.5 * i * (v->gust_max_mps2 - v->gust_min_mps2);
    const bound_force_t force = {.gust_mps2 = gust, .gust_tau_s = v->gust_tau_s};
    const bound_plant_t plant = bound_plant(model, noise, gap_m, force);
    const bound_t b = bound_of(&plant);
    all.rms_m += share[i] * b.rms_m * b.rms_m;
    all.known_m += share[i] * b.known_m * b.known_m;
    all.command_mps2 += share[i] * b.command_mps2 * b.command_mps2;
  }
  return (bound_t){sqrt(all.rms_m), sqrt(all.known_m), sqrt(all.command_mps2)};
}
