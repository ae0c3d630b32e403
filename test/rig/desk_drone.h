// desk_drone.h - a simulated drone of the desk for tests, and its client in simulated time.
#ifndef TEST_RIG_DESK_DRONE_H
#define TEST_RIG_DESK_DRONE_H

#include "drone/drone.h"

// Open a drone: in the default scene with that ceiling; in the scene of that text.
drone_t *desk_drone(double ceiling_m, FILE *log, FILE *commands);
drone_t *desk_drone_in(const char *scene_text);
void desk_end(drone_t *d);

// Flies on for s seconds and discards the packets for the client.
void desk_pass(drone_t *d, double s);

// Sets a parameter as a client does.
void desk_set(drone_t *d, const char *name, double value);

// Commands of 2 s: take off or go to a height; land.
void desk_climb(drone_t *d, float height_m);
void desk_land(drone_t *d);

double desk_log(drone_t *d, const char *name);

#endif
