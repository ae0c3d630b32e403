// scene.h - where simulated vehicles fly for clients: a vehicle, its surroundings, and how much they disturb.
//
// A TOML file, every key of which may be left out:
//
//   vehicle = "cf21_legacy"     one that comes with the program, or a file's path from the scene's folder
//   noise = "real"              as fly takes it
//   seed = 1
//   ceiling_m = 1.5             10: none
//   floor_rise_x = 0.0, floor_rise_y = 0.0   tangents
//   wall_y_m = 1.0              a wall in the plane of this y that can be touched and seen
//   battery = 1.0               charge at the start, 0 to 1
//   [[effect]]                  any number of them; one that begins later says so itself (mass: start)
//   is = "mass:add=0.003,start=20"
//   [[event]]                   a parameter of the group desk that changes by itself; in the order of time:
//   at_s = 20.0                 here a fan that begins to blow, mN
//   set = "windX=30"
//
// Without a file: the thesis's Crazyflie and its ceiling effect, with a ceiling at 1.5 m.
#ifndef SIM_DRONE_SCENE_H
#define SIM_DRONE_SCENE_H

#include "flight/setup.h"

#define SCENE_EVENTS 16

typedef struct {
  double at_s; // since it was switched on
  int param;   // number of a desk parameter
  double value;
} event_t;

typedef struct {
  setup_t setup; // model and noise
  double battery;
  double loss, delay_s; // of the link's packets; no key of the file
  uint64_t seed;
  event_t event[SCENE_EVENTS];
  int n_event;
} scene_t;

MUST_CHECK done_t scene_default(scene_t *scene, why_t *why);

// Reads a file over what is there. BAD_INPUT: it is missing or not TOML, a key is unknown or out of range.
MUST_CHECK done_t scene_read(const char *path, scene_t *scene, why_t *why);

// Applies what a command line asks for over it: vehicle, effects and noise of request_t.
MUST_CHECK done_t scene_apply(scene_t *scene, const request_t *request, why_t *why);

// All three: the default, the file at path (null: none), and the command line's request, whose seed becomes
// the file's unless seed_said.
MUST_CHECK done_t scene_take(scene_t *scene, const char *path, request_t *request, bool seed_said,
                             why_t *why);

#endif
