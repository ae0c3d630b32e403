// pilot_flight.c - the whole flight code as a pilot.
#include "pilots/pilot_flight.h"

#include "base/error.h"
#include "crazyflie/sections.h"
#include "firmware/settings.h"
#include "pilots/pilot_outer.h"
#include <stdlib.h>
#include <string.h>

_Static_assert(MOTORS == PILOT_MOTORS, "the same vehicle on both sides");

// Writes parameters that differ from those last sent. False: the app lacks one.
static bool send(pilot_flight_t *p) {
  bool known = true, weights = false;
  for (int i = 0; i < params_count; i++) {
    const param_row_t *const row = &params_table[i];
    const char *const at = (const char *)&p->param + row->offset, *const was =
                                                                      (const char *)&p->sent + row->offset;
    if (memcmp(at, was, 4) == 0) continue;
    known = crazyflie_set(&p->vehicle, row->name, (double)params_get(&p->param, row)) && known;
    weights = weights || settings_is_weight(row);
  }
  p->sent = p->param;
  if (weights) known = crazyflie_set(&p->vehicle, "ceil.commit", COMMIT_TYPED) && known;
  return known;
}

// Only if `touched`: who changes parameters has called crazyflie_home(), and to compare all of them costs as
// much as the supervisor.
static void send_what_differs(pilot_flight_t *p) {
  if (memcmp(&p->param, &p->sent, sizeof p->param) != 0) (void)send(p);
  p->vehicle.touched = false;
}

// At every call, or the second of log_every_ms, as loop keeps its samples.
static bool keeps(const void *state, uint32_t step) {
  const pilot_flight_t *const p = state;
  return p->log_every_ms == 1 || (p->log_every_ms > 1 && step % (uint32_t)p->log_every_ms == 1);
}

// Without memory no more rows are kept.
static void keep(void *state) {
  pilot_flight_t *const p = state;
  const int width = p->log_width;
  if (p->n_log == p->room_log) {
    const int room = p->room_log ? 2 * p->room_log : 1024;
    float *const more = realloc(p->log, (size_t)room * (size_t)width * sizeof *more);
    if (!more) p->log_every_ms = 0;
    if (!more) return;
    p->log = more;
    p->room_log = room;
  }
  crazyflie_logs(&p->vehicle, p->log + (size_t)p->n_log++ * (size_t)width);
}

static void step(void *state, const pilot_in_t *in, double motor_N[PILOT_MOTORS]) {
  pilot_flight_t *const p = state;
  if (p->vehicle.touched) send_what_differs(p);
  crazyflie_ms(&p->vehicle, in, motor_N);
  if (keeps(p, in->step)) keep(p);
}

static void reset(void *state) {
  pilot_flight_t *const p = state;
  (void)send(p);
  crazyflie_start(&p->vehicle);
}

static void tell(const void *state, thoughts_t *thoughts) {
  const pilot_flight_t *const p = state;
  pilot_outer_tell(&p->flight->outer, thoughts);
  thoughts->guard_now = p->flight->guard.now;
  thoughts->guard_latched = p->flight->guard.latched;
}

done_t pilot_flight_init(pilot_flight_t *p, const flight_param_t *param, const model_t *model,
                         pilot_t *pilot) {
  if (params_check(param) != ST_OK) return BAD_INPUT;
  crazyflie_init(&p->vehicle, model);
  p->flight = &p->vehicle.app.flight;
  p->param = *param;
  p->log = NULL;
  p->n_log = p->room_log = 0;
  p->log_every_ms = 0;
  p->log_width = sections_logs();
  memset(&p->sent, 0xff, sizeof p->sent); // nothing is sent yet: no parameter has these bits
  // As a person does who has seen enough of it in shadow.
  if (!crazyflie_set(&p->vehicle, "ceil.shadow", 0.0) || !send(p)) return FAILED;
  crazyflie_start(&p->vehicle);
  *pilot = (pilot_t){.state = p,
                     .step = step,
                     .reset = reset,
                     .tell = tell,
                     .vehicle = &p->vehicle,
                     .keeps = keeps,
                     .keep = keep};
  return DONE;
}
