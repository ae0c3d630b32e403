// body_forces.h - what acts on a vehicle: effects, contact and rotors put together. The inside of body.c.
#ifndef SIM_BODY_BODY_FORCES_H
#define SIM_BODY_BODY_FORCES_H

#include "body/body.h"

// What acts at state y. surfaces: TOUCH_* that may be near; the others are not looked at.
void body_look(const body_t *b, int surfaces, const double *y, body_look_t *look);

// Adds what one effect more does to the rotors and the body, after those of the model; not what it does at
// the beginning of a tick.
void body_look_more(const body_t *b, const fx_use_t *more, const double *y, body_look_t *look);

// dydt at state y, with what acts there or without having looked.
void body_derivative_seen(const body_t *b, const double *y, const body_look_t *look, double *dydt);
void body_derivative(const body_t *b, int surfaces, const double *y, double *dydt);

// Places rotors and points of contact around a centre of mass that lies at cg, seen from the vehicle file's.
void body_place(body_t *b, d3_t cg);

// The model's numbers, without effects.
fx_plant_t body_untouched(const model_t *m);

// Lets the effects change the vehicle for a tick of span_s.
void body_effects(body_t *b, double span_s);

#endif
