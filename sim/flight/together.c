// together.c - flights eight at a time.
#include "flight/together.h"

#include "base/heap.h"
#include "base/larger.h"
#include "base/turns.h"
#include "crazyflie/crazyflie.h"
#include "flight/group.h"
#include "flight/lanes_blocks.h"
#include <float.h>
#include <limits.h>
#include <math.h>
#include <string.h>

// --- a tick ------------------------------------------------------------------------------------------------

// Takes a flight out of the lanes and ends it.
static void retire(group_t *g, int k, done_t status, flight_over_t over) {
  job_t *const job = g->job[k];
  flight_loop_t *const f = job->f;
  group_settle(g, 1u << k);
  if (g->sensed >> k & 1) woven_end_senses(&g->woven, k, f);
  if (g->vehicle >> k & 1) woven_end_vehicle(&g->woven, k, f->pilot->vehicle);
  job->status = status;
  *job->finite = over != FLIGHT_NOT_FINITE;
  g->fly &= ~(1u << k);
  g->random[k] = NULL;
  g->vehicle &= g->fly;
  g->sensed &= g->fly;
}

// Writes what is true of flights whose bodies are in lanes to where it is read: numbers of eight have the
// same layout everywhere. Returns these flights.
static unsigned see_truth(group_t *g) {
  lanes_truth_t truth = {.number = lanes_truth(g->woven.state)};
  const unsigned seen = abreast_sense(g->bodies, &truth) & g->fly;
  if (!seen) return 0;
  lanes_take_motors(g->woven.state, truth.motors);
  EACH(k, seen) g->up_min[k] = smaller(g->up_min[k], truth.up[k]);
  EACH(k, seen & (g->mocap | ~g->sensed)) woven_get(&g->woven, LANES_truth, k, &g->job[k]->f->truth);
  return seen;
}

static void take_motors(group_t *g) {
  OF_EACH(motor_N, g->vehicle, g->job[k]->f->motor_N);
  woven_get_all(&g->woven, weave_block(LANES_motors), motor_N);
}

// Returns the tick before the one at which a flight has a set point due or is over; rounded the safe way.
static long quiet_until(const flight_loop_t *f) {
  const double until_s = smaller(f->order_s, f->plan->end_s);
  return until_s < 1e6 ? (long)(until_s / LOOP_TICK_S) - 1
                       : LONG_MAX; // 1e6 s: what is later, or never, has no tick
}

static void order(group_t *g) {
  take_motors(g);
  g->until = LONG_MAX;
  EACH(k, g->fly) {
    flight_loop_t *const f = g->job[k]->f;
    f->tick = g->tick;
    const flight_over_t over = loop_tick_order(f);
    if (over != FLIGHT_FLIES) {
      retire(g, k, DONE, over);
      continue;
    }
    const long until = quiet_until(f);
    if (until < g->until) g->until = until;
  }
}

static void begin_tick(group_t *g) {
  const bool orders = g->tick >= g->until;
  if (orders) order(g);
  const unsigned seen = see_truth(g);
  EACH(k, g->fly) {
    flight_loop_t *const f = g->job[k]->f;
    if (!(seen >> k & 1)) {
      group_settle(g, 1u << k);
      f->up_min = g->up_min[k];
      loop_see_truth(f);
      g->up_min[k] = f->up_min;
      woven_put(&g->woven, LANES_truth, k, &f->truth);
    }
    if (orders && f->ordered) woven_set(&g->woven, k, &f->in);
  }
}

static void get_sample(group_t *g, unsigned of) {
  group_settle(g, of);
  OF_EACH(truth, of, &g->job[k]->f->truth);
  OF_EACH(in, of, &g->job[k]->f->in);
  OF_EACH(estimate, of & g->sensed, &g->job[k]->f->senses.estimate);
  woven_get_all(&g->woven, weave_block(LANES_truth), truth);
  woven_get_all(&g->woven, &g->woven.felt, in);
  woven_get_all(&g->woven, &g->woven.moved, in);
  woven_get_all(&g->woven, weave_block(LANES_estimate), estimate);
  OF_EACH(app, of & g->vehicle, &g->job[k]->f->pilot->vehicle->app);
  woven_get_all(&g->woven, &g->woven.curve, app);
  woven_get_all(&g->woven, &g->woven.learned, app);
  woven_get_all(&g->woven, &g->woven.guard, app);
}

static void sample(group_t *g) {
  unsigned of = 0;
  EACH(k, g->fly) if (g->tick % g->every[k] == 0) of |= 1u << k;
  if (!of) return;
  take_motors(g);
  get_sample(g, of);
  EACH(k, of) {
    job_t *const job = g->job[k];
    flight_loop_t *const f = job->f;
    f->tick = g->tick;
    f->up_min = g->up_min[k];
    f->gap_min_m = g->gap_min_m[k];
    const tick_t seen = loop_look(f);
    g->up_min[k] = f->up_min;
    g->gap_min_m[k] = f->gap_min_m;
    if (f->order_s == 0.0) g->until = 0; // its set point may count from another ceiling
    const done_t status = record_add(job->record, &seen, job->why);
    if (status != DONE) retire(g, k, status, FLIGHT_FLIES);
  }
}

static void move_each(group_t *g, body_t *const bodies[LANES]) {
  take_motors(g);
  EACH(k, g->fly) {
    abreast_recall(g->bodies, k, bodies[k]);
    body_command(bodies[k], g->job[k]->f->motor_N, LOOP_TICK_S);
  }
  lanes_seen_t seen;
  double vbat_V[LANES];
  const unsigned moved = abreast_move(g->bodies, bodies, &seen, vbat_V);
  EACH(k, g->fly) {
    flight_loop_t *const f = g->job[k]->f;
    f->gap_min_m = g->gap_min_m[k];
    if (moved >> k & 1)
      loop_moved(f, seen.rotors_N[k], vbat_V[k], seen.gap_m[k]);
    else
      loop_moved(f, body_rotors_N(&f->body), f->body.vbat_V, body_gap_m(&f->body));
    g->gap_min_m[k] = f->gap_min_m;
  }
  OF_EACH(in, g->fly, &g->job[k]->f->in);
  woven_put_all(&g->woven, &g->woven.moved, in);
}

