// body_forces.c - what acts on a vehicle.
#include "body/body.h"

int body_surfaces_of(const fx_use_t *use) {
  return use->fx->surface ? use->fx->surface : SURFACES;
}

static inline acting_t forces_of(const body_t *b) {
  return (acting_t){.rigid = &b->rigid,
                    .touch = &b->touch,
                    .plant = &b->plant,
                    .excess = b->excess,
                    .load = b->load,
                    .n_excess = b->n_excess,
                    .n_load = b->n_load,
                    .excess_of = b->excess_of,
                    .ticks = b->n_tick > 0,
                    .push = b->pushed ? &b->push : NULL};
}

PAIR_COPIES void body_look(const body_t *b, int surfaces, const double *y, body_look_t *look) {
  const acting_t f = forces_of(b);
  forces_look(&f, surfaces, y, look);
}

void body_look_load(const body_t *b, const double *y, body_look_t *look) {
  const acting_t f = forces_of(b);
  forces_load(&f, 0, y, look);
}

void body_look_more(const body_t *b, const fx_use_t *more, const double *y, body_look_t *look) {
  const acting_t f = forces_of(b);
  forces_look_more(&f, more, y, look);
}

PAIR_COPIES void body_derivative_seen(const body_t *b, const double *y, const body_look_t *look,
                                      double *dydt) {
  const acting_t f = forces_of(b);
  forces_derivative(&f, y, look, dydt);
}

PAIR_COPIES void body_derivative(const body_t *b, int surfaces, const double *y, double *dydt) {
  const acting_t f = forces_of(b);
  body_look_t look;
  forces_look(&f, surfaces, y, &look);
  forces_derivative(&f, y, &look, dydt);
}

PAIR_COPIES void body_next_derivative(void *self, const double *y, double *dydt) {
  body_t *b = self;
  const acting_t f = forces_of(b);
  if (!b->look_is_y) {
    body_look_t look;
    forces_look(&f, b->surfaces, y, &look);
    forces_derivative(&f, y, &look, dydt);
    return;
  }
  // Every integrator makes the first call of a tick at the tick's start.
  forces_derivative(&f, y, &b->look, dydt);
  b->look_is_y = false;
}

d3_t body_pull_b_mps2(const body_t *b, const double *y, const body_look_t *look, d3_t *turn_radps2) {
  const acting_t f = forces_of(b);
  return forces_pull_b_mps2(&f, y, look, turn_radps2);
}

int body_near(const body_t *b, double span_s) {
  const acting_t f = forces_of(b);
  const axes_t axes = b->look_is_y ? b->look.axes : axes_of(dq_of(b->y + RIGID_Q_WB));
  return forces_near(&f, b->y, &axes, span_s);
}

double body_ceiling_gap_m(const body_t *b, int rotor) {
  const acting_t f = forces_of(b);
  return forces_ceiling_gap_m(&f, b->y, &b->look.axes, rotor);
}

double body_rotors_N(const body_t *b) {
  return forces_rotors_N(b->y);
}

PAIR_COPIES double body_gap_m(const body_t *b) {
  const acting_t f = forces_of(b);
  return forces_gap_m(&f, b->y, &b->look.axes);
}

void body_current_left(const body_t *b, double left[ROTORS]) {
  forces_current_left(&b->look, left);
}

PAIR_COPIES d3_t body_specific_force_b_mps2(const body_t *b) {
  const acting_t f = forces_of(b);
  return forces_specific_b_mps2(&f, b->y, &b->look, d3_of(b->model->frame.imu_m));
}

sensed_from_t body_sensed_from(const model_t *m) {
  return (sensed_from_t){d3_of(m->frame.imu_m), body_rotor_z_m(m), body_rest_z_m(m)};
}

PAIR_COPIES void body_sensed(const body_t *b, fx_sensed_t *above, fx_sensed_t *below) {
  const acting_t f = forces_of(b);
  const sensed_from_t from = body_sensed_from(b->model);
  forces_sensed(&f, b->y, &b->look, &from, above, below);
  if (b->n_sense == 0) return;
  model_sense(b->model, above);
  model_sense(b->model, below);
}
