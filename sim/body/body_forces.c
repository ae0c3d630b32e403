// body_forces.c - what acts on a vehicle.
#include "body/body.h"

#include "base/pair.h"
#include "plant/rigid.h"
#include <math.h>
#include <string.h>

// --- forces -------------------------------------------------------------------------------------------

// How far each rotor is from the place of the centre of mass, along a direction in body axes.
static inline pair_t along(const rigid_t *r, int i, d3_t to) {
  return to.x * pair_of(r->rotor_x_m + i) + to.y * pair_of(r->rotor_y_m + i) +
         to.z * pair_of(r->rotor_z_m + i);
}

#define SURFACES (SURFACE_CEILING | SURFACE_GROUND)

int body_surfaces_of(const fx_use_t *use) {
  return use->fx->surface ? use->fx->surface : SURFACES;
}

// How far the rotors are from the ceiling, and from the ground if it is asked for; pos_w_m: of the centre of
// mass.
static inline fx_places_t places_of(const body_t *b, int surfaces, d3_t pos_w_m, const axes_t *axes) {
  const d3_t up = axes_up_b(axes);
  const rigid_t *r = &b->rigid;
  const pair_t zero = pair_both(0.0), nowhere = pair_both(HUGE_VAL);
  fx_places_t at;
  at.radius_m = b->model->rotor_radius_m;
  for (int i = 0; i < ROTORS; i += 2) {
    pair_put(at.ceiling_gap_m + i, pair_max(b->touch.ceiling_m - (pos_w_m.z + along(r, i, up)), zero));
    pair_put(at.ground_gap_m + i, nowhere);
  }
  if (!(surfaces & SURFACE_GROUND)) return at;
  const d3_t floor_up = axes_to_body(axes, b->touch.floor_up_w);
  const double above_m = touch_above_floor_m(&b->touch, pos_w_m);
  for (int i = 0; i < ROTORS; i += 2)
    pair_put(at.ground_gap_m + i, pair_max(above_m + along(r, i, floor_up), zero));
  return at;
}

// What the surroundings multiply each rotor's thrust by.
static inline void look_at_surfaces(const body_t *b, const double *y, const axes_t *axes,
                                    double ratio[ROTORS]) {
  for (int i = 0; i < ROTORS; i++) ratio[i] = 1.0;
  if (b->n_excess == 0) return;
  const fx_places_t at = places_of(b, b->excess_of, d3_of(y + RIGID_POS_M), axes);
  for (int k = 0; k < b->n_excess; k++) fx_add_excess(b->excess[k], &at, ratio);
}

static inline void look_at_speeds(const body_t *b, const double *y, body_look_t *look) {
  rigid_rotor_radps(&b->rigid, y + RIGID_THRUST_N, look->speed_radps);
  for (int i = 0; i < ROTORS; i += 2)
    pair_put(look->turning + i, inflow_turning(pair_of(look->ratio + i), pair_of(b->rigid.faster + i)));
}

// Written in place: who takes it copied waits for each of these stores.
static inline void move(const body_t *b, const double *y, const body_look_t *look, fx_motion_t *motion) {
  const axes_t *const axes = &look->axes;
  motion->pos_w_m = d3_of(y + RIGID_POS_M);
  motion->air_b_mps = axes_to_body(axes, d3_sub(d3_of(y + RIGID_VEL_MPS), b->plant.air_w_mps));
  motion->rate_b_radps = d3_of(y + RIGID_RATE_RADPS);
  motion->axes = axes;
  motion->hub_b_m = b->touch.disc;
  motion->spin = b->rigid.spin;
  for (int i = 0; i < ROTORS; i += 2)
    pair_put(motion->rotor_radps + i, pair_of(look->turning + i) * pair_of(look->speed_radps + i));
}

static void effects_load(const body_t *b, const double *y, body_look_t *look) {
  fx_motion_t motion;
  move(b, y, look, &motion);
  for (int k = 0; k < b->n_load; k++) b->load[k]->fx->load(b->load[k], &motion, &look->load);
}

