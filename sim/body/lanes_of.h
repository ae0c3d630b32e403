// lanes_of.h - which numbers of a body go into its lane (body/lanes.h), and where. Only for sim/body.
#ifndef SIM_BODY_LANES_OF_H
#define SIM_BODY_LANES_OF_H

#include "body/body.h"
#include "body/lanes.h"
#include <stddef.h>

#define NUMBER         sizeof(double)
#define RIGID_NUMBERS  (offsetof(rigid_t, command_N) / NUMBER) // those that rarely change
#define RIGID_COMMAND  RIGID_NUMBERS
#define RIGID_SCALES   (offsetof(rigid_t, thrust_scale) / NUMBER) // thrust, torque, faster
#define TOUCH_NUMBERS  (sizeof(touch_t) / NUMBER)
#define PLANT_NUMBERS  (sizeof(fx_plant_t) / NUMBER)
#define PUSH_NUMBERS   (sizeof(push_t) / NUMBER)
#define LOOK_NUMBERS   (offsetof(body_look_t, loaded) / NUMBER)
#define EFFECT_NUMBERS FX_PARAM_MAX

_Static_assert(LANES_EFFECTS == FX_MAX && (int)LANES_PARAMS == FX_PARAM_MAX, "every effect has its place");
_Static_assert(offsetof(rigid_t, lag_in_speed) == (RIGID_COMMAND + ROTORS) * NUMBER,
               "numbers first, then flags");
_Static_assert(offsetof(rigid_t, faster) == (RIGID_SCALES + 2 * ROTORS) * NUMBER, "scales lie side by side");
_Static_assert((int)RIGID_N == LANES_CHARGE, "charge, current and voltage lie behind y");

// For registers of that many bits (lane_bits()).
const lanes_door_t *lanes_door(int bits);
// Null if there is no memory.
lanes_t *lanes_open(const lanes_door_t *door);

// True if the effect is in the tables, and its form has no measured points.
bool lanes_know_effect(const fx_use_t *use);
// True if this holds for all effects that act otherwise than at ticks.
bool lanes_know(const body_t *b);
lanes_effect_t lanes_effect(const fx_use_t *use);

// Lists the model's effects on sensors; returns how many.
int lanes_senses(const model_t *m, const fx_use_t *sense[FX_MAX]);

lanes_alike_t lanes_alike(const body_t *b);

static inline void lanes_put(double *to, const double *from, int n, int lane) {
  for (int i = 0; i < n; i++) to[LANES * i + lane] = from[i];
}
static inline void lanes_get(const double *from, double *to, int n, int lane) {
  for (int i = 0; i < n; i++) to[i] = from[LANES * i + lane];
}
void lanes_take_model(const lanes_at_t *to, int lane, const model_t *m);
void lanes_take_effects(const lanes_at_t *to, int lane, const body_t *b);

#endif
