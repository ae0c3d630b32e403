// woven.c - copies flights into lanes and out, and repeats alone the milliseconds of one that parted.
#include "flight/woven.h"

#include "crazyflie/crazyflie.h"
#include "flight/lanes_blocks.h"
#include <string.h>

void woven_put(woven_t *w, int block, int k, void *one) {
  weave_put(weave_block(block), lanes_block(w->state, block), k, one);
}
void woven_get(woven_t *w, int block, int k, void *one) {
  weave_get(weave_block(block), lanes_block(w->state, block), k, one);
}
static void get_before(woven_t *w, int block, int k, void *one) {
  weave_get(weave_block(block), lanes_block_before(w->state, block), k, one);
}
void woven_put_part(woven_t *w, const weave_t *part, int k, const void *one) {
  weave_put(part, lanes_block(w->state, part->block), k, one);
}
void woven_get_part(woven_t *w, const weave_t *part, int k, void *one) {
  weave_get(part, lanes_block(w->state, part->block), k, one);
}
static double *rows_of(woven_t *w, const weave_t *part) {
  return (double *)(void *)((char *)lanes_block(w->state, part->block) + part->run[0].eight);
}
double *woven_noise_of_imu(woven_t *w) {
  return rows_of(w, &w->noise_of_imu);
}
double *woven_motors(woven_t *w) {
  return rows_of(w, weave_block(LANES_motors));
}
double *woven_moved(woven_t *w) {
  return rows_of(w, &w->moved);
}
void woven_put_all(woven_t *w, const weave_t *part, void *const one[LANES]) {
  weave_put_all(part, lanes_block(w->state, part->block), (const void *const *)one);
}
void woven_get_all(woven_t *w, const weave_t *part, void *const one[LANES]) {
  weave_get_all(part, lanes_block(w->state, part->block), one);
}
void woven_set(woven_t *w, int k, const pilot_in_t *in) {
  woven_put_part(w, &w->set, k, in);
  lanes_set_new(w->state);
}
static void get_part_before(woven_t *w, const weave_t *part, int k, void *one) {
  weave_get(part, lanes_block_before(w->state, part->block), k, one);
}

#define PART(block, type, from, to) weave_part(block, offsetof(type, from), offsetof(type, to))
static void take_parts(woven_t *p) {
  p->noise_of_imu = PART(LANES_drawn, senses_drawn_t, imu, range);
  p->drawn_more = weave_part(LANES_drawn, offsetof(senses_drawn_t, range), sizeof(senses_drawn_t));
  p->set = weave_part(LANES_in, offsetof(pilot_in_t, set), sizeof(pilot_in_t));
  p->felt = PART(LANES_in, pilot_in_t, gyro_b_radps, applied_N);
  p->moved = PART(LANES_in, pilot_in_t, applied_N, range_new);
  p->now = weave_part(LANES_app, 0, offsetof(glue_t, tuned));
  p->range_begin = weave_part(LANES_range, 0, offsetof(range_t, up_m));
  p->range_end = weave_part(LANES_range, offsetof(range_t, up_mm), sizeof(range_t));
  p->curve = PART(LANES_app, glue_t, flight.outer.out, flight.outer.faults);
  p->learned = PART(LANES_app, glue_t, flight.outer.learn, flight.att);
  p->guard = PART(LANES_app, glue_t, flight.guard, flight.guard.action);
  p->ranges = PART(LANES_in, pilot_in_t, range_new, set);
}

void woven_look(woven_t *w, const pilot_around_t *around) {
  w->looked = (weave_t){.block = LANES_app};
  for (int i = 0; i < around->n; i++) {
    const weave_t part = weave_part(LANES_app, around->part[i].from, around->part[i].to);
    for (int k = 0; k < part.n && w->looked.n < WEAVE_RUNS; k++) w->looked.run[w->looked.n++] = part.run[k];
  }
}

void woven_get_looked(woven_t *w, void *const app[LANES]) {
  weave_get_changed(&w->looked, lanes_block(w->state, LANES_app), lanes_looked(w->state), app);
}

// Past distances are taken from now: repeating a millisecond writes the same places again.
static void get_range_before(woven_t *w, int k, range_t *range) {
  woven_get(w, LANES_range, k, range);
  get_part_before(w, &w->range_begin, k, range);
  get_part_before(w, &w->range_end, k, range);
}

typedef void way_t(woven_t *w, int block, int k, void *one);

static void all_of_vehicle(woven_t *w, way_t *way, int k, crazyflie_t *c) {
  way(w, LANES_around, k, &c->around);
  way(w, LANES_supervised, k, &c->supervised);
  way(w, LANES_setpoint, k, &c->setpoint);
  way(w, LANES_sensors, k, &c->sensors);
  way(w, LANES_state, k, &c->state);
  way(w, LANES_power, k, &c->power);
  way(w, LANES_forces, k, c->control.normalizedForces);
  way(w, LANES_mode, k, &c->control.controlMode);
  way(w, LANES_q_wb, k, &c->q_wb);
  way(w, LANES_ordered, k, &c->ordered);
  way(w, LANES_asked, k, &c->asked);
  way(w, LANES_called, k, &c->called);
}

