// abreast.c - vehicles that are moved eight at a time.
#include "body/abreast.h"

#include "body/body.h"
#include "body/lanes.h"
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#define NUMBER         sizeof(double)
#define RIGID_NUMBERS  (offsetof(rigid_t, command_N) / NUMBER) // those that stay, most of the time
#define RIGID_COMMAND  RIGID_NUMBERS
#define TOUCH_NUMBERS  (sizeof(touch_t) / NUMBER)
#define PLANT_NUMBERS  (sizeof(fx_plant_t) / NUMBER)
#define LOOK_NUMBERS   (offsetof(body_look_t, loaded) / NUMBER)
#define EFFECT_NUMBERS FX_PARAM_MAX

_Static_assert(LANES_EFFECTS == FX_MAX, "every effect has its place");
_Static_assert(offsetof(rigid_t, lag_in_speed) == (RIGID_COMMAND + ROTORS) * NUMBER,
               "numbers first, then flags");
_Static_assert(RIGID_N *LANES <= ODE_MAX, "a state of all lanes can be integrated");

// Whose numbers a lane has, and until what change of them.
typedef struct {
  const body_t *body;
  unsigned changed;
  const body_t *asked; // whose effects were looked up last
  bool knows;          // them all
} has_t;

struct abreast {
  lanes_t *lanes;
  integrate_t *integrate; // of the kind and step that moved last
  integrate_kind_t kind;
  double step_s;
  long together; // ticks of a vehicle
  has_t has[LANES];
};

// --- who may be moved together ----------------------------------------------------------------------------

static int at(const void *const *table, int n, const void *one) {
  for (int i = 0; i < n; i++)
    if (table[i] == one) return i;
  return -1;
}
static int at_fx(const fx_use_t *use) {
  return at((const void *const *)fx_table, fx_count, use->fx);
}
static int at_form(const fx_use_t *use) {
  return at((const void *const *)curve_table, curve_count, use->form);
}

// Effects that the tables hold, without points.
static bool knows_effects(const body_t *b) {
  for (int k = 0; k < b->n_excess; k++) {
    const fx_use_t *const use = b->excess[k];
    if (at_fx(use) < 0 || (use->form && (at_form(use) < 0 || use->form->needs_points))) return false;
  }
  for (int k = 0; k < b->n_load; k++)
    if (at_fx(b->load[k]) < 0) return false;
  return true;
}

static bool knows(has_t *has, const body_t *b) {
  if (has->asked != b) has->knows = knows_effects(b);
  has->asked = b;
  return has->knows;
}

static bool fits(has_t *has, const body_t *b) {
  return !b->broken && b->kind != INTEGRATE_REFERENCE && !b->rigid.vertical_only && !b->rigid.held &&
         !b->on_floor && !b->on_ceiling && knows(has, b) && body_is_clear(b);
}

static bool same_effects(const fx_use_t *const *a, const fx_use_t *const *b, int n) {
  for (int k = 0; k < n; k++)
    if (a[k]->fx != b[k]->fx || a[k]->form != b[k]->form) return false;
  return true;
}

static bool alike(const body_t *a, const body_t *b) {
  return a->span_s == b->span_s && a->kind == b->kind && a->step_s == b->step_s &&
         a->rigid.lag_in_speed == b->rigid.lag_in_speed && a->rigid.plain_lag == b->rigid.plain_lag &&
         a->look_is_y == b->look_is_y && a->look.loaded == b->look.loaded && a->pushed == b->pushed &&
         (a->n_tick > 0) == (b->n_tick > 0) && a->n_excess == b->n_excess && a->n_load == b->n_load &&
         same_effects(a->excess, b->excess, a->n_excess) && same_effects(a->load, b->load, a->n_load);
}

static lanes_alike_t alike_of(const body_t *b) {
  lanes_alike_t a = {.lag_in_speed = b->rigid.lag_in_speed,
                     .plain_lag = b->rigid.plain_lag,
                     .ticks = b->n_tick > 0,
                     .pushed = b->pushed,
                     .looked = b->look_is_y,
                     .loaded = b->look.loaded,
                     .excess_of = b->excess_of,
                     .n_excess = b->n_excess,
                     .n_load = b->n_load};
  for (int k = 0; k < b->n_excess; k++) {
    a.excess[k] = at_fx(b->excess[k]);
    a.excess_form[k] = at_form(b->excess[k]);
  }
  for (int k = 0; k < b->n_load; k++) a.load[k] = at_fx(b->load[k]);
  return a;
}

// --- numbers to their lane and back -----------------------------------------------------------------------

static void put(double *to, const double *from, int n, int lane) {
  for (int i = 0; i < n; i++) to[LANES * i + lane] = from[i];
}
static void get(const double *from, double *to, int n, int lane) {
  for (int i = 0; i < n; i++) to[i] = from[LANES * i + lane];
}

