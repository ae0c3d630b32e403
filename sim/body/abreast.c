// abreast.c - vehicles that are moved eight at a time.
#include "body/abreast.h"

#include "base/rows.h"
#include "body/alike.h"
#include "body/lanes_of.h"
#include "body/orders.h"
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

_Static_assert(RIGID_N *LANES <= ODE_MAX, "a state of all lanes can be integrated");

// A body's contacts during a tick.
typedef struct {
  bool on_floor, on_ceiling;
  int floor, ceiling; // contacts begun
} contacts_t;

struct abreast {
  const lanes_door_t *door;
  lanes_t *lanes;
  integrate_t *integrate; // for the integrator and step that were used last
  integrate_kind_t kind;
  double step_s;
  long together; // ticks, counted per body
  has_t has[LANES];
  unsigned moved;      // by the last tick, together
  unsigned ahead;      // of these, those whose body_t lags behind
  bool now_loaded;     // look.loaded of these
  lanes_alike_t alike; // what they have in common, taken from
  const body_t *first; // this body
  unsigned first_changed;
  // For ticks whose commands come as rows (abreast_again).
  bool again, begun; // the next tick may be one; the last tick was one
  orders_t orders;
  contacts_t touch[LANES];
};

// Updates what the bodies that are moved together have in common; `b` is the first of them.
static void set_alike(abreast_t *a, const body_t *b) {
  lanes_alike_t *const to = &a->alike;
  if (a->first != b || a->first_changed != b->changed || b->n_tick > 0) *to = lanes_alike(b);
  a->first = b;
  a->first_changed = b->changed;
  to->lag_in_speed = b->rigid.lag_in_speed;
  to->plain_lag = b->rigid.plain_lag;
  to->pushed = b->pushed;
  to->looked = b->look_is_y;
  to->loaded = b->look.loaded;
  to->span_s = b->span_s;
}

// --- numbers to their lane and back -----------------------------------------------------------------------

// Takes what effects at ticks change at every tick.
static void take_plant(const lanes_at_t *to, int lane, const body_t *b) {
  lanes_put(to->plant, (const double *)&b->plant, PLANT_NUMBERS, lane);
  lanes_put(to->rigid + LANES * RIGID_SCALES, (const double *)&b->rigid + RIGID_SCALES, 3 * ROTORS, lane);
}

// Between ticks that are moved together, only this, pushes and commands change.
static void take_all(abreast_t *a, int lane, const body_t *b) {
  const lanes_at_t *const to = a->door->at(a->lanes);
  lanes_put(to->rigid + LANES * RIGID_COMMAND, b->rigid.command_N, ROTORS, lane);
  if (b->n_tick > 0) take_plant(to, lane, b);
  if (b->pushed) lanes_put(to->push, (const double *)&b->push, PUSH_NUMBERS, lane);
  if (a->has[lane].body == b && a->has[lane].changed == b->changed) return;
  lanes_put(to->rigid, (const double *)&b->rigid, RIGID_NUMBERS, lane);
  lanes_put(to->touch, (const double *)&b->touch, TOUCH_NUMBERS, lane);
  lanes_put(to->plant, (const double *)&b->plant, PLANT_NUMBERS, lane);
  lanes_take_effects(to, lane, b);
  if (a->has[lane].body != b) lanes_take_model(to, lane, b->model);
  lanes_put(to->now, b->y, RIGID_N, lane);
  const double battery[] = {b->charge, b->current_A, b->vbat_V};
  lanes_put(to->now + LANES * LANES_CHARGE, battery, 3, lane);
  if (b->look_is_y) lanes_put(to->look, (const double *)&b->look, LOOK_NUMBERS, lane);
  a->has[lane].body = b;
  a->has[lane].changed = b->changed;
}

static void give_now(const double *now, int lane, body_t *b) {
  double battery[3];
  lanes_get(now, b->y, RIGID_N, lane);
  lanes_get(now + LANES * LANES_CHARGE, battery, 3, lane);
  b->charge = battery[0];
  b->current_A = battery[1];
  b->vbat_V = battery[2];
}