// Flights that had to move alone after all get their row from loop_moved().
static void moved_alone(group_t *g, unsigned alone) {
  EACH(k, alone) {
    flight_loop_t *const f = g->job[k]->f;
    f->gap_min_m = g->gap_min_m[k];
    loop_moved(f, body_rotors_N(&f->body), f->body.vbat_V, body_gap_m(&f->body));
    g->gap_min_m[k] = f->gap_min_m;
    woven_put_part(&g->woven, &g->woven.moved, k, &f->in);
  }
}

// Does what body_command() and loop_moved() do, by rows: commands and what comes of them stay in lanes.
static void move_rows(group_t *g, body_t *const bodies[LANES]) {
  enum { ROTORS_N = PILOT_MOTORS, VBAT_V };
  const double *const motor_N = woven_motors(&g->woven);
  double *const to = woven_moved(&g->woven);
  int others = 0;
  for (int i = 0; i < PILOT_MOTORS * LANES; i++) others += !(fabs(motor_N[i]) <= DBL_MAX);
  lanes_seen_t seen;
  const unsigned moved = abreast_move_again(g->bodies, bodies, motor_N, to, &seen, to + LANES * VBAT_V);
  memcpy(to + LANES * ROTORS_N, seen.rotors_N, sizeof seen.rotors_N);
  EACH(k, moved) g->gap_min_m[k] = smaller(g->gap_min_m[k], seen.gap_m[k]);
  moved_alone(g, g->fly & ~moved);
  if (others > 0 || !abreast_again(g->bodies, bodies)) g->until = 0; // a flight is not finite, or parted
}

static void move(group_t *g) {
  body_t *bodies[LANES] = {NULL};
  EACH(k, g->fly) bodies[k] = &g->job[k]->f->body;
  if (g->vehicle == g->fly && abreast_again(g->bodies, bodies)) {
    move_rows(g, bodies);
  } else {
    move_each(g, bodies);
    g->until = 0;
  }
  g->tick++;
}

// --- flights -----------------------------------------------------------------------------------------------

static void begin(group_t *g) {
  int some = -1, pilot = -1;
  g->fly = g->vehicle = g->out = g->edited = g->mocap = g->keeps = g->looked = 0;
  g->around = NULL;
  g->tick = g->until = 0;
  for (int k = 0; k < LANES; k++) {
    const flight_loop_t *const f = g->job[k] ? g->job[k]->f : NULL;
    g->random[k] = f ? f->random : NULL;
    if (!f) continue;
    g->every[k] = f->every;
    g->up_min[k] = f->up_min;
    g->gap_min_m[k] = f->gap_min_m;
    g->fly |= 1u << (some = k);
    if (f->plan->mocap.period_s > 0.0) g->mocap |= 1u << k;
    g->apart_sensed[k] = APART_NEVER;
    group_begin_vehicle(g, k);
    if (g->vehicle >> k & 1) pilot = k;
  }
  // An empty lane repeats the flight of another.
  for (int k = 0; k < LANES; k++) {
    woven_begin_flight(&g->woven, k, g->job[g->fly >> k & 1 ? k : some]->f);
    if (pilot >= 0)
      woven_begin_vehicle(&g->woven, k, g->job[g->vehicle >> k & 1 ? k : pilot]->f->pilot->vehicle);
  }
  g->sensed = g->fly;
  lanes_begin_anew(g->woven.state);
  abreast_forget(g->bodies);
}

static void fly_together(group_t *g) {
  begin(g);
  for (;;) {
    begin_tick(g);
    if (g->fly == 0) return;
    for (int ms = 0; ms < 2; ms++) {
      g->ms = (uint32_t)(2 * g->tick + ms);
      group_sense(g);
      group_pilots(g);
      if (ms == 1) sample(g);
      lanes_step(g->woven.state);
    }
    move(g);
  }
}

static void fly_all(void *self, void *const what[LANES]) {
  group_t *const g = self;
  int n = 0;
  for (int k = 0; k < LANES; k++) n += (g->job[k] = what[k]) != NULL;
  if (n >= TOGETHER_FEWEST) {
    fly_together(g);
    return;
  }
  for (int k = 0; k < LANES; k++) {
    job_t *const j = g->job[k];
    if (j) j->status = loop_run(j->f, j->record, j->finite, j->why);
  }
}

bool together_waits(const flight_loop_t *f) {
  return turns_meet_at(fly_all) && !f->plan->vertical_only && f->tick == 0;
}

done_t together_fly(flight_loop_t *f, record_t *record, bool *finite, why_t *why) {
  job_t job = {.f = f, .record = record, .finite = finite, .why = why, .status = FAILED};
  turns_wait(&job);
  return job.status;
}

long together(int n, void (*flight)(void *context, int i), void *context) {
  group_t g = {.bodies = NULL};
  if (n >= TOGETHER_FEWEST && !turns_inside() && woven_open(&g.woven)) g.bodies = abreast_open(lane_bits());
  const turns_t turns = {.job = flight, .meet = fly_all, .context = context, .meet_context = &g};
  if (g.bodies) heap_keep();
  if (g.bodies)
    turns_run(&turns, n);
  else
    for (int i = 0; i < n; i++) flight(context, i);
  abreast_close(g.bodies);
  woven_close(&g.woven);
  return g.together;
}
