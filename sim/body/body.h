// body.h - a vehicle with six degrees of freedom in its surroundings: rigid body, rotors, battery, effects,
// contact and integrator together, one tick at a time.
//
// Each rotor has its own distance from ceiling and ground, along the world's vertical from its centre;
// ceiling and ground effect add their excess (thesis 3.1.4). The floor goes through the origin and may slope;
// the ceiling is at model.ceiling_m, a wall that is solid at model.wall_y_m.
#ifndef SIM_BODY_BODY_H
#define SIM_BODY_BODY_H

#include "body/forces.h"
#include "plant/integrate.h"
#include "vehicle/model.h"
#include <stdint.h>

#define BODY_QUEUE 256 // ticks; a longer delay than this is cut to it

// Where a flight starts. All zero: see each line.
typedef struct {
  d3_t pos_w_m; // centre of mass; body_rest_z_m() is its height at rest on the floor
  d3_t vel_w_mps;
  dq_t q_wb; // all zero: level, x forward
  d3_t rate_b_radps;
  double thrust_N[ROTORS]; // in free air
  double discharged;       // 0: the battery is full, 1: empty
  uint64_t seed;           // of what is random (gusts)
  bool vertical_only;      // all but height, climb and thrust stand still
  bool held;               // as by body_hold()
} body_start_t;

typedef struct {
  const model_t *model; // owned by the caller; must outlive the body and must not change
  rigid_t rigid;
  touch_t touch;
  double y[RIGID_N];        // see plant/rigid.h; the quaternion is of unit length at ticks. To be read only
  double command_N[ROTORS]; // as given to the last tick, within the model's limits, before the delay
  double t_s;               // since the start
  double charge, current_A, vbat_V;
  int ceiling_contacts, floor_contacts; // how often each was touched; resting from the start does not count
  bool on_ceiling, on_floor;            // touching since the last contact, until the gap is BODY_RELEASE_M
  bool broken;                          // the solver gave up, or the state is not finite; it stands still
  // Not for callers.
  bool pushed; // by push
  push_t push;
  integrate_t *integrate;
  integrate_kind_t kind;
  double step_s, span_s; // of the integrator, and of the last tick
  random_t *random;
  fx_plant_t untouched, plant; // the model's numbers with steady effects; what the others made of them
  double memory[FX_MAX][FX_MEMORY];
  const fx_use_t *excess[FX_MAX], *load[FX_MAX], *tick[FX_MAX];
  int n_excess, n_load, n_tick, n_sense;
  int excess_of;    // SURFACE_* that they have to do with
  int surfaces;     // TOUCH_* that are near enough to look at
  body_look_t look; // at y, between ticks
  bool look_is_y;   // also at the integrator's next call
  // Counts what was not done by those that move it with others (abreast.c), but for what effects do at each
  // tick: `plant`, and of `rigid` the scales of the rotors.
  unsigned changed;
  double queue_N[BODY_QUEUE][ROTORS];
  unsigned queued;
} body_t;

#define BODY_RELEASE_M 1e-3
#define BODY_CHUNK_S   0.01 // a longer tick looks for surfaces in between

// step_s: of the integrator, > 0. BAD_INPUT: step_s, inertia, mass, lag or kf out of range. FAILED: no
// memory. The body must not be moved in memory; close what was opened.
MUST_CHECK done_t body_open(body_t *b, const model_t *model, integrate_kind_t kind, double step_s,
                            const body_start_t *start);

// Moves on by span_s with commands in newton per motor: what the thrust in free air will settle at, within a
// quarter of the model's thrust limits.
void body_tick(body_t *b, const double command_N[ROTORS], double span_s);

// Specific force at the accelerometer, body axes: what a perfect one reads, +g along z at rest.
d3_t body_specific_force_b_mps2(const body_t *b);

// What perfect sensors read that have the model's effects on sensors: accelerometer and upward range in
// `above`, downward range in `below`.
void body_sensed(const body_t *b, fx_sensed_t *above, fx_sensed_t *below);

