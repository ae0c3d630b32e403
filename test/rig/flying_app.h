// flying_app.h - the app as it runs on the vehicle, flying: a hover at 0.3 m in free air.
#ifndef TEST_RIG_FLYING_APP_H
#define TEST_RIG_FLYING_APP_H

#include "crazyflie/crazyflie.h"
#include "rig/rig6.h"

typedef struct {
  crazyflie_t vehicle;
  rig6_t rig;
  pilot_setpoint_t set;
} flying_t;

// Hovers at 0.3 m, taken over in flight from whoever flew.
void app_start(flying_t *f);

void app_fly(flying_t *f, int ms);

// A log of the app, "group.name", which there must be.
double app_log(const flying_t *f, const char *name);

#endif
