// together.c - flights eight at a time.
#include "flight/together.h"

#include "base/larger.h"
#include "base/turns.h"
#include "body/abreast.h"
#include "crazyflie/crazyflie.h"
#include "flight/lanes_blocks.h"
#include "flight/loop_parts.h"
#include "flight/weave.h"
#include <string.h>

typedef struct {
  flight_loop_t *f;
  record_t *record;
  bool *finite;
  why_t *why;
  done_t status;
} job_t;

// Parts of blocks that go in and out every millisecond, tick or sample.
typedef struct {
  weave_t noise_of_imu, set, moved;    // in
  weave_t now, range_begin, range_end; // of an app and of its range sensors, since some milliseconds
  weave_t curve, learned, guard;       // what pilot_t.tell() speaks of
} parts_t;

typedef struct {
  lanes_state_t *state;
  parts_t part;
  abreast_t *bodies;
  job_t *job[LANES];
  unsigned fly;     // lanes in which a flight is, a bit each
  unsigned vehicle; // of these, those whose pilot is in lanes, too
  long together;
} group_t;

#define EACH(k, of)                                                                                          \
  for (int k = 0; k < LANES; k++)                                                                            \
    if ((of) >> k & 1)

// --- in and out --------------------------------------------------------------------------------------------

static void put(group_t *g, int block, int k, const void *one) {
  weave_put(weave_block(block), lanes_block(g->state, block), k, one);
}
static void get(group_t *g, int block, int k, void *one) {
  weave_get(weave_block(block), lanes_block(g->state, block), k, one);
}
static void get_before(group_t *g, int block, int k, void *one) {
  weave_get(weave_block(block), lanes_block_before(g->state, block), k, one);
}
static void put_part(group_t *g, const weave_t *part, int k, const void *one) {
  weave_put(part, lanes_block(g->state, part->block), k, one);
}
static void get_part(group_t *g, const weave_t *part, int k, void *one) {
  weave_get(part, lanes_block(g->state, part->block), k, one);
}
static void get_part_before(group_t *g, const weave_t *part, int k, void *one) {
  weave_get(part, lanes_block_before(g->state, part->block), k, one);
}

// The body's own numbers.
static void settle(group_t *g, int k) {
  abreast_settle(g->bodies, k, &g->job[k]->f->body);
}

#define PART(block, type, from, to) weave_part(block, offsetof(type, from), offsetof(type, to))
static void take_parts(parts_t *p) {
  p->noise_of_imu = PART(LANES_drawn, senses_drawn_t, imu, range);
  p->set = weave_part(LANES_in, offsetof(pilot_in_t, set), sizeof(pilot_in_t));
  p->moved = PART(LANES_in, pilot_in_t, applied_N, range_new);
  p->now = weave_part(LANES_app, 0, offsetof(glue_t, tuned));
  p->range_begin = weave_part(LANES_range, 0, offsetof(range_t, up_m));
  p->range_end = weave_part(LANES_range, offsetof(range_t, up_mm), sizeof(range_t));
  p->curve = PART(LANES_app, glue_t, flight.outer.out, flight.outer.faults);
  p->learned = PART(LANES_app, glue_t, flight.outer.learn, flight.att);
  p->guard = PART(LANES_app, glue_t, flight.guard, flight.guard.action);
}

// What it remembers does not change but in the place that it writes anew.
static void get_range_before(group_t *g, int k, range_t *range) {
  get(g, LANES_range, k, range);
  get_part_before(g, &g->part.range_begin, k, range);
  get_part_before(g, &g->part.range_end, k, range);
}

typedef void way_t(group_t *g, int block, int k, void *one);

static void put_in(group_t *g, int block, int k, void *one) {
  put(g, block, k, one);
}

