// forces.h - what acts on a vehicle in a given state: rotors, surroundings, effects, contact. Header only,
// for code that moves one vehicle and code that moves eight at a time.
//
// Its input is an acting_t, and it does not depend on ticks, so that all its numbers may be those of eight
// vehicles (base/lane.hpp). It does not branch on a number where where() can do the same.
#ifndef SIM_BODY_FORCES_H
#define SIM_BODY_FORCES_H

#include "base/larger.h"
#include "base/few.h"
#include "effects/fx.h"
#include "plant/rigid.h"
#include "plant/touch.h"
#include <math.h>
#include <stdbool.h>

#define FORCES_MARGIN_M 2e-3  // a vehicle may come this much nearer in a tick than its speed says
#define FORCES_FAR_M    0.3   // from the ceiling, for the centre of mass
#define FORCES_IDLE_N   0.002 // below this thrust, a rotor counts as standing

// All that the derivative at a state needs besides the commands.
typedef struct {
  axes_t axes;
  double ratio[ROTORS], speed_radps[ROTORS]; // speed: in free air
  double turning[ROTORS];                    // factor of that speed
  load_t load;
  bool loaded; // else load is not set: nothing acts but the rotors
} body_look_t;

// An additional force and moment at the centre of mass.
typedef struct {
  d3_t force_w_N, moment_b_Nm;
} push_t;

// The vehicle, as it is in this tick.
typedef struct {
  const rigid_t *rigid;
  const touch_t *touch;
  const fx_plant_t *plant;
  const fx_use_t *const *excess, *const *load; // effects with those hooks
  int n_excess, n_load;
  int excess_of;      // SURFACE_* on which they depend
  bool ticks;         // effects change the plant at ticks
  const push_t *push; // null: none
} acting_t;

// Distance of each rotor from the centre of mass along a direction in body axes.
FEW_INLINE few_t forces_along(const rigid_t *r, int i, d3_t to) {
  return to.x * few_of(r->rotor_x_m + i) + to.y * few_of(r->rotor_y_m + i) + to.z * few_of(r->rotor_z_m + i);
}

#define SURFACES (SURFACE_CEILING | SURFACE_GROUND)

// Distances of the rotors from the ceiling and, if in `surfaces`, from the ground. pos_w_m: centre of mass.
static inline fx_places_t forces_places(const acting_t *f, int surfaces, d3_t pos_w_m, const axes_t *axes) {
  const d3_t up = axes_up_b(axes);
  const rigid_t *r = f->rigid;
  const touch_t *t = f->touch;
  const few_t zero = few_all(0.0), nowhere = few_all(HUGE_VAL);
  fx_places_t at;
  at.radius_m = t->disc_radius_m;
  for (int i = 0; i < ROTORS; i += FEW_N) {
    few_put(at.ceiling_gap_m + i, few_max(t->ceiling_m - (pos_w_m.z + forces_along(r, i, up)), zero));
    few_put(at.ground_gap_m + i, nowhere);
  }
  if (!(surfaces & SURFACE_GROUND)) return at;
  const d3_t floor_up = axes_to_body(axes, t->floor_up_w);
  const double above_m = touch_above_floor_m(t, pos_w_m);
  for (int i = 0; i < ROTORS; i += FEW_N)
    few_put(at.ground_gap_m + i, few_max(above_m + forces_along(r, i, floor_up), zero));
  return at;
}

// Factor of each rotor's thrust due to the surroundings.
static inline void forces_surfaces(const acting_t *f, const double *y, const axes_t *axes,
                                   double ratio[ROTORS]) {
  for (int i = 0; i < ROTORS; i++) ratio[i] = 1.0;
  if (f->n_excess == 0) return;
  const fx_places_t at = forces_places(f, f->excess_of, d3_of(y + RIGID_POS_M), axes);
  for (int k = 0; k < f->n_excess; k++) fx_add_excess(f->excess[k], &at, ratio);
}

