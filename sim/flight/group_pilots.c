// group_pilots.c - the pilots of eight flights.
#include "flight/group.h"

#include "crazyflie/crazyflie.h"
#include "flight/lanes_blocks.h"
#include <string.h>

void group_settle(group_t *g, unsigned of) {
  body_t *bodies[LANES] = {NULL};
  EACH(k, of) bodies[k] = &g->job[k]->f->body;
  abreast_settle_all(g->bodies, bodies);
}

static pilot_t *pilot_of(const group_t *g, int k) {
  return (pilot_t *)g->job[k]->f->pilot;
}

// --- in and out --------------------------------------------------------------------------------------------

// True if the pilot can fly in lanes: nothing but the vehicle's millisecond touches its state without calling
// crazyflie_home() first, and whatever looks at it (pilot_t.around) is the same for all.
static bool is_vehicle(const group_t *g, const flight_loop_t *f) {
  const crazyflie_t *const c = f->pilot->vehicle;
  const pilot_around_t *const around = f->pilot->around;
  return c && !c->fly && !c->command && !c->around.event && c->app.shadow == 0 &&
         (!around || !g->around || around == g->around);
}

void group_begin_vehicle(group_t *g, int k) {
  const flight_loop_t *const f = g->job[k]->f;
  if (!is_vehicle(g, f)) return;
  g->vehicle |= 1u << k;
  g->place[k] = (place_t){g, k};
  g->apart[k] = APART_NEVER;
  if (f->pilot->keeps && f->pilot->keeps(f->pilot->state, 1)) g->keeps |= 1u << k; // any log has step 1
  if (f->plan->edit || f->pilot->around) g->edited |= 1u << k;
  if (!f->pilot->around) return;
  g->looked |= 1u << k;
  if (!g->around) woven_look(&g->woven, f->pilot->around);
  g->around = f->pilot->around;
}

// Takes the pilot out of lanes, until the next copy or longer.
static void leave(group_t *g, int k) {
  g->vehicle &= ~(1u << k);
  g->out |= 1u << k;
}

static void come_back(group_t *g) {
  if (!g->out || !lanes_vehicle_due(g->woven.state, g->vehicle == 0)) return;
  EACH(k, g->out & g->fly) {
    if (!group_rested(&g->apart[k], g->ms)) continue;
    woven_vehicle_back(&g->woven, k, g->job[k]->f);
    g->vehicle |= 1u << k;
  }
  g->out &= ~g->vehicle;
}

static void keep(group_t *g, int k) {
  const pilot_t *const p = pilot_of(g, k);
  if (p->keeps && p->keeps(p->state, g->ms)) p->keep(p->state);
}

// Repeats alone the milliseconds since the last copy, for a flight that parted.
static void part(group_t *g, int k) {
  woven_pilot_alone(&g->woven, k, g->job[k]->f);
  keep(g, k);
  if (group_parts(&g->apart[k], g->ms))
    leave(g, k);
  else
    woven_vehicle_back(&g->woven, k, g->job[k]->f);
}

// --- edited inputs -----------------------------------------------------------------------------------------

// crazyflie_t.bring_home
static void bring_home(void *context) {
  const place_t *const at = context;
  group_t *const g = at->g;
  if (!(g->vehicle >> at->k & 1)) return;
  woven_vehicle_home(&g->woven, at->k, g->job[at->k]->f);
  g->apart[at->k].back_ms = g->ms;
  leave(g, at->k);
}

// Lets plan_t.edit edit a flight's pilot_in_t. If that brings the vehicle home, its pilot is called here.
static void edit(group_t *g, int k) {
  flight_loop_t *const f = g->job[k]->f;
  crazyflie_t *const c = f->pilot->vehicle;
  pilot_in_t *const in = &g->told[k];
  c->bring_home = bring_home;
  c->home_context = &g->place[k];
  if (f->plan->edit) f->plan->edit(f->plan->edit_context, &f->body, in);
  c->bring_home = NULL;
  if (!(g->vehicle >> k & 1)) f->pilot->step(f->pilot->state, in, f->motor_N);
}

// Copies all eight, edited or not, because finding the few numbers that were edited costs as much.
static void edit_all(group_t *g, void *told, unsigned of) {
  void *in[LANES];
  for (int k = 0; k < LANES; k++) in[k] = &g->told[k];
  group_settle(g, of);
  weave_get_all(weave_block(LANES_in), told, in);
  EACH(k, of) edit(g, k);
  weave_put_all(weave_block(LANES_in), told, (const void *const *)in);
}

// Calls pilot_around_t.after of flights that began the millisecond in lanes, even if they parted in it.
static void look(group_t *g, unsigned of) {
  const unsigned in = of & g->vehicle;
  OF_EACH(app, in, &pilot_of(g, k)->vehicle->app);
  OF_EACH(motor_N, in, g->job[k]->f->motor_N);
  woven_get_looked(&g->woven, app);
  woven_get_all(&g->woven, weave_block(LANES_motors), motor_N);
  EACH(k, of) {
    const flight_loop_t *const f = g->job[k]->f;
    g->around->after(f->pilot->state, &g->told[k], f->motor_N);
  }
}

// --- a millisecond -----------------------------------------------------------------------------------------

static void fly_in_lanes(group_t *g) {
  const unsigned edited = g->edited & g->vehicle;
  void *const told = lanes_told(g->woven.state, edited != 0);
  if (edited) edit_all(g, told, edited);
  const unsigned in = g->vehicle, passed = lanes_vehicle_ms(g->woven.state, in);
  EACH(k, in & ~passed) part(g, k);
  if (g->looked & in) look(g, g->looked & in);
  g->together += __builtin_popcount(passed);
  EACH(k, passed & g->keeps) {
    const pilot_t *const p = pilot_of(g, k);
    if (!p->keeps(p->state, g->ms)) continue;
    woven_get(&g->woven, LANES_app, k, &p->vehicle->app);
    p->keep(p->state);
  }
}

void group_pilots(group_t *g) {
  come_back(g);
  const unsigned alone = g->fly & ~g->vehicle;
  if (g->vehicle) fly_in_lanes(g);
  EACH(k, alone) {
    flight_loop_t *const f = g->job[k]->f;
    woven_get(&g->woven, LANES_in, k, &f->in);
    if (f->plan->edit) group_settle(g, 1u << k);
    loop_pilot(f);
  }
}