static void put_build(woven_t *w, int k, crazyflie_t *c) {
  woven_put(w, LANES_supervised_by, k, &c->supervised_by);
  woven_put(w, LANES_stop, k, &c->stop);
  woven_put(w, LANES_firmware, k, &c->firmware);
  woven_put(w, LANES_compensates, k, &c->compensates);
  woven_put(w, LANES_map, k, &c->map);
}

static void all_of_senses(woven_t *w, way_t *way, int k, senses_t *s) {
  way(w, LANES_imu, k, &s->imu);
  way(w, LANES_seen, k, &s->seen);
  way(w, LANES_ekf, k, &s->ekf);
  way(w, LANES_estimate, k, &s->estimate);
}

static void put_motors(woven_t *w, int k, const flight_loop_t *f) {
  lanes_motors_t motors;
  memcpy(motors.N, f->motor_N, sizeof motors.N);
  woven_put(w, LANES_motors, k, &motors);
}

void woven_senses_back(woven_t *w, int k, flight_loop_t *f) {
  all_of_senses(w, woven_put, k, &f->senses);
  woven_put(w, LANES_range, k, &f->senses.range);
}

void woven_tell_sensed(woven_t *w, int k, const flight_loop_t *f) {
  woven_put_part(w, &w->felt, k, &f->in);
  woven_put_part(w, &w->ranges, k, &f->in);
}

void woven_begin_flight(woven_t *w, int k, flight_loop_t *f) {
  woven_senses_back(w, k, f);
  woven_put(w, LANES_imu_param, k, &f->noise.imu);
  woven_put(w, LANES_range_param, k, &f->noise.range);
  woven_put(w, LANES_in, k, &f->in);
  put_motors(w, k, f);
}

void woven_begin_vehicle(woven_t *w, int k, crazyflie_t *c) {
  all_of_vehicle(w, woven_put, k, c);
  woven_put(w, LANES_app, k, &c->app);
  put_build(w, k, c);
}

void woven_end_senses(woven_t *w, int k, flight_loop_t *f) {
  all_of_senses(w, woven_get, k, &f->senses);
  woven_get(w, LANES_range, k, &f->senses.range);
}

void woven_end_vehicle(woven_t *w, int k, crazyflie_t *c) {
  all_of_vehicle(w, woven_get, k, c);
  woven_get(w, LANES_app, k, &c->app);
}

bool woven_open(woven_t *w) {
  w->state = weave_block(0) ? lanes_state_open() : NULL;
  if (!w->state) return false;
  take_parts(w);
  return true;
}

void woven_close(woven_t *w) {
  lanes_state_close(w->state);
  w->state = NULL;
}

// --- vehicles out of lanes, and back -----------------------------------------------------------------------

void woven_vehicle_home(woven_t *w, int k, flight_loop_t *f) {
  woven_end_vehicle(w, k, f->pilot->vehicle);
  woven_get(w, LANES_motors, k, f->motor_N);
}

// The lane flew on without the vehicle, so what was last looked at there is replaced by what the vehicle has.
// Otherwise a number that in the first millisecond becomes what the lane had would not count as changed.
void woven_vehicle_back(woven_t *w, int k, flight_loop_t *f) {
  woven_begin_vehicle(w, k, f->pilot->vehicle);
  weave_put(&w->looked, lanes_looked(w->state), k, &f->pilot->vehicle->app);
  put_motors(w, k, f);
}

// --- flights that parted, alone ----------------------------------------------------------------------------

void woven_sense_alone(woven_t *w, int k, flight_loop_t *f) {
  const lanes_since_t since = lanes_senses_since(w->state);
  senses_drawn_t drawn;
  truth_t truth;
  all_of_senses(w, get_before, k, &f->senses);
  get_range_before(w, k, &f->senses.range);
  woven_get(w, LANES_in, k, &f->in);
  for (int ms = 0; ms < since.ms; ms++) {
    weave_get(weave_block(LANES_drawn), since.of[ms], k, &drawn);
    weave_get(weave_block(LANES_truth), since.truth[ms], k, &truth);
    senses_take(&f->senses, &f->noise.imu, &f->noise.range, &drawn, &truth, &f->in);
  }
  woven_tell_sensed(w, k, f);
}

void woven_pilot_alone(woven_t *w, int k, flight_loop_t *f) {
  crazyflie_t *const c = f->pilot->vehicle;
  all_of_vehicle(w, get_before, k, c);
  woven_get(w, LANES_app, k, &c->app); // parameters as they are now
  get_part_before(w, &w->now, k, &c->app);
  const lanes_since_t since = lanes_vehicle_since(w->state);
  for (int ms = 0; ms < since.ms; ms++) {
    pilot_in_t in = {0};
    weave_get(weave_block(LANES_in), since.of[ms], k, &in);
    crazyflie_ms(c, &in, f->motor_N);
  }
}
