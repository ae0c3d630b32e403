// body_model.c - the model, as the effects leave it for a tick.
#include "body/body.h"

#include "plant/rigid.h"
#include <math.h>
#include <string.h>

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

// Divisions only where something has changed; whether it has.
static bool take_inertia(rigid_t *r, const fx_plant_t *plant, d3_t J_kgm2) {
  const d3_t was = r->inertia_kgm2;
  if (r->mass_kg == plant->mass_kg && r->motor_tau_s == plant->motor_tau_s && was.x == J_kgm2.x &&
      was.y == J_kgm2.y && was.z == J_kgm2.z)
    return false;
  r->inertia_kgm2 = J_kgm2;
  r->mass_kg = plant->mass_kg;
  r->motor_tau_s = plant->motor_tau_s;
  rigid_tune(r);
  return true;
}

static void place_rotors(const body_t *b, fx_place_t place[ROTORS]) {
  const fx_places_t at = body_places(b);
  for (int i = 0; i < ROTORS; i++)
    place[i] = (fx_place_t){at.ceiling_gap_m[i], at.ground_gap_m[i], at.radius_m};
}

void body_effects(body_t *b, double span_s) {
  const model_t *m = b->model;
  const d3_t cg_before = b->plant.cg_b_m;
  b->plant = b->untouched;
  for (int k = 0; k < m->n_fx; k++) {
    const fx_t *const fx = m->fx[k].fx;
    if (!fx->tick) continue;
    fx_place_t place[ROTORS];
    const bool placed = fx->needs & FX_NEEDS_POSITION;
    if (placed) place_rotors(b, place);
    const fx_tick_t tick = {.t_s = b->t_s,
                            .span_s = span_s,
                            .vbat_V = b->vbat_V,
                            .thrust_N = b->y + RIGID_THRUST_N,
                            .place = placed ? place : NULL,
                            .random = b->random,
                            .memory = b->memory[k]};
    fx->tick(&m->fx[k], &tick, &b->plant);
  }
  const d3_t J = d3_of(m->frame.inertia_kgm2), grown = b->plant.inertia_scale;
  b->changed += take_inertia(&b->rigid, &b->plant, d3(J.x * grown.x, J.y * grown.y, J.z * grown.z));
  memcpy(b->rigid.thrust_scale, b->plant.thrust_scale, sizeof b->rigid.thrust_scale);
  memcpy(b->rigid.torque_scale, b->plant.torque_scale, sizeof b->rigid.torque_scale);
  memcpy(b->rigid.faster, b->plant.faster, sizeof b->rigid.faster);
  if (!(d3_norm(d3_sub(b->plant.cg_b_m, cg_before)) > 0.0)) return;
  body_place(b, b->plant.cg_b_m);
  b->changed++;
}
