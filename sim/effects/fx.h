// fx.h - what an effect is: a name, parameters with unit and range, and hooks into the plant.
//
// One file fx_NAME.c defines one `const fx_t fx_NAME`; the build collects them into fx_table. What the
// simulator can switch on, the discrepancy workflow can find.
#ifndef SIM_EFFECTS_FX_H
#define SIM_EFFECTS_FX_H

#include "base/either.h"
#include "base/pair.h"
#include "base/random.h"
#include "plant/rigid.h"
#include <stdbool.h>
#include <string.h>

#define FX_PARAM_MAX 9
#define FX_MEMORY    8  // numbers that an effect keeps from tick to tick
#define FX_MAX       32 // effects; all of them can be on at once
#define FX_SIZE_MAX  3  // numbers of an effect that the discrepancy workflow estimates
#define FX_SHAPE_MAX 8  // values that it tries for a number that it does not estimate
#define FX_KIND_MAX  2
#define FX_APART_MAX 10 // rivals of which an effect says how to tell it from them

typedef struct {
  const char *name;
  const char *unit; // "" for none; "number": a whole number that selects something
  double min, nominal, max;
} fx_param_t;

// A parameter. 1: a rotor's torque follows its changed thrust, 0: it stays (fx_scale_rotor).
#define FX_TORQUE                                                                                            \
  { "torque", "number", 0.0, 1.0, 1.0 }

static inline bool fx_is_number(const fx_param_t *p) {
  return strcmp(p->unit, "number") == 0;
}

// The last parameter of every curve. 1: each rotor has its own distance from the surface, so that a tilted
// vehicle is turned; 0: all have that of their middle, as in many simulators.
#define CURVE_EACH                                                                                           \
  { "each", "number", 0.0, 1.0, 1.0 }

// A published curve: thrust near a surface over thrust in free air. One file curve_NAME.c each, collected
// into curve_table. Which effects may use it stands in `surfaces`.
enum { SURFACE_CEILING = 1, SURFACE_GROUND = 2 };

// Points of a measured curve, x ascending (form `table`).
#ifndef CURVE_POINTS_MAX // where no curve has any (body/lanes.cpp)
#define CURVE_POINTS_MAX 64
#endif
typedef struct {
  int n;
  double x[CURVE_POINTS_MAX];     // distance over rotor radius
  double ratio[CURVE_POINTS_MAX]; // thrust ratio
} curve_points_t;

typedef struct {
  const char *name; // as in form=NAME
  const char *brief;
  const char *source;
  int surfaces;     // SURFACE_* it is published or used for
  int needs_points; // 1: takes file=FILE
  int n_param;
  fx_param_t param[FX_PARAM_MAX];
  // The workflow looks for a surface in every form that has n_shape values to try for the second number,
  // while it estimates the first one, which is a factor of ratio - 1. 0: in this form it does not look.
  int n_shape;
  double shape[FX_SHAPE_MAX];
  // distance_m: rotor plane to surface, >= 0; radius_m: of the rotor, > 0. Result: > 0, finite.
  double (*ratio)(const double *p, const curve_points_t *points, double distance_m, double radius_m);
  // Changes the curve's numbers so that its difference from 1 is `more` times as large and falls `faster`
  // times as fast with the distance; null: there is no number to change. points: the curve's own copy.
  void (*vary)(double *p, curve_points_t *points, double more, double faster);
  // For four rotors at once: adds ratio - 1 at distance_m[i] to ratio[i]; null: call ratio for each.
  void (*add_excess)(const double *p, const double distance_m[ROTORS], double radius_m, double ratio[ROTORS]);
} curve_t;

extern const curve_t *const curve_table[];
extern const int curve_count;

// Where a rotor is. A distance may be INFINITY: no such surface.
typedef struct {
  double ceiling_gap_m; // rotor plane to ceiling
  double ground_gap_m;  // rotor plane to ground
  double radius_m;      // of the rotor
} fx_place_t;

// Where the four rotors of a vehicle are.
typedef struct {
  double ceiling_gap_m[ROTORS], ground_gap_m[ROTORS];
  double radius_m;
} fx_places_t;

