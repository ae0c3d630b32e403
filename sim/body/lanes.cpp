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
#include "plant/battery.c"
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

// What moves on.
struct now_t {
  double y[RIGID_N], charge, current_A, vbat_V;
};
static_assert(sizeof(now_t) == LANES_NOW * sizeof(double));

} // namespace

struct lanes {
  rigid_t rigid;
  touch_t touch;
  fx_plant_t plant;
  d3_t push_w_N;
  fx_use_t excess[FX_MAX], load[FX_MAX], sense[FX_MAX];
  const fx_use_t *excess_at[FX_MAX], *load_at[FX_MAX];
  int n_sense;
  battery_param_t battery;
  sensed_from_t from;
  acting_t acting;
  body_look_t look;
  now_t now, before;
  number_t span_s;
  int surfaces;
  bool looked;
  lanes_at_t at;
};

// A flag between the numbers of a struct would shift those behind it.
static bool same_order(const lanes_numbers_t *n) {
  const std::size_t one = sizeof(lane_t);
  return n->rigid * one == offsetof(rigid_t, lag_in_speed) && n->touch * one == sizeof(touch_t) &&
         n->plant * one == sizeof(fx_plant_t) && n->look * one == offsetof(body_look_t, loaded) &&
         n->battery * one == offsetof(battery_param_t, n);
}

static lanes_t *open(const lanes_numbers_t *numbers_of_one) {
  lanes_t *const l = same_order(numbers_of_one) ? new (std::nothrow) lanes_t() : nullptr;
  if (!l) return nullptr;
  l->at = {.rigid = numbers(&l->rigid),
           .touch = numbers(&l->touch),
           .plant = numbers(&l->plant),
           .push_w_N = numbers(&l->push_w_N),
           .battery = numbers(&l->battery),
           .open_V = numbers(l->battery.open_V),
           .sensed_from = numbers(&l->from),
           .now = numbers(&l->now),
           .before = numbers(&l->before),
           .look = numbers(&l->look)};
  for (int k = 0; k < FX_MAX; k++) {
    l->at.excess[k] = numbers(l->excess[k].p);
    l->at.load[k] = numbers(l->load[k].p);
    l->at.sense[k] = numbers(l->sense[k].p);
    l->excess_at[k] = &l->excess[k];
    l->load_at[k] = &l->load[k];
  }
  return l;
}

static void close(lanes_t *l) {
  delete l;
}

static const lanes_at_t *at(const lanes_t *l) {
  return &l->at;
}

static void set(lanes_t *l, const lanes_alike_t *a) {
  l->rigid.lag_in_speed = a->lag_in_speed;
  l->rigid.plain_lag = a->plain_lag;
  l->looked = a->looked;
  l->look.loaded = a->loaded;
  for (int k = 0; k < a->n_excess; k++) take_use(&l->excess[k], a->excess[k], a->excess_form[k]);
  for (int k = 0; k < a->n_load; k++) take_use(&l->load[k], a->load[k], -1);
  for (int k = 0; k < a->n_sense; k++) take_use(&l->sense[k], a->sense[k], -1);
  l->n_sense = a->n_sense;
  l->battery.n = a->n_open_V;
  l->span_s = a->span_s;
  l->acting =
      acting_t{&l->rigid,   &l->touch, &l->plant,    l->excess_at, l->load_at,
               a->n_excess, a->n_load, a->excess_of, a->ticks,     a->pushed ? &l->push_w_N : nullptr};
}

static void begin(unsigned in) {
  lanes_in = in;
}
static unsigned left() {
  return lanes_in;
}

static void derivative(void *context, const number_t *y, number_t *dydt) {
  lanes_t *const l = static_cast<lanes_t *>(context);
  double at[RIGID_N], change[RIGID_N];
  for (int i = 0; i < RIGID_N; i++) at[i] = lane_of(y + LANES * i);
  if (!l->looked) forces_look(&l->acting, l->surfaces, at, &l->look);
  l->looked = false;
  forces_derivative(&l->acting, at, &l->look, change);
  for (int i = 0; i < RIGID_N; i++) lane_put(dydt + LANES * i, change[i]);
}

static int tick(lanes_t *l) {
  l->before = l->now;
  const axes_t axes = axes_of(dq_of(l->now.y + RIGID_Q_WB));
  return l->surfaces = forces_near(&l->acting, l->now.y, &axes, l->span_s);
}

static void gap(lanes_t *l, lanes_gap_t *to) {
  const axes_t axes = axes_of(dq_of(l->now.y + RIGID_Q_WB));
  const touch_gap_t is = touch_gap(&l->touch, d3_of(l->now.y + RIGID_POS_M), &axes);
  lane_put(to->floor_m, is.floor_m);
  lane_put(to->ceiling_m, is.ceiling_m);
}

static bool end(lanes_t *l, lanes_seen_t *seen) {
  now_t *const now = &l->now;
  const double *const thrust_N = now->y + RIGID_THRUST_N;
  rigid_normalise(now->y);
  forces_look(&l->acting, TOUCH_FLOOR | TOUCH_CEILING | TOUCH_WALL, now->y, &l->look);
  double left[ROTORS];
  forces_current_left(&l->look, left);
  now->charge = battery_discharge(&l->battery, now->charge, now->current_A, l->span_s);
  now->current_A = battery_current_A(&l->battery, thrust_N, left, ROTORS);
  now->vbat_V = battery_voltage_V(&l->battery, now->charge, now->current_A);
  lane_put(seen->rotors_N, forces_rotors_N(now->y));
  lane_put(seen->gap_m, forces_gap_m(&l->acting, now->y, &l->look.axes));
  return l->look.loaded;
}

static unsigned turn(const double *thrust_N) {
  unsigned any = 0;
  for (int i = 0; i < ROTORS; i++) any |= (thrust_N[i] > FORCES_IDLE_N).bits();
  return any;
}

static void sense(lanes_t *l, lanes_truth_t *truth) {
  fx_sensed_t above, below;
  const double *const y = l->now.y;
  forces_sensed(&l->acting, y, &l->look, &l->from, &above, &below);
  for (int k = 0; k < l->n_sense; k++) l->sense[k].fx->sense(&l->sense[k], &above);
  for (int k = 0; k < l->n_sense; k++) l->sense[k].fx->sense(&l->sense[k], &below);
  const d3_t force = above.acc_b_mps2;
  const double sensed[] = {force.x, force.y, force.z, above.range_m, below.range_m};
  memcpy(static_cast<void *>(truth->number), y, RIGID_THRUST_N * sizeof *y);
  memcpy(static_cast<void *>(truth->number[RIGID_THRUST_N]), sensed, sizeof sensed);
  truth->motors = turn(y + RIGID_THRUST_N);
  lane_put(truth->up, axes_up_b(&l->look.axes).z);
}

#define DOOR                                                                                                 \
  { open, close, at, set, begin, left, tick, derivative, gap, end, sense }
#else // nobody asks for more (lane_possible)
#define DOOR                                                                                                 \
  {}
#endif

#ifdef LANES_512
const lanes_door_t lanes_door_512 = DOOR;
#else
const lanes_door_t lanes_door_256 = DOOR;
#endif
