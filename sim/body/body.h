// body.h - a vehicle with six degrees of freedom in its surroundings: rigid body, rotors, battery, effects,
// contact and integrator together, one tick at a time.
//
// Each rotor has its own distance from ceiling and ground, along the world's vertical from its centre; the
// excess thrusts of ceiling and ground effect add up (thesis 3.1.4). The floor goes through the origin and
// may slope; the ceiling is at model.ceiling_m, a solid wall at model.wall_y_m.
#ifndef SIM_BODY_BODY_H
#define SIM_BODY_BODY_H

#include "body/forces.h"
#include "plant/integrate.h"
#include "vehicle/model.h"
#include <stdint.h>

#define BODY_QUEUE 256 // ticks; longer delays are cut to it

// The start of a flight. All zero is valid: see each line.
typedef struct {
  d3_t pos_w_m; // centre of mass; body_rest_z_m() is its height at rest on the floor
  d3_t vel_w_mps;
  dq_t q_wb; // all zero: level, x forward
  d3_t rate_b_radps;
  double thrust_N[ROTORS]; // in free air
  double discharged;       // 0: the battery is full, 1: empty
  uint64_t seed;           // for what is random (gusts)
  bool vertical_only;      // all but height, climb and thrust stand still
  bool held;               // as after body_hold()
} body_start_t;

typedef struct {
  const model_t *model; // owned by the caller; must outlive the body and must not change
  rigid_t rigid;
  touch_t touch;
  double y[RIGID_N];        // see plant/rigid.h; the quaternion has unit length between ticks. Read only
  double command_N[ROTORS]; // of the last tick, within the model's limits, before the delay
  double t_s;               // since the start
  double charge, current_A, vbat_V;
  int ceiling_contacts, floor_contacts; // contacts begun; resting at the start does not count
  bool on_ceiling, on_floor;            // from a contact until the gap is BODY_RELEASE_M
  bool broken; // the solver gave up, or the state is not finite; the body no longer moves
  // Internal.
  bool pushed; // `push` acts
  push_t push;
  integrate_t *integrate;
  integrate_kind_t kind;
  double step_s, span_s; // of the integrator; of the last tick
  random_t *random;
  fx_plant_t untouched, plant; // the model's numbers with steady effects; with all effects
  double memory[FX_MAX][FX_MEMORY];
  const fx_use_t *excess[FX_MAX], *load[FX_MAX], *tick[FX_MAX];
  int n_excess, n_load, n_tick, n_sense;
  int excess_of;    // SURFACE_* on which they depend
  int surfaces;     // TOUCH_* that are near
  body_look_t look; // for y, between ticks
  bool look_is_y;   // and still at the integrator's next call
  // Counts changes, except those by code that moves it with others (abreast.c), and those that effects make
  // at every tick: to `plant`, and to the rotors' scales in `rigid`.
  unsigned changed;
  double queue_N[BODY_QUEUE][ROTORS];
  unsigned queued;
} body_t;

#define BODY_RELEASE_M 1e-3
#define BODY_CHUNK_S   0.01 // within longer ticks, surfaces are looked for in between

// step_s: of the integrator, > 0. BAD_INPUT: step_s, inertia, mass, lag or kf is out of range. FAILED: no
// memory. The body must not be moved in memory; call body_close() at the end.
MUST_CHECK done_t body_open(body_t *b, const model_t *model, integrate_kind_t kind, double step_s,
                            const body_start_t *start);

// Advances by span_s. command_N: for each motor, the steady thrust in free air, N; limited to a quarter of
// the model's thrust limits.
void body_tick(body_t *b, const double command_N[ROTORS], double span_s);

// Specific force at the accelerometer, body axes: what a perfect one reads; +g along z at rest.
d3_t body_specific_force_b_mps2(const body_t *b);

// What perfect sensors read, with the model's effects on sensors: accelerometer and upward range in `above`,
// downward range in `below`.
void body_sensed(const body_t *b, fx_sensed_t *above, fx_sensed_t *below);