// The vehicle in flight, at every stage of the integrator.
typedef struct {
  d3_t pos_w_m;   // centre of mass, world
  d3_t air_b_mps; // velocity through the air, body axes
  d3_t rate_b_radps;
  const axes_t *axes;         // of the body
  const d3_t *hub_b_m;        // the rotors' centres, from the centre of mass
  double rotor_radps[ROTORS]; // their speeds
  const rigid_t *rigid;       // rotor centres, senses of turning (d_i), kf_Ns2, thrust_scale (plant/rigid.h)
} fx_motion_t;

// The point at `arm` of the way from the centre of mass to a rotor's hub: 1 the hub, 0 the centre of mass.
typedef struct {
  d3_t at_b_m, air_b_mps; // place, and velocity through the air
} fx_hub_t;
static inline fx_hub_t fx_hub(const fx_motion_t *m, int rotor, double arm) {
  const d3_t at = d3_scale(arm, m->hub_b_m[rotor]);
  return (fx_hub_t){at, d3_add(m->air_b_mps, d3_cross(m->rate_b_radps, at))};
}

// What an effect may change, for the time of one tick. At each tick it starts from the vehicle file's
// numbers, and the effects change it one after the other.
typedef struct {
  double mass_kg;              // > 0
  d3_t cg_b_m;                 // the centre of mass, relative to that of the vehicle file
  d3_t inertia_scale;          // > 0: what the inertia about each axis is multiplied by
  double thrust_scale[ROTORS]; // what each rotor's thrust is multiplied by, >= 0
  double torque_scale[ROTORS]; // what its torque is multiplied by besides, >= 0
  double faster[ROTORS];       // by what share it turns faster at the same command, and takes less torque
  double motor_tau_s;          // > 0   lag
  double delay_s;              // >= 0  from a command to the lag
  d3_t air_w_mps;              // velocity of the air
  d3_t force_w_N;              // at the centre of mass, world axes
  d3_t moment_b_Nm;            // about the centre of mass, body axes
} fx_plant_t;

// Multiplies a rotor's thrust. torque 1: its torque, too, as if the rotor turns slower; 0: its torque
// stays, as if the rotor keeps the commanded speed.
static inline void fx_scale_rotor(fx_plant_t *plant, int rotor, double scale, double torque) {
  plant->thrust_scale[rotor] *= scale;
  if (scale > 0.0 && torque < 0.5) plant->torque_scale[rotor] /= scale;
}

// The tick that begins.
typedef struct {
  double t_s, span_s;
  double vbat_V;           // at the terminals
  const double *thrust_N;  // of each rotor, in free air
  const fx_place_t *place; // of each rotor; a null pointer where the effect has no FX_NEEDS_POSITION
  random_t *random;        // the vehicle's own
  double *memory;          // FX_MEMORY numbers of this effect, 0 at the start
} fx_tick_t;

// What the sensors read. Range: along the sensor's axis, with one surface in sight.
typedef struct {
  d3_t acc_b_mps2;       // specific force
  double range_m;        // HUGE_VAL: nothing in sight
  double range_rate_mps; // of the true distance
} fx_sensed_t;

// How a number's typical value grows with the vehicle, so that the effect accelerates a large vehicle as much
// as a Crazyflie, for which the nominal value holds.
typedef enum {
  FX_SAME,              // not at all: a sensor's error, a share, a time
  FX_BY_MASS,           // a force, or a force over a velocity squared
  FX_BY_MASS_PER_SPEED, // a force over velocity and rotor speed
  FX_BY_INERTIA,        // a moment
  FX_BY_INERTIA_PER_SPEED,
  FX_BY_ARM,       // a length, as the rotors' distance from the centre
  FX_BY_PER_WEIGHT // one over a force
} fx_grows_t;

// A number that the workflow estimates: use->p[param]. step: small enough to be linear. At a value of 0
// the effect is absent.
typedef struct {
  int param;
  double step;
  int sign;         // +1: it cannot be negative; 0: it can be either
  double least;     // a smaller one is never named: feedback alone can look like it
  fx_grows_t grows; // its nominal number and its step
} fx_size_t;

// At most one effect of FX_TIMING is named, and one of FX_WEIGHT, unless the log's turning tells those apart.
typedef enum { FX_ALONE, FX_TIMING, FX_WEIGHT } fx_group_t;

