// vehicle6.h - a vehicle with six degrees of freedom for tests, with the Crazyflie's mass and geometry.
#ifndef TEST_RIG_VEHICLE6_H
#define TEST_RIG_VEHICLE6_H

#include "body/body.h"
#include "rig/test.h"

#define MASS_KG  0.0329
#define WEIGHT_N (MASS_KG * 9.81)
#define RADIUS_M 0.0225
#define TICK_S   0.002

// Without effects, battery or delay; the blades are its highest points. ceiling_m: HUGE_VAL for none.
model_t vehicle6(double ceiling_m);

// Adds an effect with nominal parameters; returns its entry in m->fx.
fx_use_t *vehicle6_add(model_t *m, const char *effect);

// At rest, the rotor plane at rotor_z_m; each rotor gives `share` of a quarter of the weight.
body_start_t vehicle6_start(const model_t *m, double rotor_z_m, double share);

// Runs `ticks` of TICK_S, each rotor commanded `share` of a quarter of the weight.
void vehicle6_fly(body_t *b, double share, int ticks);

double vehicle6_tilt_rad(const body_t *b);

// Runs a tick with commands in PWM 0..65535, through the thrust map at the battery's voltage.
void vehicle6_tick_pwm(body_t *b, const double pwm[ROTORS], double span_s);

// Angular acceleration, body axes.
d3_t vehicle6_angular_acc_b_radps2(const body_t *b);

// Angular momentum about the centre of mass, rotors included, world axes.
d3_t vehicle6_momentum_w(const rigid_t *r, const double y[RIGID_N]);

// Both integrators that flights use.
extern const integrate_kind_t vehicle6_kinds[2];

#endif