static inline void forces_speeds(const acting_t *f, const double *y, body_look_t *look) {
  rigid_rotor_radps(f->rigid, y + RIGID_THRUST_N, look->speed_radps);
  for (int i = 0; i < ROTORS; i += FEW_N)
    few_put(look->turning + i, inflow_turning(few_of(look->ratio + i), few_of(f->rigid->faster + i)));
}

// Writes in place: copying the struct would have to wait for each of these stores.
static inline void forces_motion(const acting_t *f, const double *y, const body_look_t *look,
                                 fx_motion_t *motion) {
  const axes_t *const axes = &look->axes;
  motion->pos_w_m = d3_of(y + RIGID_POS_M);
  motion->air_b_mps = axes_to_body(axes, d3_sub(d3_of(y + RIGID_VEL_MPS), f->plant->air_w_mps));
  motion->rate_b_radps = d3_of(y + RIGID_RATE_RADPS);
  motion->axes = axes;
  motion->hub_b_m = f->touch->disc;
  motion->rigid = f->rigid;
  for (int i = 0; i < ROTORS; i += FEW_N)
    few_put(motion->rotor_radps + i, few_of(look->turning + i) * few_of(look->speed_radps + i));
}

// Not inline, because most vehicles have no such effect.
static void forces_effects(const acting_t *f, const double *y, body_look_t *look) {
  fx_motion_t motion;
  forces_motion(f, y, look, &motion);
  for (int k = 0; k < f->n_load; k++) f->load[k]->fx->load(f->load[k], &motion, &look->load);
}