// Between ticks that are moved together nothing changes but the commands.
static void take_all(abreast_t *a, int lane, const body_t *b) {
  const lanes_at_t *const to = lanes_at(a->lanes);
  put(to->rigid + LANES * RIGID_COMMAND, b->rigid.command_N, ROTORS, lane);
  if (a->has[lane].body == b && a->has[lane].changed == b->changed) return;
  put(to->rigid, (const double *)&b->rigid, RIGID_NUMBERS, lane);
  put(to->touch, (const double *)&b->touch, TOUCH_NUMBERS, lane);
  put(to->plant, (const double *)&b->plant, PLANT_NUMBERS, lane);
  put(to->push_w_N, (const double *)&b->push_w_N, 3, lane);
  for (int k = 0; k < b->n_excess; k++) put(to->excess[k], b->excess[k]->p, EFFECT_NUMBERS, lane);
  for (int k = 0; k < b->n_load; k++) put(to->load[k], b->load[k]->p, EFFECT_NUMBERS, lane);
  put(to->y, b->y, RIGID_N, lane);
  if (b->look_is_y) put(to->look, (const double *)&b->look, LOOK_NUMBERS, lane);
  a->has[lane].body = b;
  a->has[lane].changed = b->changed;
}

static void give_back(const abreast_t *a, int lane, body_t *b, bool loaded) {
  const lanes_at_t *const from = lanes_at(a->lanes);
  get(from->y, b->y, RIGID_N, lane);
  get(from->look, (double *)&b->look, LOOK_NUMBERS, lane);
  b->look.loaded = loaded;
  b->look_is_y = true;
}

// --- a tick -----------------------------------------------------------------------------------------------

static bool integrator_for(abreast_t *a, const body_t *b) {
  if (a->integrate && a->kind == b->kind && a->step_s == b->step_s) return true;
  integrate_close(a->integrate);
  a->integrate = NULL;
  a->kind = b->kind;
  a->step_s = b->step_s;
  const ode_t ode = {
      .n = RIGID_N * LANES, .derivative = lanes_derivative, .context = a->lanes, .step_s = a->step_s};
  return integrate_open(&a->integrate, a->kind, &ode) == DONE;
}

// Moves those of `in`, which are alike. Returns those that were moved.
static unsigned move_together(abreast_t *a, body_t *const *b, unsigned in, const body_t *first) {
  if (!integrator_for(a, first)) return 0;
  const lanes_alike_t alike = alike_of(first);
  lanes_set(a->lanes, &alike);
  for (int k = 0; k < LANES; k++)
    if (in >> k & 1) take_all(a, k, b[k]);
  bool event;
  lanes_begin(in);
  if (!isfinite(integrate_to(a->integrate, lanes_at(a->lanes)->y, first->span_s, &event))) return 0;
  const bool loaded = lanes_end(a->lanes);
  const unsigned moved = lanes_left();
  for (int k = 0; k < LANES; k++)
    if (moved >> k & 1) {
      give_back(a, k, b[k], loaded);
      a->together++;
    }
  return moved;
}

static unsigned alike_in(abreast_t *a, body_t *const *b, const body_t **first) {
  unsigned in = 0;
  int n = 0;
  *first = NULL;
  for (int k = 0; k < LANES; k++) {
    if (!b[k] || !fits(&a->has[k], b[k]) || (*first && !alike(*first, b[k]))) continue;
    if (!*first) *first = b[k];
    in |= 1u << k;
    n++;
  }
  return n < ABREAST_FEWEST ? 0 : in;
}

void abreast_move(abreast_t *a, body_t *const b[LANES]) {
  const body_t *first;
  for (int k = 0; k < LANES; k++)
    if (b[k]) body_tick_begin(b[k]);
  const unsigned in = alike_in(a, b, &first), moved = in ? move_together(a, b, in, first) : 0;
  for (int k = 0; k < LANES; k++) {
    if (!b[k]) continue;
    if (!(moved >> k & 1)) body_tick_alone(b[k]);
    body_tick_end(b[k]);
  }
}

abreast_t *abreast_open(void) {
  static const lanes_numbers_t numbers = {RIGID_NUMBERS + ROTORS, TOUCH_NUMBERS, PLANT_NUMBERS, LOOK_NUMBERS};
  lanes_t *const lanes = lane_possible() ? lanes_open(&numbers) : NULL;
  if (!lanes) return NULL;
  abreast_t *const a = calloc(1, sizeof *a);
  if (!a) {
    lanes_close(lanes);
    return NULL;
  }
  a->lanes = lanes;
  return a;
}

long abreast_together(const abreast_t *a) {
  return a->together;
}

void abreast_forget(abreast_t *a) {
  memset(a->has, 0, sizeof a->has);
}

void abreast_close(abreast_t *a) {
  if (!a) return;
  integrate_close(a->integrate);
  lanes_close(a->lanes);
  free(a);
}