static inline void look_at(const body_t *b, int surfaces, const double *y, body_look_t *look) {
  look->axes = axes_of(dq_of(y + RIGID_Q_WB));
  look_at_surfaces(b, y, &look->axes, look->ratio);
  look_at_speeds(b, y, look);
  look->loaded = b->n_tick > 0 || b->n_load > 0 || b->pushed || surfaces;
  if (!look->loaded) return;
  look->load = (load_t){{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  if (b->n_tick > 0)
    look->load = (load_t){axes_to_body(&look->axes, b->plant.force_w_N), b->plant.moment_b_Nm};
  if (b->pushed) load_add(&look->load, axes_to_body(&look->axes, b->push_w_N), (d3_t){0.0, 0.0, 0.0});
  if (b->n_load > 0) effects_load(b, y, look);
  if (!surfaces) return;
  const int near = surfaces & touch_near(&b->touch, d3_of(y + RIGID_POS_M), &look->axes, 0.0);
  if (near) touch_load(&b->touch, near, y, &look->axes, &look->load);
}

void body_look(const body_t *b, int surfaces, const double *y, body_look_t *look) {
  look_at(b, surfaces, y, look);
}

void body_look_more(const body_t *b, const fx_use_t *more, const double *y, body_look_t *look) {
  if (more->fx->excess) {
    const fx_places_t at = places_of(b, body_surfaces_of(more), d3_of(y + RIGID_POS_M), &look->axes);
    fx_add_excess(more, &at, look->ratio);
    look_at_speeds(b, y, look);
  }
  if (!more->fx->load) return;
  if (!look->loaded) look->load = (load_t){{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  look->loaded = true;
  fx_motion_t motion;
  move(b, y, look, &motion);
  more->fx->load(more, &motion, &look->load);
}

static inline void derivative_seen(const body_t *b, const double *y, const body_look_t *look, double *dydt) {
  rigid_derivative(&b->rigid, y, &look->axes, look->speed_radps, look->ratio, look->turning,
                   look->loaded ? &look->load : NULL, dydt);
}

void body_derivative_seen(const body_t *b, const double *y, const body_look_t *look, double *dydt) {
  derivative_seen(b, y, look, dydt);
}

void body_derivative(const body_t *b, int surfaces, const double *y, double *dydt) {
  body_look_t look;
  look_at(b, surfaces, y, &look);
  derivative_seen(b, y, &look, dydt);
}

// --- the model, as the effects leave it ------------------------------------------------------------------

void body_surround(touch_t *t, const model_t *model) {
  t->ceiling_m = model->ceiling_m;
  t->wall_y_m = model->wall_solid ? model->wall_y_m : HUGE_VAL;
  t->floor_up_w = model_floor_up_w(model);
  t->disc_radius_m = model->rotor_radius_m;
}

void body_place(body_t *b, d3_t cg) {
  const frame_t *f = &b->model->frame;
  const double rotor_z = body_rotor_z_m(b->model), top_z = rotor_z + f->top_above_rotor_m,
               half = f->top_half_m;
  for (int i = 0; i < ROTORS; i++) {
    const double x = f->rotor_x_m[i], y = f->rotor_y_m[i];
    const d3_t at = d3_sub(d3(x, y, rotor_z), cg);
    b->touch.disc[i] = at;
    b->rigid.rotor_x_m[i] = at.x;
    b->rigid.rotor_y_m[i] = at.y;
    b->rigid.rotor_z_m[i] = at.z;
    b->touch.foot[i] = d3_sub(d3(x, y, -f->cg_above_feet_m), cg);
    b->touch.top[i] = d3_sub(d3(copysign(half, x), copysign(half, y), top_z), cg);
  }
  touch_init(&b->touch, b->model->mass_kg);
}

fx_plant_t body_untouched(const model_t *m) {
  const double *const more = m->rotor_more;
  return (fx_plant_t){.mass_kg = m->mass_kg,
                      .inertia_scale = {1.0, 1.0, 1.0},
                      .thrust_scale = {1.0 + more[0], 1.0 + more[1], 1.0 + more[2], 1.0 + more[3]},
                      .torque_scale = {1.0, 1.0, 1.0, 1.0},
                      .motor_tau_s = m->motor_tau_s,
                      .delay_s = m->frame.motor_delay_s};
}

// Divisions only where something has changed.
static void take_inertia(rigid_t *r, const fx_plant_t *plant, d3_t J_kgm2) {
  const d3_t was = r->inertia_kgm2;
  if (r->mass_kg == plant->mass_kg && r->motor_tau_s == plant->motor_tau_s && was.x == J_kgm2.x &&
      was.y == J_kgm2.y && was.z == J_kgm2.z)
    return;
  r->inertia_kgm2 = J_kgm2;
  r->mass_kg = plant->mass_kg;
  r->motor_tau_s = plant->motor_tau_s;
  rigid_tune(r);
}

void body_effects(body_t *b, double span_s) {
  const model_t *m = b->model;
  const d3_t cg_before = b->plant.cg_b_m;
  b->plant = body_untouched(m);
  const axes_t axes = axes_of(dq_of(b->y + RIGID_Q_WB));
  fx_place_t place[ROTORS];
  const fx_places_t at = places_of(b, SURFACES, d3_of(b->y + RIGID_POS_M), &axes);
  for (int i = 0; i < ROTORS; i++)
    place[i] = (fx_place_t){at.ceiling_gap_m[i], at.ground_gap_m[i], at.radius_m};
  for (int k = 0; k < m->n_fx; k++) {
    const fx_tick_t tick = {.t_s = b->t_s,
                            .span_s = span_s,
                            .vbat_V = b->vbat_V,
                            .thrust_N = b->y + RIGID_THRUST_N,
                            .place = place,
                            .random = b->random,
                            .memory = b->memory[k]};
    if (m->fx[k].fx->tick) m->fx[k].fx->tick(&m->fx[k], &tick, &b->plant);
  }
  const d3_t J = d3_of(m->frame.inertia_kgm2), grown = b->plant.inertia_scale;
  take_inertia(&b->rigid, &b->plant, d3(J.x * grown.x, J.y * grown.y, J.z * grown.z));
  memcpy(b->rigid.thrust_scale, b->plant.thrust_scale, sizeof b->rigid.thrust_scale);
  memcpy(b->rigid.torque_scale, b->plant.torque_scale, sizeof b->rigid.torque_scale);
  memcpy(b->rigid.faster, b->plant.faster, sizeof b->rigid.faster);
  if (d3_norm(d3_sub(b->plant.cg_b_m, cg_before)) > 0.0) body_place(b, b->plant.cg_b_m);
}