// Forces and moments on the body, except the rotors'. surfaces: as below.
static inline void forces_load(const acting_t *f, int surfaces, const double *y, body_look_t *look) {
  look->loaded = f->ticks || f->n_load > 0 || f->push || surfaces;
  if (!look->loaded) return;
  look->load = (load_t){{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  if (f->ticks) look->load = (load_t){axes_to_body(&look->axes, f->plant->force_w_N), f->plant->moment_b_Nm};
  if (f->push) load_add(&look->load, axes_to_body(&look->axes, f->push->force_w_N), f->push->moment_b_Nm);
  if (f->n_load > 0) forces_effects(f, y, look);
  if (!surfaces) return;
  const int near = surfaces & touch_near(f->touch, d3_of(y + RIGID_POS_M), &look->axes, 0.0);
  if (near) touch_load(f->touch, near, y, &look->axes, &look->load);
}

// What acts at state y. surfaces: TOUCH_* that may be near; others are ignored.
static inline void forces_look(const acting_t *f, int surfaces, const double *y, body_look_t *look) {
  look->axes = axes_of(dq_of(y + RIGID_Q_WB));
  forces_surfaces(f, y, &look->axes, look->ratio);
  forces_speeds(f, y, look);
  forces_load(f, surfaces, y, look);
}

// Adds what one more effect does to rotors and body.
static inline void forces_look_more(const acting_t *f, const fx_use_t *more, const double *y,
                                    body_look_t *look) {
  if (more->fx->excess) {
    const int surfaces = more->fx->surface ? more->fx->surface : SURFACES;
    const fx_places_t at = forces_places(f, surfaces, d3_of(y + RIGID_POS_M), &look->axes);
    fx_add_excess(more, &at, look->ratio);
    forces_speeds(f, y, look);
  }
  if (!more->fx->load) return;
  if (!look->loaded) look->load = (load_t){{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  look->loaded = true;
  fx_motion_t motion;
  forces_motion(f, y, look, &motion);
  more->fx->load(more, &motion, &look->load);
}

// dydt at state y, where *look holds what acts there.
static inline void forces_derivative(const acting_t *f, const double *y, const body_look_t *look,
                                     double *dydt) {
  rigid_derivative(f->rigid, y, &look->axes, look->speed_radps, look->ratio, look->turning,
                   look->loaded ? &look->load : NULL, dydt);
}

// Specific force at the centre of mass, body axes, and the angular acceleration.
static inline d3_t forces_pull_b_mps2(const acting_t *f, const double *y, const body_look_t *look,
                                      d3_t *turn_radps2) {
  double dydt[RIGID_N];
  forces_derivative(f, y, look, dydt);
  *turn_radps2 = d3_of(dydt + RIGID_RATE_RADPS);
  return axes_to_body(&look->axes,
                      d3(dydt[RIGID_VEL_MPS], dydt[RIGID_VEL_MPS + 1], dydt[RIGID_VEL_MPS + 2] + G_MPS2));
}

// --- effects at the beginning of a tick ------------------------------------------------------------------

typedef struct {
  const fx_use_t *const *use; // the effects with that hook
  int n;
  const fx_plant_t *untouched; // the model's numbers
  d3_t inertia_kgm2;           // of the model
  double t_s, span_s, vbat_V;
  random_t *random;
  double (*memory)[FX_MEMORY]; // of each effect
} forces_tick_t;

// Applies these effects to the model's numbers.
static inline void forces_plant(const acting_t *f, const forces_tick_t *t, const double *y,
                                fx_plant_t *plant) {
  *plant = *t->untouched;
  for (int k = 0; k < t->n; k++) {
    const fx_t *const fx = t->use[k]->fx;
    fx_place_t place[ROTORS];
    const bool placed = fx->needs & FX_NEEDS_POSITION;
    if (placed) {
      const axes_t axes = axes_of(dq_of(y + RIGID_Q_WB));
      const fx_places_t all = forces_places(f, SURFACES, d3_of(y + RIGID_POS_M), &axes);
      for (int i = 0; i < ROTORS; i++)
        place[i] = (fx_place_t){all.ceiling_gap_m[i], all.ground_gap_m[i], all.radius_m};
    }
    const fx_tick_t tick = {t->t_s,    t->span_s,   t->vbat_V, y + RIGID_THRUST_N, placed ? place : NULL,
                            t->random, t->memory[k]};
    fx->tick(t->use[k], &tick, plant);
  }
}

// Copies the result to *r. Divides only if something has changed, and returns whether it has.
static inline bool forces_take_plant(const fx_plant_t *plant, d3_t inertia_kgm2, rigid_t *r) {
  const d3_t was = r->inertia_kgm2, grown = plant->inertia_scale;
  const d3_t J = d3(inertia_kgm2.x * grown.x, inertia_kgm2.y * grown.y, inertia_kgm2.z * grown.z);
  const bool other = any_of(r->mass_kg != plant->mass_kg) || any_of(r->motor_tau_s != plant->motor_tau_s) ||
                     any_of(was.x != J.x) || any_of(was.y != J.y) || any_of(was.z != J.z);
  for (int i = 0; i < ROTORS; i++) {
    r->thrust_scale[i] = plant->thrust_scale[i];
    r->torque_scale[i] = plant->torque_scale[i];
    r->faster[i] = plant->faster[i];
  }
  if (!other) return false;
  r->inertia_kgm2 = J;
  r->mass_kg = plant->mass_kg;
  r->motor_tau_s = plant->motor_tau_s;
  rigid_tune(r);
  return true;
}

// --- looking ---------------------------------------------------------------------------------------------

// The surfaces that may be touched within span_s.
static inline int forces_near(const acting_t *f, const double *y, const axes_t *axes, double span_s) {
  const touch_t *const t = f->touch;
  const d3_t rate = d3_of(y + RIGID_RATE_RADPS), vel = d3_of(y + RIGID_VEL_MPS);
  const bool level = t->floor_up_w.z == 1.0 && !isfinite(t->wall_y_m);
  const double speed = (level ? fabs(vel.z) : d3_norm(vel)) +
                       t->beside_m * (fabs(rate.x) + fabs(rate.y) + (level ? 0.0 : fabs(rate.z)));
  return touch_near(t, d3_of(y + RIGID_POS_M), axes, FORCES_MARGIN_M + speed * span_s);
}

static inline double forces_rotor_z_m(const acting_t *f, const double *y, const axes_t *axes, int rotor) {
  const rigid_t *const r = f->rigid;
  return y[RIGID_POS_M + 2] +
         d3_dot(axes_up_b(axes), d3(r->rotor_x_m[rotor], r->rotor_y_m[rotor], r->rotor_z_m[rotor]));
}

// Distance from the rotor's centre to the ceiling, >= 0; HUGE_VAL if there is none.
static inline double forces_ceiling_gap_m(const acting_t *f, const double *y, const axes_t *axes, int rotor) {
  const double gap_m = f->touch->ceiling_m - forces_rotor_z_m(f, y, axes, rotor);
  return where(gap_m > 0.0, gap_m, 0.0);
}

// The smallest such distance; far from the ceiling the first rotor's is accurate enough.
static inline double forces_gap_m(const acting_t *f, const double *y, const axes_t *axes) {
  const fx_places_t at = forces_places(f, SURFACE_CEILING, d3_of(y + RIGID_POS_M), axes);
  const double *const each_m = at.ceiling_gap_m;
  double gap_m = each_m[0];
  for (int i = 1; i < ROTORS; i++) gap_m = where(each_m[i] < gap_m, each_m[i], gap_m);
  return where(f->touch->ceiling_m - y[RIGID_POS_M + 2] > FORCES_FAR_M, each_m[0], gap_m);
}

static inline double forces_rotors_N(const double *y) {
  double sum_N = 0.0;
  for (int i = 0; i < ROTORS; i++) sum_N += y[RIGID_THRUST_N + i];
  return sum_N;
}

// Each rotor's current over that in free air.
static inline void forces_current_left(const body_look_t *look, double left[ROTORS]) {
  for (int i = 0; i < ROTORS; i += FEW_N) few_put(left + i, inflow_torque(few_of(look->turning + i)));
}

// What perfect sensors need from the vehicle file; heights above its centre of mass.
typedef struct {
  d3_t imu_m;
  double rotor_z_m, rest_z_m;
} sensed_from_t;

// Specific force at the accelerometer, body axes.
static inline d3_t forces_specific_b_mps2(const acting_t *f, const double *y, const body_look_t *look,
                                          d3_t imu_m) {
  double dydt[RIGID_N];
  forces_derivative(f, y, look, dydt);
  const d3_t rate = d3_of(y + RIGID_RATE_RADPS), turn = d3_of(dydt + RIGID_RATE_RADPS);
  const d3_t imu = d3_sub(imu_m, f->plant->cg_b_m);
  const d3_t acc_w = d3_add(d3_of(dydt + RIGID_VEL_MPS), d3(0.0, 0.0, G_MPS2));
  return d3_add(axes_to_body(&look->axes, acc_w),
                d3_add(d3_cross(turn, imu), d3_cross(rate, d3_cross(rate, imu))));
}

// What perfect sensors read, before the effects on sensors. The range sensors are taken to lie on the axis,
// in the rotors' plane and at the feet.
static inline void forces_sensed(const acting_t *f, const double *y, const body_look_t *look,
                                 const sensed_from_t *from, fx_sensed_t *above, fx_sensed_t *below) {
  const axes_t *const axes = &look->axes;
  const d3_t floor_up_w = f->touch->floor_up_w, pos_w_m = d3_of(y + RIGID_POS_M);
  const double up = larger(axes_up_b(axes).z, 1e-3), floor_up = larger(d3_dot(axes->z, floor_up_w), 1e-3);
  above->acc_b_mps2 = forces_specific_b_mps2(f, y, look, from->imu_m);
  above->range_m = (f->touch->ceiling_m - y[RIGID_POS_M + 2] - from->rotor_z_m) / up;
  above->range_rate_mps = -(y[RIGID_VEL_MPS + 2] / up);
  below->acc_b_mps2 = d3(0.0, 0.0, 0.0);
  below->range_m = (touch_above_floor_m(f->touch, pos_w_m) - from->rest_z_m) / floor_up;
  below->range_rate_mps = d3_dot(floor_up_w, d3_of(y + RIGID_VEL_MPS)) / floor_up;
}

#endif
