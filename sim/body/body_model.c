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

void body_effects(body_t *b, double span_s) {
  const d3_t cg_before = b->plant.cg_b_m;
  const acting_t f = {.rigid = &b->rigid, .touch = &b->touch};
  const forces_tick_t tick = {.use = b->tick,
                              .n = b->n_tick,
                              .untouched = &b->untouched,
                              .inertia_kgm2 = d3_of(b->model->frame.inertia_kgm2),
                              .t_s = b->t_s,
                              .span_s = span_s,
                              .vbat_V = b->vbat_V,
                              .random = b->random,
                              .memory = b->memory};
  forces_plant(&f, &tick, b->y, &b->plant);
  b->changed += forces_take_plant(&b->plant, tick.inertia_kgm2, &b->rigid);
  if (!(d3_norm(d3_sub(b->plant.cg_b_m, cg_before)) > 0.0)) return;
  body_place(b, b->plant.cg_b_m);
  b->changed++;
}
