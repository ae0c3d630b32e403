// lanes.cpp - eight vehicles side by side: the sources that move one vehicle, compiled for eight.
#include "body/lanes.h"

#ifdef __AVX2__
#include <new>

#include "base/lane.hpp"

namespace {

// Only effects at ticks draw random numbers. Vehicles that fly apply these effects one by one; an instant
// whose effects draw one is evaluated alone.
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

#define CURVE_POINTS_MAX 1 // effects with measured points are in no lane
#include "body/forces.h"
#include "plant/battery.c"
#include "plant/rigid.c"
#include "plant/touch.c"

#include LANES_TABLE // every effect and curve, written by tools/table.sh

number_t *numbers(void *of) {
  return static_cast<number_t *>(of);
}

void take_use(fx_use_t *use, int fx, int form) {
  use->fx = fx_in_lanes[fx];
  use->form = form < 0 ? nullptr : curve_in_lanes[form];
}

// What is found for eight instants, to be used again.
struct kept_t {
  double y[RIGID_N], command_N[ROTORS], vbat_V, t_s;
  body_look_t look;
  double faster[ROTORS];
  fx_sensed_t sight, sensed;
  d3_t turn_radps2;
};

// The state that a tick advances.
struct now_t {
  double y[RIGID_N], charge, current_A, vbat_V;
};
static_assert(sizeof(now_t) == LANES_NOW * sizeof(double));

} // namespace

struct lanes {
  rigid_t rigid;
  touch_t touch;
  fx_plant_t plant;
  push_t push;
  fx_use_t excess[FX_MAX], load[FX_MAX], sense[FX_MAX], tick[FX_MAX], more;
  const fx_use_t *excess_at[FX_MAX], *load_at[FX_MAX], *tick_at[FX_MAX];
  int n_sense, n_tick;
  fx_plant_t untouched;
  d3_t inertia_kgm2;
  double memory[FX_MAX][FX_MEMORY];
  kept_t instant;
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

// A flag between the numbers of a struct would shift the numbers after it.
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
           .push = numbers(&l->push),
           .untouched = numbers(&l->untouched),
           .inertia = numbers(&l->inertia_kgm2),
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
    l->at.tick[k] = numbers(l->tick[k].p);
    l->tick_at[k] = &l->tick[k];
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
  for (int k = 0; k < a->n_tick; k++) take_use(&l->tick[k], a->tick[k], -1);
  l->n_sense = a->n_sense;
  l->n_tick = a->n_tick;
  for (int k = 0; k < a->n_tick; k++)
    for (int m = 0; m < FX_MEMORY; m++) l->memory[k][m] = 0.0;
  l->battery.n = a->n_open_V;
  l->span_s = a->span_s;
  l->acting = acting_t{&l->rigid,   &l->touch, &l->plant,    l->excess_at, l->load_at,
                       a->n_excess, a->n_load, a->excess_of, a->ticks,     a->pushed ? &l->push : nullptr};
}

static void begin(unsigned in) {
  lanes_in = in;
}
static unsigned left() {
  return lanes_in;
}

// An integrator's numbers in place, or a copy if they are not aligned as registers need it.
static bool lies_well(const number_t *y) {
  return reinterpret_cast<uintptr_t>(y) % alignof(lane_t) == 0;
}
static const double *in_place(const number_t *y, double copy[RIGID_N]) {
  if (lies_well(y)) return reinterpret_cast<const double *>(y);
  for (int i = 0; i < RIGID_N; i++) copy[i] = lane_of(y + LANES * i);
  return copy;
}

static void derivative(void *context, const number_t *y, number_t *dydt) {
  lanes_t *const l = static_cast<lanes_t *>(context);
  double copy[RIGID_N], change[RIGID_N];
  const double *const at = in_place(y, copy);
  if (!l->looked) forces_look(&l->acting, l->surfaces, at, &l->look);
  l->looked = false;
  forces_derivative(&l->acting, at, &l->look, lies_well(dydt) ? reinterpret_cast<double *>(dydt) : change);
  for (int i = 0; i < RIGID_N && !lies_well(dydt); i++) lane_put(dydt + LANES * i, change[i]);
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
  memcpy(static_cast<void *>(truth->number + LANES * RIGID_THRUST_N), sensed, sizeof sensed);
  truth->motors = turn(y + RIGID_THRUST_N);
  lane_put(truth->up, axes_up_b(&l->look.axes).z);
}

// --- instants ----------------------------------------------------------------------------------------------