void abreast_settle(abreast_t *a, int k, body_t *b) {
  if (!(a->ahead >> k & 1)) return;
  a->ahead &= ~(1u << k);
  const lanes_at_t *const from = a->door->at(a->lanes);
  give_now(from->now, k, b);
  orders_give(&a->orders, k, b);
  lanes_get(from->look, (double *)&b->look, LOOK_NUMBERS, k);
  b->look.loaded = a->now_loaded;
}

#define OF_EACH(name, of, something)                                                                         \
  for (int k = 0; k < LANES; k++) name[k] = (of) >> k & 1 ? (char *)(something) : (char *)&nobody

void abreast_settle_all(abreast_t *a, body_t *const b[LANES]) {
  body_t nobody;
  double battery[LANES][3] = {{0.0}};
  char *one[LANES];
  unsigned of = 0;
  for (int k = 0; k < LANES; k++)
    if (b[k]) of |= a->ahead & 1u << k;
  if (!of) return;
  const lanes_at_t *const from = a->door->at(a->lanes);
  OF_EACH(one, of, b[k]->y);
  rows_get_64(RIGID_N, (const char *)from->now, one);
  OF_EACH(one, of, &b[k]->look);
  rows_get_64(LOOK_NUMBERS, (const char *)from->look, one);
  OF_EACH(one, of, battery[k]);
  rows_get_64(3, (const char *)(from->now + LANES * LANES_CHARGE), one);
  for (int k = 0; k < LANES; k++) {
    if (!(of >> k & 1)) continue;
    orders_give(&a->orders, k, b[k]);
    b[k]->charge = battery[k][0];
    b[k]->current_A = battery[k][1];
    b[k]->vbat_V = battery[k][2];
    b[k]->look.loaded = a->now_loaded;
  }
  a->ahead &= ~of;
}

// Puts a body that has to do the tick alone after all back to where it was.
static void give_before(abreast_t *a, int lane, body_t *b) {
  a->ahead &= ~(1u << lane);
  give_now(a->door->at(a->lanes)->before, lane, b);
  body_look(b, TOUCH_FLOOR | TOUCH_CEILING | TOUCH_WALL, b->y, &b->look);
}

// --- a tick -----------------------------------------------------------------------------------------------

void abreast_recall(abreast_t *a, int k, body_t *b) {
  orders_give(&a->orders, k, b);
}

static bool integrator_for(abreast_t *a, const body_t *b) {
  if (a->integrate && a->kind == b->kind && a->step_s == b->step_s) return true;
  integrate_close(a->integrate);
  a->integrate = NULL;
  a->kind = b->kind;
  a->step_s = b->step_s;
  const ode_t ode = {
      .n = RIGID_N * LANES, .derivative = a->door->derivative, .context = a->lanes, .step_s = a->step_s};
  return integrate_open(&a->integrate, a->kind, &ode) == DONE;
}

static void watch(const abreast_t *a, bool near, contacts_t touch[LANES]) {
  bool any = near;
  for (int k = 0; k < LANES; k++) any = any || touch[k].on_floor || touch[k].on_ceiling;
  if (!any) return;
  lanes_gap_t gap;
  a->door->gap(a->lanes, &gap);
  for (int k = 0; k < LANES; k++) {
    contacts_t *const t = &touch[k];
    if (!near && !t->on_floor && !t->on_ceiling) continue;
    t->floor += body_touched(&t->on_floor, gap.floor_m[k]);
    t->ceiling += body_touched(&t->on_ceiling, gap.ceiling_m[k]);
  }
}

static bool advance(abreast_t *a, double span_s, contacts_t touch[LANES]) {
  const int surfaces = a->door->tick(a->lanes), parts = body_parts(surfaces, span_s);
  for (int i = 0; i < parts; i++) {
    if (!integrate_to(a->integrate, a->door->at(a->lanes)->now, span_s / parts)) return false;
    watch(a, surfaces != 0, touch);
  }
  return true;
}