static void all_of_vehicle(group_t *g, way_t *way, int k, crazyflie_t *c) {
  way(g, LANES_around, k, &c->around);
  way(g, LANES_supervised, k, &c->supervised);
  way(g, LANES_setpoint, k, &c->setpoint);
  way(g, LANES_sensors, k, &c->sensors);
  way(g, LANES_state, k, &c->state);
  way(g, LANES_power, k, &c->power);
  way(g, LANES_forces, k, c->control.normalizedForces);
  way(g, LANES_mode, k, &c->control.controlMode);
  way(g, LANES_q_wb, k, &c->q_wb);
  way(g, LANES_ordered, k, &c->ordered);
  way(g, LANES_asked, k, &c->asked);
  way(g, LANES_called, k, &c->called);
}

static void put_build(group_t *g, int k, crazyflie_t *c) {
  put(g, LANES_supervised_by, k, &c->supervised_by);
  put(g, LANES_stop, k, &c->stop);
  put(g, LANES_firmware, k, &c->firmware);
  put(g, LANES_compensates, k, &c->compensates);
  put(g, LANES_map, k, &c->map);
}

static void all_of_senses(group_t *g, way_t *way, int k, senses_t *s) {
  way(g, LANES_imu, k, &s->imu);
  way(g, LANES_seen, k, &s->seen);
  way(g, LANES_ekf, k, &s->ekf);
  way(g, LANES_estimate, k, &s->estimate);
}

// Lane k is that flight's, or (where there is none) does as that one does.
static void put_flight(group_t *g, int k, flight_loop_t *f) {
  all_of_senses(g, put_in, k, &f->senses);
  put(g, LANES_range, k, &f->senses.range);
  put(g, LANES_imu_param, k, &f->noise.imu);
  put(g, LANES_range_param, k, &f->noise.range);
  put(g, LANES_in, k, &f->in);
  lanes_motors_t motors;
  memcpy(motors.N, f->motor_N, sizeof motors.N);
  put(g, LANES_motors, k, &motors);
}

static void put_vehicle(group_t *g, int k, crazyflie_t *c) {
  all_of_vehicle(g, put_in, k, c);
  put(g, LANES_app, k, &c->app);
  put_build(g, k, c);
}

// --- a millisecond -----------------------------------------------------------------------------------------

static void draw(group_t *g) {
  EACH(k, g->fly) {
    senses_drawn_t drawn;
    flight_loop_t *const f = g->job[k]->f;
    loop_draw(f, &f->truth, &drawn);
    const bool more = drawn.by_mocap || f->senses.range.tick % RANGE_ANY_PERIOD_MS == 0;
    put_part(g, more ? weave_block(LANES_drawn) : &g->part.noise_of_imu, k, &drawn);
    f->senses.range.tick++;
  }
}

static const void *block_of(const void *first, size_t bytes, int i) {
  return (const char *)first + (size_t)i * bytes;
}

static void sense_alone(group_t *g, int k) {
  flight_loop_t *const f = g->job[k]->f;
  const lanes_since_t since = lanes_senses_since(g->state);
  senses_drawn_t drawn;
  truth_t truth;
  all_of_senses(g, get_before, k, &f->senses);
  get_range_before(g, k, &f->senses.range);
  get(g, LANES_in, k, &f->in);
  for (int ms = 0; ms < since.ms; ms++) {
    weave_get(weave_block(LANES_drawn), block_of(since.first, since.bytes, ms), k, &drawn);
    weave_get(weave_block(LANES_truth), block_of(since.other, since.other_bytes, ms), k, &truth);
    senses_take(&f->senses, &f->noise.imu, &f->noise.range, &drawn, &truth, &f->in);
  }
  all_of_senses(g, put_in, k, &f->senses);
  put(g, LANES_range, k, &f->senses.range);
  put(g, LANES_in, k, &f->in);
}

static void sense(group_t *g) {
  draw(g);
  const unsigned passed = lanes_senses_ms(g->state, g->fly);
  EACH(k, g->fly & ~passed) sense_alone(g, k);
  EACH(k, lanes_range_new(g->state) & g->fly) {
    flight_loop_t *const f = g->job[k]->f;
    get(g, LANES_in, k, &f->in);
    loop_note_range(f);
  }
}

