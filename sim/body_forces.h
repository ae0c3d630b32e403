// body_forces.h - what acts on a vehicle: effects, contact and rotors put together. The inside of body.c.
#ifndef SIM_BODY_FORCES_H
#define SIM_BODY_FORCES_H

#include "body.h"

// dydt at state y. surfaces: TOUCH_* that may be near; the others are not looked at.
void body_derivative(const body_t *b, int surfaces, const double *y, double *dydt);

// What the surroundings multiply each rotor's thrust by; z_m: height of the centre of mass.
void body_ratios(const body_t *b, double z_m, const axes_t *axes, double ratio[ROTORS]);

// Places rotors and points of contact around a centre of mass that lies at cg, seen from the vehicle file's.
void body_place(body_t *b, d3_t cg);

// The model's numbers, without effects.
fx_plant_t body_untouched(const model_t *m);

// Lets the effects change the vehicle for a tick of span_s.
void body_effects(body_t *b, double span_s);

#endif