// Lanes that need numbers of the instant before, or whose rotors have moved, leave.
static void act_at_ticks(lanes_t *l, const kept_t *i) {
  const d3_t cg = l->plant.cg_b_m;
  const forces_tick_t tick = {l->tick_at, l->n_tick, &l->untouched, l->inertia_kgm2, i->t_s,
                              l->span_s,  i->vbat_V, nullptr,       l->memory};
  forces_plant(&l->acting, &tick, i->y, &l->plant);
  forces_take_plant(&l->plant, l->inertia_kgm2, &l->rigid);
  l->rigid.plain_lag = true; // forces_take_plant may have changed it
  unsigned other = (d3_norm(d3_sub(l->plant.cg_b_m, cg)) > 0.0).bits();
  for (int k = 0; k < l->n_tick; k++)
    for (int m = 0; m < FX_MEMORY; m++) other |= (l->memory[k][m] != 0.0).bits();
  lanes_in &= ~other;
}

static void take_instants(lanes_t *l, const kept_t *i) {
  for (int k = 0; k < ROTORS; k++) l->rigid.command_N[k] = i->command_N[k];
  if (l->n_tick > 0) act_at_ticks(l, i);
}

static void look(lanes_t *l, const lanes_instants_t *from, number_t up[LANES]) {
  kept_t *const i = &l->instant;
  for (int k = 0; k < RIGID_N; k++) i->y[k] = lane_of(from->y[k]);
  for (int k = 0; k < ROTORS; k++) i->command_N[k] = lane_of(from->command_N[k]);
  i->vbat_V = lane_of(from->vbat_V);
  i->t_s = lane_of(from->t_s);
  take_instants(l, i);
  for (int k = 0; k < ROTORS; k++) i->faster[k] = l->rigid.faster[k];
  forces_look(&l->acting, 0, i->y, &i->look);
  lane_put(up, axes_up_b(&i->look.axes).z);
}

static void put_readings(const fx_sensed_t *sensed, d3_t turn, lanes_readings_t *to) {
  const d3_t force = sensed->acc_b_mps2;
  const double all[LANES_READINGS] = {force.x, force.y, force.z, turn.x, turn.y, turn.z, sensed->range_m};
  for (int k = 0; k < LANES_READINGS; k++) lane_put(to->of[k], all[k]);
}

struct read_t {
  fx_sensed_t sensed;
  d3_t turn_radps2;
};

static read_t read_instants(const lanes_t *l, const kept_t *i, const body_look_t *look,
                            lanes_readings_t *to) {
  read_t is = {i->sight, {0.0, 0.0, 0.0}};
  is.sensed.acc_b_mps2 = forces_pull_b_mps2(&l->acting, i->y, look, &is.turn_radps2);
  for (int k = 0; k < l->n_sense; k++) l->sense[k].fx->sense(&l->sense[k], &is.sensed);
  put_readings(&is.sensed, is.turn_radps2, to);
  return is;
}

static void read(lanes_t *l, const lanes_sight_t *sight, lanes_readings_t *to) {
  kept_t *const i = &l->instant;
  i->sight = {d3(0.0, 0.0, 0.0), lane_of(sight->range_m), lane_of(sight->range_rate_mps)};
  const read_t is = read_instants(l, i, &i->look, to);
  i->sensed = is.sensed;
  i->turn_radps2 = is.turn_radps2;
}

static void read_again(lanes_t *l, const void *kept, bool moved, lanes_readings_t *to) {
  const kept_t *const i = static_cast<const kept_t *>(kept);
  take_instants(l, i);
  for (int k = 0; k < ROTORS; k++) moved = moved || any_of(l->rigid.faster[k] != i->faster[k]);
  body_look_t look = i->look;
  if (moved)
    forces_look(&l->acting, 0, i->y, &look);
  else
    forces_load(&l->acting, 0, i->y, &look);
  (void)read_instants(l, i, &look, to);
}

static std::size_t kept_bytes() {
  return sizeof(kept_t);
}

static void keep(const lanes_t *l, void *kept) {
  *static_cast<kept_t *>(kept) = l->instant;
}

static void read_more(lanes_t *l, const lanes_effect_t *more, const void *kept, lanes_readings_t *to) {
  const kept_t *const i = static_cast<const kept_t *>(kept);
  take_use(&l->more, more->fx, more->form);
  for (int k = 0; k < FX_PARAM_MAX; k++) l->more.p[k] = more->p[k];
  if (l->more.fx->sense) {
    fx_sensed_t sensed = i->sensed;
    l->more.fx->sense(&l->more, &sensed);
    put_readings(&sensed, i->turn_radps2, to);
    return;
  }
  take_instants(l, i);
  body_look_t look = i->look;
  forces_look_more(&l->acting, &l->more, i->y, &look);
  read_instants(l, i, &look, to);
}

#define DOOR                                                                                                 \
  {                                                                                                          \
    open, close, at, leave<set>, begin, left, leave<tick>, leave<derivative>, leave<gap>, leave<end>,        \
        leave<sense>, leave<look>, leave<read>, kept_bytes, leave<keep>, leave<read_again>, leave<read_more> \
  }
#else // never used there (lane_possible)
#define DOOR                                                                                                 \
  {}
#endif

#ifdef LANES_512
const lanes_door_t lanes_door_512 = DOOR;
#else
const lanes_door_t lanes_door_256 = DOOR;
#endif