// How an effect's numbers scale the predicted angular acceleration. INERTIA: number k multiplies it by
// 1 / (1 + number) about axis k; TORQUE: number 0 by 1 + number about z.
typedef enum { FX_SCALES_NOTHING, FX_SCALES_INERTIA, FX_SCALES_TORQUE } fx_scales_t;

// What the vehicle file and the log must say before the workflow looks for an effect.
enum {
  FX_NEEDS_CEILING = 1 << 0,  // the vehicle file: ceiling_m
  FX_NEEDS_WALL = 1 << 1,     // the vehicle file: wall_y_m, which becomes parameter 0
  FX_NEEDS_POSITION = 1 << 2, // the log, from here on
  FX_NEEDS_RANGE = 1 << 3,    // samples of a range sensor; it shows in nothing else
  FX_NEEDS_VOLTAGE = 1 << 4,  // of the battery
  FX_NEEDS_VELOCITY = 1 << 5,
  FX_NEEDS_ATTITUDE = 1 << 6,
  FX_NEEDS_ACCELERATION = 1 << 7, // logged, not made of the velocity
  FX_NEEDS_TURNING = 1 << 8,      // about some axis; without it the effect is only a push
};

// A flight that changes an effect and not its rival, or the other way round. One of the two says it.
typedef struct {
  const char *rival, *fly;
} fx_apart_t;

struct fx_use;

typedef struct {
  const char *name;
  const char *brief;
  const char *law; // what it does, by the names of its numbers and those of fx_law_symbols
  const char *fly; // the manoeuvre that shows it
  // Where it shows: the coordinates along which it changes (gap/5_infer/coordinates.h; none: any but time),
  // and the channel in which it is easiest to see (gap/2_predict/grid.h; null: the one in which it does
  // most).
  const char *over[2], *in;
  fx_apart_t apart[FX_APART_MAX]; // ends where there is no rival
  int needs;                      // FX_NEEDS_*
  fx_group_t group;
  bool lags;      // FX_TIMING: it slows the motors down; else it moves their commands in time
  bool in_height; // if a range sensor has this error, a height estimate from it has it, too
  // Control that cancels a disturbance gives commands that do not turn the vehicle. This looks like the
  // effect with sizes above 0 (1) or below 0 (-1), or not like it (0). The first look, which finds out how
  // much disturbance there is, takes only what explains more than control could
  // (gap/5_infer/beyond_control.h).
  int control_makes;
  // Control that answers a disturbance, late and by its own gains, looks like it: to be named, the effect
  // must explain more than such control (gap/5_infer/own_work.h).
  bool answers;
  fx_scales_t scales; // how it scales the turning; commands that the log misses look like it
  // It does nothing at a thrust equal to the weight. If a log misses commands, its part that scales the
  // turning is left out, and the forces tell it.
  bool about_weight;
  // It changes the thrust of all rotors: if no force along z is compared, only its scale of the turning
  // shows.
  bool scales_thrust;
  bool by_thrust; // its load grows with the rotors' thrust: effects that scale the thrust change it, too
  int n_size;
  fx_size_t size[FX_SIZE_MAX];
  // The model may lack the sizes from this one on without those before: they are a candidate of their own,
  // with other rivals. 0: all sizes are one candidate.
  int size_apart;
  const char *apart_name; // the printed name of that candidate
  // The parameter that is tried at these values; n_shape 0: none. For a surface the values are the form's.
  int shape_param, n_shape;
  double shape[FX_SHAPE_MAX];
  bool shape_by_cell; // the values are for one battery cell; there may be several in series
  // The parameter that selects one of a few kinds (where a force acts, whether the torque follows the
  // thrust): each is tried with each shape, and nothing between them. n_kind 0: there is one kind. For a
  // surface it is the form's last parameter (fx_use_kind).
  int kind_param, n_kind;
  double kind[FX_KIND_MAX];
  int surface;              // SURFACE_*: takes form=; 0: takes the parameters below
  const char *form_initial; // where surface != 0
  int n_param;
  fx_param_t param[FX_PARAM_MAX];
  // Returns the factor on the rotor's thrust, minus one. Several effects add (thesis 3.1.4).
  double (*excess)(const struct fx_use *use, const fx_place_t *place);
  // Six degrees of freedom only: adds to force and moment on the body.
  void (*load)(const struct fx_use *use, const fx_motion_t *motion, load_t *load);
  // Six degrees of freedom only: once at the beginning of every tick.
  void (*tick)(const struct fx_use *use, const fx_tick_t *tick, fx_plant_t *plant);
  // Its tick() reads neither `tick` (null) nor what other effects did, and sets neither wind nor force: it is
  // called once, before the effects that are not steady.
  bool steady;
  // Six degrees of freedom only: changes what accelerometer and range sensors read.
  void (*sense)(const struct fx_use *use, fx_sensed_t *sensed);
} fx_t; // a hook that is null does nothing

