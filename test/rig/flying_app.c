// flying_app.c - the app as it runs on the vehicle, flying.
#include "rig/flying_app.h"

#include "rig/test.h"

void app_start(flying_t *f) {
  rig6_param_t body = rig6_crazyflie();
  f->rig = rig6_at(&body, d3(0.0, 0.0, 0.3), 0.0, true);
  f->set = rig6_hold(d3(0.0, 0.0, 0.3), 0.0);
  crazyflie_init(&f->vehicle, NULL);
  CHECK(crazyflie_set(&f->vehicle, "ceil.shadow", 0));
  CHECK(crazyflie_set(&f->vehicle, "indiPos.mass", body.mass_kg));
  CHECK(crazyflie_set(&f->vehicle, "indiPos.tauMot", body.tau_s));
  crazyflie_start(&f->vehicle);
}

void app_fly(flying_t *f, int ms) {
  for (int i = 0; i < ms; i++) {
    double motor_N[PILOT_MOTORS];
    const pilot_in_t in = rig6_sense(&f->rig, &f->set);
    crazyflie_ms(&f->vehicle, &in, motor_N);
    rig6_step(&f->rig, motor_N);
  }
}

double app_log(const flying_t *f, const char *name) {
  double value = (double)NAN;
  CHECK(crazyflie_log(&f->vehicle, name, &value));
  return value;
}