double body_ceiling_gap_m(const body_t *b, int rotor); // rotor's centre to ceiling, >= 0; HUGE_VAL: none
double body_gap_m(const body_t *b);                    // the smallest of all rotors
double body_thrust_ratio(const body_t *b, int rotor);  // factor of its thrust due to the surroundings
double body_rotors_N(const body_t *b);                 // of all of them, in free air
double body_rotor_radps(const body_t *b, int rotor);   // its actual speed
// Each rotor's current, and equally its torque, over that in free air at the same command.
void body_current_left(const body_t *b, double left[ROTORS]);
touch_gap_t body_clearance(const body_t *b); // gap of the nearest point; below 0: in contact

// Holds the vehicle where it is, whatever the rotors do, or lets go of it.
void body_hold(body_t *b, bool held);

// From now on this force acts on the centre of mass as well.
void body_push(body_t *b, d3_t force_w_N);
// The same for a push that changes at every tick: it invalidates nothing else that is known of the body.
void body_shake(body_t *b, push_t push);

// At rest on the floor over the origin, motors off; level with x forward, but for the shortest turn to the
// floor's slope.
body_start_t body_standing(const model_t *model);

// Sets floor, ceiling, wall and rotor radius from the model.
void body_surround(touch_t *t, const model_t *model);

// Height of the centre of mass at rest on a level floor.
double body_rest_z_m(const model_t *model);
// Height of the rotors' plane above the centre of mass when level.
double body_rotor_z_m(const model_t *model);

void body_close(body_t *b);

// --- internal: a tick in parts (body.c, abreast.c) -------------------------------------------------------

void body_command(body_t *b, const double command_N[ROTORS], double span_s);
void body_tick_begin(body_t *b); // delays and effects
unsigned body_delay_ticks(const body_t *b);
void body_tick_alone(body_t *b); // advances y and looks at what acts there
void body_tick_end(body_t *b);   // battery and time

// The number of steps in which to advance near these surfaces (TOUCH_*); contacts are checked after each.
int body_parts(int surfaces, double span_s);
// 1 if a contact begins, else 0; updates *on.
int body_touched(bool *on, double gap_m);

// --- internal: what acts (body_forces.c) -----------------------------------------------------------------

// The surfaces (TOUCH_*) that may be touched within span_s.
int body_near(const body_t *b, double span_s);

sensed_from_t body_sensed_from(const model_t *m);

// What acts at state y. surfaces: TOUCH_* that may be near; others are ignored.
void body_look(const body_t *b, int surfaces, const double *y, body_look_t *look);

// The SURFACE_* on whose distance the effect's excess depends.
int body_surfaces_of(const fx_use_t *use);

// As body_look(), if *look already holds all but the load: for the same state, with the rotors in the same
// places. No surface may be near.
void body_look_load(const body_t *b, const double *y, body_look_t *look);

// Adds what one more effect does to rotors and body, after the model's effects, but not what it does at the
// beginning of a tick.
void body_look_more(const body_t *b, const fx_use_t *more, const double *y, body_look_t *look);

// dydt at state y, where *look holds what acts there, or without it.
void body_derivative_seen(const body_t *b, const double *y, const body_look_t *look, double *dydt);
void body_derivative(const body_t *b, int surfaces, const double *y, double *dydt);
// The integrator's callback. self: the body; if look_is_y, it has already looked at y.
void body_next_derivative(void *self, const double *y, double *dydt);

// Specific force at the centre of mass, body axes, and the angular acceleration.
d3_t body_pull_b_mps2(const body_t *b, const double *y, const body_look_t *look, d3_t *turn_radps2);

// Places rotors and contact points around a centre of mass at cg, as seen from that of the vehicle file.
void body_place(body_t *b, d3_t cg);

// The model's numbers, without effects.
fx_plant_t body_untouched(const model_t *m);

// Lets the effects change the vehicle for a tick of span_s.
void body_effects(body_t *b, double span_s);

#endif