static void pilot_alone(group_t *g, int k) {
  flight_loop_t *const f = g->job[k]->f;
  crazyflie_t *const c = f->pilot->vehicle;
  all_of_vehicle(g, get_before, k, c);
  get(g, LANES_app, k, &c->app); // parameters are those of now
  get_part_before(g, &g->part.now, k, &c->app);
  const lanes_since_t since = lanes_vehicle_since(g->state);
  for (int ms = 0; ms < since.ms; ms++) {
    weave_get(weave_block(LANES_in), block_of(since.first, since.bytes, ms), k, &f->in);
    crazyflie_ms(c, &f->in, f->motor_N);
  }
  all_of_vehicle(g, put_in, k, c);
  put(g, LANES_app, k, &c->app);
  lanes_motors_t motors;
  memcpy(motors.N, f->motor_N, sizeof motors.N);
  put(g, LANES_motors, k, &motors);
}

static void pilots(group_t *g, uint32_t step) {
  if (g->vehicle) {
    const unsigned passed = lanes_vehicle_ms(g->state, g->vehicle);
    EACH(k, g->vehicle & ~passed) pilot_alone(g, k);
    g->together += __builtin_popcount(passed);
  }
  EACH(k, g->vehicle) {
    const pilot_t *const p = g->job[k]->f->pilot;
    if (!p->keeps(p->state, step)) continue;
    get(g, LANES_app, k, &p->vehicle->app);
    p->keep(p->state);
  }
  EACH(k, g->fly & ~g->vehicle) {
    flight_loop_t *const f = g->job[k]->f;
    get(g, LANES_in, k, &f->in);
    if (f->plan->edit) settle(g, k);
    loop_pilot(f);
  }
  lanes_step(g->state);
}

// --- a tick ------------------------------------------------------------------------------------------------

// Out of the lanes, and done.
static void retire(group_t *g, int k, done_t status, flight_over_t over) {
  job_t *const job = g->job[k];
  flight_loop_t *const f = job->f;
  settle(g, k);
  all_of_senses(g, get, k, &f->senses);
  get(g, LANES_range, k, &f->senses.range);
  get(g, LANES_in, k, &f->in);
  if (g->vehicle >> k & 1) {
    all_of_vehicle(g, get, k, f->pilot->vehicle);
    get(g, LANES_app, k, &f->pilot->vehicle->app);
  }
  job->status = status;
  *job->finite = over != FLIGHT_NOT_FINITE;
  g->fly &= ~(1u << k);
  g->vehicle &= g->fly;
}

// What is true, of those whose bodies are in lanes. Numbers of eight lie in one way everywhere.
static unsigned see_truth(group_t *g) {
  lanes_truth_t truth;
  const unsigned seen = abreast_sense(g->bodies, &truth) & g->fly;
  if (!seen) return 0;
  lanes_take_truth(g->state, truth.number[0], truth.motors);
  EACH(k, seen) {
    flight_loop_t *const f = g->job[k]->f;
    f->up_min = smaller(f->up_min, truth.up[k]);
    if (f->plan->mocap.period_s > 0.0) get(g, LANES_truth, k, &f->truth);
  }
  return seen;
}

static void begin_tick(group_t *g) {
  EACH(k, g->fly) {
    const flight_over_t over = loop_tick_order(g->job[k]->f);
    if (over != FLIGHT_FLIES) retire(g, k, DONE, over);
  }
  const unsigned seen = see_truth(g);
  EACH(k, g->fly) {
    flight_loop_t *const f = g->job[k]->f;
    if (!(seen >> k & 1)) {
      settle(g, k);
      loop_see_truth(f);
      put(g, LANES_truth, k, &f->truth);
    }
    if (f->ordered) put_part(g, &g->part.set, k, &f->in);
  }
}

