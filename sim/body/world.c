// world.c - a vehicle in its surroundings.
#include "body/world.h"

#include <math.h>

#define EVENTS_MAX 1000 // contacts and releases within one tick

static double thrust_ratio(const world_t *w, const double *y) {
  const fx_place_t place = {
      .ceiling_gap_m = fmax(0.0, w->model->ceiling_m - y[VERTICAL_Z_M]),
      .ground_gap_m = fmax(0.0, y[VERTICAL_Z_M]),
      .radius_m = w->model->rotor_radius_m,
  };
  return model_thrust_ratio(w->model, &place);
}

static void derivative(void *self, const double *y, double *dydt) {
  const world_t *w = self;
  vertical_derivative(&w->vehicle, y, thrust_ratio(w, y), dydt);
}

static double margin(void *self, const double *y) {
  const world_t *w = self;
  const double ratio = w->vehicle.contact == CONTACT_NONE ? 1.0 : thrust_ratio(w, y);
  return vertical_margin(&w->vehicle, y, ratio);
}

done_t world_open(world_t *w, const model_t *model, integrate_kind_t kind, double step_s, double z_m,
                  double thrust_N) {
  *w = (world_t){
      .model = model,
      .vehicle = {.mass_kg = model->mass_kg,
                  .motor_tau_s = model->motor_tau_s,
                  .ceiling_m = model->ceiling_m},
      .y = {[VERTICAL_Z_M] = z_m, [VERTICAL_THRUST_N] = thrust_N},
  };
  if (!(z_m > 0.0)) {
    w->vehicle.contact = CONTACT_GROUND;
    w->y[VERTICAL_Z_M] = VERTICAL_NUDGE_M;
  }
  const ode_t ode = {
      .n = VERTICAL_N, .derivative = derivative, .margin = margin, .context = w, .step_s = step_s};
  return integrate_open(&w->integrate, kind, &ode);
}

double world_tick(world_t *w, double command_N, double force_N, double span_s) {
  const double applied_N = fmin(fmax(command_N, w->model->thrust_min_N), w->model->thrust_max_N);
  w->vehicle.command_N = applied_N;
  w->vehicle.force_N = force_N;
  double left_s = span_s;
  int events = 0;
  while (left_s > 0.0 && !w->broken) {
    bool event;
    const double passed_s = integrate_to(w->integrate, w->y, left_s, &event);
    w->broken = !isfinite(passed_s);
    if (!event) break;
    // Between a floor and a ceiling that touch each other there is no motion to integrate.
    if (++events > EVENTS_MAX) w->broken = true;
    vertical_switch(&w->vehicle, w->y);
    w->contacts += w->vehicle.contact == CONTACT_CEILING;
    left_s -= passed_s;
    if (left_s < 1e-12) break;
  }
  return applied_N;
}

double world_acc_mps2(const world_t *w) {
  return vertical_acc_mps2(&w->vehicle, w->y, thrust_ratio(w, w->y));
}

double world_ceiling_gap_m(const world_t *w) {
  return fmax(0.0, w->model->ceiling_m - w->y[VERTICAL_Z_M]);
}

double world_thrust_ratio(const world_t *w) {
  return thrust_ratio(w, w->y);
}

void world_close(world_t *w) {
  integrate_close(w->integrate);
  w->integrate = 0;
}