// Adds a force that acts at the hub.
static inline void fx_push_hub(const fx_hub_t *hub, d3_t force_b_N, load_t *load) {
  load_add(load, force_b_N, d3_cross(hub->at_b_m, force_b_N));
}

extern const fx_t *const fx_table[];
extern const int fx_count;
extern const char fx_law_symbols[]; // what the letters of all laws mean, for people

// An effect that is switched on, with its numbers: those of the form where there is one, else its own.
typedef struct fx_use {
  const fx_t *fx;
  const curve_t *form;
  double p[FX_PARAM_MAX];
  curve_points_t points;
} fx_use_t;

// Returns what to fly to tell the two apart, in either order; null: neither says it.
const char *fx_apart(const fx_t *a, const fx_t *b);

// Null pointers where there is no such name.
const fx_t *fx_find(const char *name);
const curve_t *curve_find(const char *name);

// Returns the places with all rotors at the distance of their middle.
static inline fx_places_t fx_middle(const fx_places_t *at) {
  fx_places_t mean = {.radius_m = at->radius_m};
  double ceiling_m = 0.0, ground_m = 0.0;
  for (int i = 0; i < ROTORS; i++)
    ceiling_m += at->ceiling_gap_m[i] / ROTORS, ground_m += at->ground_gap_m[i] / ROTORS;
  for (int i = 0; i < ROTORS; i++) mean.ceiling_gap_m[i] = ceiling_m, mean.ground_gap_m[i] = ground_m;
  return mean;
}

// Adds the effect's excess at each rotor. The effect must have the hook.
static inline void fx_add_excess(const fx_use_t *use, const fx_places_t *each, double ratio[ROTORS]) {
  fx_places_t mean;
  const fx_places_t *at = each;
  if (use->form && use->p[use->form->n_param - 1] < 0.5) {
    mean = fx_middle(each);
    at = &mean;
  }
  if (!use->form || !use->form->add_excess) {
    for (int i = 0; i < ROTORS; i++) {
      const fx_place_t place = {at->ceiling_gap_m[i], at->ground_gap_m[i], at->radius_m};
      ratio[i] += use->fx->excess(use, &place);
    }
    return;
  }
  const double *gap_m = use->fx->surface == SURFACE_CEILING ? at->ceiling_gap_m : at->ground_gap_m;
  use->form->add_excess(use->p, gap_m, at->radius_m, ratio);
}

// The effect with its first form (if it takes one) and nominal numbers.
fx_use_t fx_use(const fx_t *fx);

// Changes the form; its parameters become nominal. The form's `surfaces` must hold the effect's.
void fx_use_form(fx_use_t *use, const curve_t *form);

// Size k of the effect (fx->size[k]).
static inline double fx_use_size(const fx_use_t *use, int k) {
  return use->p[use->fx->size[k].param];
}
static inline void fx_use_resize(fx_use_t *use, int k, double value) {
  use->p[use->fx->size[k].param] = value;
}

// The parameters that use->p belongs to; *n gets their number.
const fx_param_t *fx_use_params(const fx_use_t *use, int *n);

// Returns the parameter that selects its kind.
static inline int fx_use_kind(const fx_use_t *use) {
  return use->form ? use->form->n_param - 1 : use->fx->kind_param;
}

// Returns how many values are tried for the shape in its present form, and the values; 0: it has no shape.
static inline int fx_use_shapes(const fx_use_t *use, const double **shape) {
  *shape = use->form ? use->form->shape : use->fx->shape;
  return use->form ? use->form->n_shape : use->fx->n_shape;
}

static inline bool fx_use_has_shape(const fx_use_t *use) {
  const double *shape;
  return fx_use_shapes(use, &shape) > 0;
}

// Returns its shape, which must be there.
static inline double fx_use_shape(const fx_use_t *use) {
  return use->p[use->fx->shape_param];
}

#endif