double body_ceiling_gap_m(const body_t *b, int rotor); // rotor's centre to ceiling, >= 0; HUGE_VAL: none
double body_gap_m(const body_t *b);                    // of the rotor that is nearest
double body_thrust_ratio(const body_t *b, int rotor);  // what the surroundings multiply the thrust by
double body_rotors_N(const body_t *b);                 // of all of them, in free air
double body_rotor_radps(const body_t *b, int rotor);   // its speed
// What is left of each rotor's current, and of its torque, of those in free air at the same command.
void body_current_left(const body_t *b, double left[ROTORS]);
touch_gap_t body_clearance(const body_t *b); // of the point that is nearest; below 0: in contact

// Something holds the vehicle where it is, whatever the rotors do; or lets go of it.
void body_hold(body_t *b, bool held);

// From now on this acts on the centre of mass besides.
void body_push(body_t *b, d3_t force_w_N);
// This, and another one at every tick: what else is known of the body stays so.
void body_shake(body_t *b, push_t push);

// At rest on the floor over the origin, motors off, x forward as far as the floor is level.
body_start_t body_standing(const model_t *model);

// Floor, ceiling, wall and the rotors' radius, as the model has them.
void body_surround(touch_t *t, const model_t *model);

// Height of the centre of mass at rest on the floor, level.
double body_rest_z_m(const model_t *model);
// Height of the rotors' plane over the centre of mass, level.
double body_rotor_z_m(const model_t *model);

void body_close(body_t *b);

// --- the inside: a tick in parts (body.c, abreast.c) -----------------------------------------------------

void body_command(body_t *b, const double command_N[ROTORS], double span_s);
void body_tick_begin(body_t *b); // delays and effects
unsigned body_delay_ticks(const body_t *b);
void body_tick_alone(body_t *b); // from y to the next, and a look at what acts there
void body_tick_end(body_t *b);   // battery and time

// So many steps where these surfaces (TOUCH_*) are near; after each it is looked whether it touches one: 1
// where it did not before.
int body_parts(int surfaces, double span_s);
int body_touched(bool *on, double gap_m);

// --- the inside: what acts (body_forces.c) ---------------------------------------------------------------

// The surfaces (TOUCH_*) that may be touched within span_s.
int body_near(const body_t *b, double span_s);

sensed_from_t body_sensed_from(const model_t *m);

// What acts at state y. surfaces: TOUCH_* that may be near; the others are not looked at.
void body_look(const body_t *b, int surfaces, const double *y, body_look_t *look);

// SURFACE_* whose distance the excess of an effect asks for.
int body_surfaces_of(const fx_use_t *use);

// The same where all but the load is there already: from the same state, and the rotors where they are. No
// surface is near.
void body_look_load(const body_t *b, const double *y, body_look_t *look);

// Adds what one effect more does to the rotors and the body, after those of the model; not what it does at
// the beginning of a tick.
void body_look_more(const body_t *b, const fx_use_t *more, const double *y, body_look_t *look);

// dydt at state y, with what acts there or without having looked.
void body_derivative_seen(const body_t *b, const double *y, const body_look_t *look, double *dydt);
void body_derivative(const body_t *b, int surfaces, const double *y, double *dydt);
// The integrator's: self is the body, which has looked at y where look_is_y.
void body_next_derivative(void *self, const double *y, double *dydt);

// Specific force at the centre of mass, body axes, and how the turning grows.
d3_t body_pull_b_mps2(const body_t *b, const double *y, const body_look_t *look, d3_t *turn_radps2);

// Places rotors and points of contact around a centre of mass that lies at cg, seen from the vehicle file's.
void body_place(body_t *b, d3_t cg);

// The model's numbers, without effects.
fx_plant_t body_untouched(const model_t *m);

// Lets the effects change the vehicle for a tick of span_s.
void body_effects(body_t *b, double span_s);

#endif
