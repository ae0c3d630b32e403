// desk_drone.h - a drone of the desk for tests, and a client of it in simulated time.
#ifndef TEST_RIG_DESK_DRONE_H
#define TEST_RIG_DESK_DRONE_H

#include "drone/drone.h"

// In the default scene with the ceiling there; in that of a scene's text.
drone_t *desk_drone(double ceiling_m, FILE *log, FILE *commands);
drone_t *desk_drone_in(const char *scene_text);
void desk_end(drone_t *d);

// Flies on, and throws away what the client would get.
void desk_pass(drone_t *d, double s);

// A parameter, as a client writes it.
void desk_set(drone_t *d, const char *name, double value);

// Take off, or go to, within 2 s; and down.
void desk_climb(drone_t *d, float height_m);
void desk_land(drone_t *d);

double desk_log(drone_t *d, const char *name);

#endif