// Moves the bodies in `in`, whose numbers are in their lanes. Returns those that were moved.
static unsigned move_lanes(abreast_t *a, body_t *const *b, unsigned in, double span_s,
                           contacts_t touch[LANES], lanes_seen_t *seen) {
  a->door->set(a->lanes, &a->alike);
  a->door->begin(in);
  if (!advance(a, span_s, touch)) return 0;
  a->now_loaded = a->door->end(a->lanes, seen);
  const unsigned moved = a->door->left();
  for (int k = 0; k < LANES; k++) {
    const contacts_t now = {touch[k].on_floor, touch[k].on_ceiling, 0, 0};
    if (!(moved >> k & 1) || memcmp(&touch[k], &a->touch[k], sizeof now) == 0) continue;
    b[k]->on_floor = touch[k].on_floor;
    b[k]->on_ceiling = touch[k].on_ceiling;
    b[k]->floor_contacts += touch[k].floor;
    b[k]->ceiling_contacts += touch[k].ceiling;
    a->touch[k] = now;
  }
  return moved;
}

// The same for bodies that are alike, after taking their numbers.
static unsigned move_together(abreast_t *a, body_t *const *b, unsigned in, const body_t *first,
                              lanes_seen_t *seen) {
  contacts_t touch[LANES] = {{.floor = 0}};
  set_alike(a, first);
  for (int k = 0; k < LANES; k++) {
    if (!(in >> k & 1)) continue;
    take_all(a, k, b[k]);
    a->touch[k] = touch[k] = (contacts_t){.on_floor = b[k]->on_floor, .on_ceiling = b[k]->on_ceiling};
  }
  return move_lanes(a, b, in, first->span_s, touch, seen);
}

// True if all were moved together in the last tick, and have only been commanded since.
static bool as_before(const abreast_t *a, body_t *const *b) {
  for (int k = 0; k < LANES; k++) {
    const has_t *const has = &a->has[k];
    if (!b[k] && !(a->moved >> k & 1)) continue;
    if (!b[k] || !(a->moved >> k & 1) || has->body != b[k] || has->changed != b[k]->changed || b[k]->broken ||
        b[k]->n_tick > 0 || b[k]->span_s != a->alike.span_s || b[k]->look_is_y != a->alike.looked)
      return false;
  }
  return a->moved != 0;
}

static unsigned alike_in(abreast_t *a, body_t *const *b, const body_t **first) {
  unsigned in = 0;
  int n = 0;
  *first = NULL;
  for (int k = 0; k < LANES; k++) {
    if (!b[k] || !alike_fits(&a->has[k], b[k]) || (*first && !alike(&a->has[k], *first, b[k]))) continue;
    if (!*first) *first = b[k];
    in |= 1u << k;
    n++;
  }
  return n < ABREAST_FEWEST ? 0 : in;
}

static bool is_finite(const double *now, int k) {
  return isfinite(now[LANES * (RIGID_POS_M + 2) + k]) && isfinite(now[LANES * RIGID_Q_WB + k]);
}

// Completes the tick of a body that was moved with others.
static void end_together(abreast_t *a, int k, body_t *b, double *vbat_V) {
  const double *const now = a->door->at(a->lanes)->now;
  b->broken = !is_finite(now, k);
  b->t_s += b->span_s;
  b->look_is_y = true;
  *vbat_V = now[LANES * LANES_VBAT_V + k];
  a->ahead |= 1u << k;
  a->together++;
}

// Does the tick alone, from where the body was, in lanes or not.
static void end_alone(abreast_t *a, int k, body_t *b) {
  if (a->ahead >> k & 1) give_before(a, k, b);
  body_tick_alone(b);
  body_tick_end(b);
}

// Effects at ticks, and rotors without a lag, read the body and change it.
static void begin_tick(abreast_t *a, int k, body_t *b) {
  if (b->n_tick > 0 || b->rigid.motor_tau_s < LAG_LEAST_S) abreast_settle(a, k, b);
  body_tick_begin(b);
}

