// lanes.cpp - eight vehicles side by side: the sources of what acts on one, compiled for eight.
#include "body/lanes.h"

#ifdef __AVX2__
#include <new>

#include "base/lane.hpp"

namespace {

// Random numbers come at ticks alone, which each vehicle does for itself.
#define SIM_BASE_RANDOM_H
struct random_t;
inline double random_normal(random_t *) {
  lanes_in = 0;
  return 0.0;
}
inline double random_uniform(random_t *r, double, double) {
  return random_normal(r);
}
inline void random_triangles(random_t *r, int n, double *out) {
  for (int i = 0; i < n; i++) out[i] = random_normal(r);
}

#include "body/forces.h"
#include "plant/rigid.c"
#include "plant/touch.c"

#include LANES_TABLE // every effect and curve, by tools/table.sh

number_t *numbers(void *of) {
  return static_cast<number_t *>(of);
}

void take_use(fx_use_t *use, int fx, int form) {
  use->fx = fx_in_lanes[fx];
  use->form = form < 0 ? nullptr : curve_in_lanes[form];
}

} // namespace

struct lanes {
  rigid_t rigid;
  touch_t touch;
  fx_plant_t plant;
  d3_t push_w_N;
  fx_use_t excess[FX_MAX], load[FX_MAX];
  const fx_use_t *excess_at[FX_MAX], *load_at[FX_MAX];
  acting_t acting;
  body_look_t look;
  double y[RIGID_N];
  bool looked;
  lanes_at_t at;
};

// A flag between the numbers of a struct would shift those behind it.
static bool same_order(const lanes_numbers_t *n) {
  const std::size_t one = sizeof(lane_t);
  return n->rigid * one == offsetof(rigid_t, lag_in_speed) && n->touch * one == sizeof(touch_t) &&
         n->plant * one == sizeof(fx_plant_t) && n->look * one == offsetof(body_look_t, loaded);
}

lanes_t *lanes_open(const lanes_numbers_t *numbers_of_one) {
  lanes_t *const l = same_order(numbers_of_one) ? new (std::nothrow) lanes_t() : nullptr;
  if (!l) return nullptr;
  l->at = {numbers(&l->rigid), numbers(&l->touch), numbers(&l->plant), numbers(&l->push_w_N), {}, {},
           numbers(l->y),      numbers(&l->look)};
  for (int k = 0; k < FX_MAX; k++) {
    l->at.excess[k] = numbers(l->excess[k].p);
    l->at.load[k] = numbers(l->load[k].p);
    l->excess_at[k] = &l->excess[k];
    l->load_at[k] = &l->load[k];
  }
  return l;
}

void lanes_close(lanes_t *l) {
  delete l;
}

const lanes_at_t *lanes_at(const lanes_t *l) {
  return &l->at;
}

void lanes_set(lanes_t *l, const lanes_alike_t *a) {
  l->rigid.lag_in_speed = a->lag_in_speed;
  l->rigid.plain_lag = a->plain_lag;
  l->looked = a->looked;
  l->look.loaded = a->loaded;
  for (int k = 0; k < a->n_excess; k++) take_use(&l->excess[k], a->excess[k], a->excess_form[k]);
  for (int k = 0; k < a->n_load; k++) take_use(&l->load[k], a->load[k], -1);
  l->acting =
      acting_t{&l->rigid,   &l->touch, &l->plant,    l->excess_at, l->load_at,
               a->n_excess, a->n_load, a->excess_of, a->ticks,     a->pushed ? &l->push_w_N : nullptr};
}

void lanes_begin(unsigned in) {
  lanes_in = in;
}
unsigned lanes_left() {
  return lanes_in;
}

void lanes_derivative(void *context, const number_t *y, number_t *dydt) {
  lanes_t *const l = static_cast<lanes_t *>(context);
  double at[RIGID_N], change[RIGID_N];
  for (int i = 0; i < RIGID_N; i++) at[i] = lane_of(y + LANES * i);
  if (!l->looked) forces_look(&l->acting, 0, at, &l->look);
  l->looked = false;
  forces_derivative(&l->acting, at, &l->look, change);
  for (int i = 0; i < RIGID_N; i++) lane_put(dydt + LANES * i, change[i]);
}

bool lanes_end(lanes_t *l) {
  rigid_normalise(l->y);
  forces_look(&l->acting, TOUCH_FLOOR | TOUCH_CEILING | TOUCH_WALL, l->y, &l->look);
  return l->look.loaded;
}

#else // nobody asks for more (lane_possible)

lanes_t *lanes_open(const lanes_numbers_t *) {
  return nullptr;
}
void lanes_close(lanes_t *) {}
const lanes_at_t *lanes_at(const lanes_t *) {
  return nullptr;
}
void lanes_set(lanes_t *, const lanes_alike_t *) {}
void lanes_begin(unsigned) {}
unsigned lanes_left() {
  return 0;
}
void lanes_derivative(void *, const double *, double *) {}
bool lanes_end(lanes_t *) {
  return false;
}

#endif