static void sample(group_t *g) {
  EACH(k, g->fly) {
    job_t *const job = g->job[k];
    flight_loop_t *const f = job->f;
    if (!loop_is_sample(f)) continue;
    settle(g, k);
    get(g, LANES_truth, k, &f->truth);
    get(g, LANES_in, k, &f->in);
    get(g, LANES_estimate, k, &f->senses.estimate);
    if (g->vehicle >> k & 1) {
      glue_t *const app = &f->pilot->vehicle->app;
      get_part(g, &g->part.curve, k, app);
      get_part(g, &g->part.learned, k, app);
      get_part(g, &g->part.guard, k, app);
    }
    const tick_t seen = loop_look(f);
    const done_t status = record_add(job->record, &seen, job->why);
    if (status != DONE) retire(g, k, status, FLIGHT_FLIES);
  }
}

static void move(group_t *g) {
  body_t *bodies[LANES] = {NULL};
  EACH(k, g->fly) {
    flight_loop_t *const f = g->job[k]->f;
    bodies[k] = &f->body;
    body_command(&f->body, f->motor_N, LOOP_TICK_S);
  }
  lanes_seen_t seen;
  double vbat_V[LANES];
  const unsigned moved = abreast_move(g->bodies, bodies, &seen, vbat_V);
  EACH(k, g->fly) {
    flight_loop_t *const f = g->job[k]->f;
    if (moved >> k & 1)
      loop_moved(f, seen.rotors_N[k], vbat_V[k], seen.gap_m[k]);
    else
      loop_moved(f, body_rotors_N(&f->body), f->body.vbat_V, body_gap_m(&f->body));
    put_part(g, &g->part.moved, k, &f->in);
    f->tick++;
  }
}

static void take_motors(group_t *g) {
  EACH(k, g->vehicle) {
    lanes_motors_t motors;
    get(g, LANES_motors, k, &motors);
    memcpy(g->job[k]->f->motor_N, motors.N, sizeof motors.N);
  }
}

// --- flights -----------------------------------------------------------------------------------------------

// A pilot whose state nobody touches but the vehicle's millisecond.
static bool is_vehicle(const flight_loop_t *f) {
  const crazyflie_t *const c = f->pilot->vehicle;
  return c && !f->plan->edit && !c->fly && !c->command && !c->around.event && c->app.shadow == 0;
}

static void begin(group_t *g) {
  int some = -1, pilot = -1;
  g->fly = g->vehicle = 0;
  for (int k = 0; k < LANES; k++) {
    if (!g->job[k]) continue;
    g->fly |= 1u << (some = k);
    if (is_vehicle(g->job[k]->f)) g->vehicle |= 1u << (pilot = k);
  }
  for (int k = 0; k < LANES; k++) {
    put_flight(g, k, g->job[g->fly >> k & 1 ? k : some]->f);
    if (pilot >= 0) put_vehicle(g, k, g->job[g->vehicle >> k & 1 ? k : pilot]->f->pilot->vehicle);
  }
  lanes_begin_anew(g->state);
  abreast_forget(g->bodies);
}

static void fly_together(group_t *g) {
  begin(g);
  for (;;) {
    begin_tick(g);
    if (g->fly == 0) return;
    for (int ms = 0; ms < 2; ms++) {
      sense(g);
      pilots(g, (uint32_t)(2 * g->job[__builtin_ctz(g->fly)]->f->tick + ms));
    }
    take_motors(g);
    sample(g);
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
  return turns_inside() && !f->plan->vertical_only && f->tick == 0;
}

done_t together_fly(flight_loop_t *f, record_t *record, bool *finite, why_t *why) {
  job_t job = {.f = f, .record = record, .finite = finite, .why = why, .status = FAILED};
  turns_wait(&job);
  return job.status;
}

long together(int n, void (*flight)(void *context, int i), void *context) {
  group_t g = {.state = NULL};
  if (n >= TOGETHER_FEWEST && !turns_inside() && weave_block(0)) {
    g.state = lanes_state_open();
    g.bodies = g.state ? abreast_open() : NULL;
    take_parts(&g.part);
  }
  const turns_t turns = {.job = flight, .meet = fly_all, .context = context, .meet_context = &g};
  if (g.bodies)
    turns_run(&turns, n);
  else
    for (int i = 0; i < n; i++) flight(context, i);
  abreast_close(g.bodies);
  lanes_state_close(g.state);
  return g.together;
}