unsigned abreast_move(abreast_t *a, body_t *const b[LANES], lanes_seen_t *seen, double vbat_V[LANES]) {
  const body_t *first;
  for (int k = 0; k < LANES; k++)
    if (b[k]) begin_tick(a, k, b[k]);
  const bool again = as_before(a, b);
  const unsigned in = again ? a->moved : alike_in(a, b, &first);
  if (again) first = b[__builtin_ctz(a->moved)]; // the first one may have left since, and no longer exist
  if (in && integrator_for(a, first)) {
    a->moved = move_together(a, b, in, first, seen);
  } else {
    a->moved = 0;
    for (int k = 0; k < LANES; k++)
      if (b[k]) abreast_settle(a, k, b[k]);
  }
  for (int k = 0; k < LANES; k++) {
    if (!b[k]) continue;
    if (a->moved >> k & 1)
      end_together(a, k, b[k], &vbat_V[k]);
    else
      end_alone(a, k, b[k]);
  }
  a->again = a->moved != 0;
  a->begun = false;
  for (int k = 0; k < LANES; k++) {
    if (!b[k]) continue;
    a->again = a->again && a->moved >> k & 1 && orders_suffice(b[k]);
  }
  return a->moved;
}

bool abreast_again(const abreast_t *a, body_t *const b[LANES]) {
  if (!a->again) return false;
  for (int k = 0; k < LANES; k++) {
    const bool was = a->moved >> k & 1;
    if (was != (b[k] != NULL)) return false;
    if (was && (a->has[k].body != b[k] || a->has[k].changed != b[k]->changed || !b[k]->look_is_y))
      return false;
  }
  return true;
}

unsigned abreast_move_again(abreast_t *a, body_t *const b[LANES], const double *command_N, double *applied_N,
                            lanes_seen_t *seen, double vbat_V[LANES]) {
  const unsigned in = a->moved;
  const lanes_at_t *const at = a->door->at(a->lanes);
  orders_t *const orders = &a->orders;
  contacts_t touch[LANES];
  memcpy(touch, a->touch, sizeof touch);
  for (int k = 0; k < LANES && !a->begun; k++)
    if (in >> k & 1) orders_begin(orders, k, b[k]);
  a->begun = true;
  orders_take(orders, command_N, applied_N);
  memcpy(at->rigid + LANES * RIGID_COMMAND, orders->due_N, sizeof orders->due_N);
  a->alike.looked = true;
  a->moved = move_lanes(a, b, in, a->alike.span_s, touch, seen);
  orders->ahead = in & ~a->moved;
  a->ahead |= in;
  for (int k = 0; k < LANES; k++) {
    if (!(orders->ahead >> k & 1)) continue;
    orders_give(orders, k, b[k]);
    end_alone(a, k, b[k]);
  }
  orders_end(orders, a->moved, a->alike.span_s);
  memcpy(vbat_V, at->now + LANES * LANES_VBAT_V, LANES * sizeof *vbat_V);
  a->together += __builtin_popcount(a->moved);
  a->again = a->moved == in;
  for (int k = 0; k < LANES; k++) {
    if (!(a->moved >> k & 1) || is_finite(at->now, k)) continue;
    b[k]->broken = true;
    a->again = false;
  }
  return a->moved;
}

unsigned abreast_sense(abreast_t *a, lanes_truth_t *truth) {
  a->door->begin(a->moved);
  if (a->moved) a->door->sense(a->lanes, truth);
  return a->door->left();
}

abreast_t *abreast_open(int bits) {
  if (bits == 0) return NULL;
  abreast_t *const a = calloc(1, sizeof *a);
  if (!a) return NULL;
  a->door = lanes_door(bits);
  a->lanes = lanes_open(a->door);
  if (a->lanes) return a;
  free(a);
  return NULL;
}

long abreast_together(const abreast_t *a) {
  return a->together;
}

void abreast_forget(abreast_t *a) {
  memset(a->has, 0, sizeof a->has);
  a->first = NULL;
  a->moved = a->ahead = a->orders.ahead = 0;
  a->again = false;
}

void abreast_forget_one(abreast_t *a, int k) {
  for (int i = 0; i < LANES; i++) a->has[i].like = NULL; // it may be this body
  a->has[k] = (has_t){.body = NULL};
  a->again = false;
  a->first = NULL;
}

void abreast_close(abreast_t *a) {
  if (!a) return;
  integrate_close(a->integrate);
  a->door->close(a->lanes);
  free(a);
}
