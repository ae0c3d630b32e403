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

// Starts in a hover at 0.3 m, where the app takes over.
void app_start(flying_t *f);

void app_fly(flying_t *f, int ms);

// Returns the app's log variable "group.name", which must exist.
double app_log(const flying_t *f, const char *name);

#endif
