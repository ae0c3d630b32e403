// drone.c - one simulated Crazyflie that clients fly.
#include "drone/drone.h"

#include "crazyflie/sections.h"
#include "crazyflie/values.h"
#include "drone/beside.h"
#include "pilots/pilot_outer.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define COVERED_M 0.04 // what the covered upward sensor reads
#define ROWS      100  // samples kept before they are written: one second
#define FOREVER_S 1e7
#define TICK_MS   2
#define BESIDE_MS 100 // period of the firmware's sideways sensors

uint32_t drone_now_ms(const drone_t *d) {
  return d->now_ms;
}

int drone_first_param(const drone_t *d) {
  return firmware_params(&d->firmware) - desk_param_count;
}

static void *params_of(void *context) {
  return &((drone_t *)context)->params;
}
static void *logs_of(void *context) {
  return &((drone_t *)context)->logs;
}

// Puts a written value back if it is out of its range, and tells the client.
static void written(void *context, int i) {
  drone_t *const d = context;
  why_t why;
  const int number = drone_first_param(d) + i;
  if (desk_param_check(desk_param_rows[i].name, firmware_param(&d->firmware, number), &why) == DONE) return;
  stand_in_print("DESK: %s\n", why.text);
  memcpy((char *)&d->params + desk_param_rows[i].offset, (const char *)&d->was + desk_param_rows[i].offset,
         (size_t)link_param_bytes(desk_param_rows[i].type));
  link_params_changed(&d->link, number);
}

done_t drone_set(drone_t *d, const char *name, double value, why_t *why) {
  const int i = desk_param_find(name);
  TRY(desk_param_check(name, value, why));
  // Written by a packet, so that it stands in the commands. The client did not ask for it, and is told.
  const int number = drone_first_param(d) + i, type = desk_param_rows[i].type;
  uint8_t packet[7] = {0x2e, (uint8_t)number, (uint8_t)(number >> 8)};
  values_put(type, packet + 3, value);
  drone_take(d, packet, 3 + link_param_bytes(type));
  link_params_changed(&d->link, number);
  return DONE;
}

// --- in the loop -------------------------------------------------------------------------------------------

static void step(void *context, const pilot_in_t *in, double motor_N[PILOT_MOTORS]) {
  drone_t *const d = context;
  pilot_in_t sensed = *in;
  if (d->params.cover) sensed.range_m = COVERED_M;
  firmware_ms(&d->firmware, &sensed, motor_N);
  link_ms(&d->link);
}

static void reset(void *context) {
  (void)context;
}

static void tell(const void *context, thoughts_t *thoughts) {
  const drone_t *const d = context;
  const flight_t *const flight = &d->firmware.vehicle.app.flight;
  pilot_outer_tell(&flight->outer, thoughts);
  thoughts->guard_now = flight->guard.now;
  thoughts->guard_latched = flight->guard.latched;
}

// --- a flight ----------------------------------------------------------------------------------------------

static done_t write_rows(drone_t *d, why_t *why) {
  if (!d->log) return DONE;
  record_write_rows(&d->record, d->log);
  d->record.n = 0;
  if (fflush(d->log) != 0 || ferror(d->log)) return error_failed(why, "the log cannot be written");
  return DONE;
}

static done_t keep(drone_t *d, why_t *why) {
  if (!d->log) return DONE;
  const int width = sections_logs();
  const model_t *const m = loop_model(d->loop);
  d->seen.t_s = 1e-3 * (double)(d->now_ms - TICK_MS); // restarts included
  d->seen.setpoint_m = (double)d->firmware.vehicle.setpoint.position.z + body_rest_z_m(m) + body_rotor_z_m(m);
  TRY(record_add(&d->record, &d->seen, why));
  crazyflie_logs(&d->firmware.vehicle, d->record.app + (size_t)(d->record.n - 1) * (size_t)width);
  return d->record.n == ROWS ? write_rows(d, why) : DONE;
}

static void look(drone_t *d) {
  const body_t *const b = d->seen.body;
  d->logs.x = (float)b->y[RIGID_POS_M];
  d->logs.y = (float)b->y[RIGID_POS_M + 1];
  d->logs.z = (float)b->y[RIGID_POS_M + 2];
  d->logs.gap = (float)body_gap_m(b);
  d->logs.ratio = (float)body_thrust_ratio(b, 0);
  d->logs.contacts = (uint32_t)b->ceiling_contacts;
  for (int i = 0; i < 6; i++) {
    const ekf_t *const e = loop_estimator(d->loop);
    d->firmware.variance[i] = (float)e->P[i][i];
  }
}

// Fills rangeFront .. rangeRight.
static void look_beside(drone_t *d) {
  if (d->on_ms % BESIDE_MS != 0) return;
  const double *const y = loop_body(d->loop)->y;
  beside_look(d3_of(y + RIGID_POS_M), dq_of(y + RIGID_Q_WB), loop_model(d->loop)->wall_y_m, d->params.hand,
              d->firmware.vehicle.around.range_mm);
}

// When kalman.resetEstimation rises to 1, the estimate starts anew at kalman.initial*, as in the firmware.
static void reset_estimate(drone_t *d) {
  const stock_params_t *const p = &d->firmware.params;
  const bool asked = p->kalman_resetEstimation == 1, rises = asked && !d->reset_asked;
  d->reset_asked = asked;
  if (!rises) return;
  ekf_t *const e = loop_estimator(d->loop);
  ekf_init(e, &ekf_firmware, (double)p->kalman_initialYaw);
  e->s[0] = (double)p->kalman_initialX;
  e->s[1] = (double)p->kalman_initialY;
  e->s[2] = (double)p->kalman_initialZ;
  e->updated = true; // so that it is handed out
}

static void follow(drone_t *d) {
  for (const event_t *e; (e = disturbed_due(&d->disturbed, &d->scene, d->on_ms)) != NULL;) {
    const int number = drone_first_param(d) + e->param;
    firmware_param_put(&d->firmware, number, e->value);
    link_params_changed(&d->link, number);
  }
  disturbed_follow(&d->disturbed, d->loop, &d->params, &d->was);
  d->was = d->params;
}

static done_t tick(drone_t *d, why_t *why) {
  d->now_ms += TICK_MS;
  if (!d->finite) return DONE;
  follow(d);
  reset_estimate(d);
  look_beside(d);
  d->on_ms += TICK_MS;
  bool is_sample;
  d->finite = loop_tick(d->loop, &d->seen, &is_sample) == FLIGHT_FLIES;
  if (!d->finite) {
    stand_in_print("DESK: it flies no more, its state is no number; desk.restart 1 puts it back\n");
    link_ms(&d->link);
    return DONE;
  }
  if (is_sample) {
    d->has_seen = true;
    look(d);
    TRY(keep(d, why));
  }
  loop_move(d->loop);
  d->params.battery = d->was.battery = (float)loop_body(d->loop)->charge;
  return DONE;
}

// The app waits in a parameter's callback: all else goes on meanwhile.
static void wait(void *context, uint32_t ms) {
  drone_t *const d = context;
  why_t why;
  for (uint32_t i = 0; i < ms; i += TICK_MS)
    if (tick(d, &why) != DONE) return; // a log that cannot be written fails again at the next tick
}

void drone_take(drone_t *d, const uint8_t *bytes, int size) {
  if (d->commands) {
    fprintf(d->commands, "%u ", drone_now_ms(d));
    for (int i = 0; i < size; i++) fprintf(d->commands, "%02x", bytes[i]);
    fputc('\n', d->commands);
  }
  stand_in = &d->firmware.vehicle.around;
  link_take(&d->link, bytes, size);
}

void drone_left(drone_t *d) {
  if (d->commands) fprintf(d->commands, "%u\n", drone_now_ms(d));
  link_reset(&d->link);
}

// --- switching on and off ----------------------------------------------------------------------------------

static done_t switch_on(drone_t *d, why_t *why) {
  firmware_t *const f = &d->firmware;
  TRY(firmware_open(f, &d->scene.setup.model, why));
  f->more = &d->more;
  f->more_context = f->rest_context = d;
  f->rest = wait;
  f->changed = link_params_changed;
  f->changed_context = &d->link;
  if (d->storage.value)
    storage_restore(&d->storage, f);
  else
    TRY(storage_open(&d->storage, d->stored, f, why));
  firmware_start(f);
  TRY(loop_open(&d->loop, &d->plan, &d->scene.setup.model, &d->pilot, &d->drawn, why));
  loop_body(d->loop)->charge = d->scene.battery;
  d->finite = true;
  d->reset_asked = d->has_seen = false;
  d->on_ms = 0;
  d->was = d->params;
  disturbed_begin(&d->disturbed, d->loop, &d->params);
  return DONE;
}

static void switch_off(drone_t *d) {
  loop_close(d->loop);
  d->loop = NULL;
  firmware_close(&d->firmware);
}

// Sets the desk parameters back as well. The link stays up, which a real vehicle's would not.
static void begin(drone_t *d) {
  for (int i = 0; i < desk_param_count; i++)
    values_put(desk_param_rows[i].type, (char *)&d->params + desk_param_rows[i].offset, d->initial[i]);
}

static done_t restart(drone_t *d, why_t *why) {
  const int n = firmware_params(&d->firmware);
  double *const was = malloc((size_t)n * sizeof *was);
  if (!was) return error_failed(why, "out of memory");
  for (int i = 0; i < n; i++) was[i] = firmware_param(&d->firmware, i);
  switch_off(d);
  begin(d);
  const done_t status = switch_on(d, why);
  if (status == DONE) {
    link_restarted(&d->link);
    for (int i = 0; i < n; i++)
      if (firmware_param(&d->firmware, i) != was[i]) link_params_changed(&d->link, i);
  }
  free(was);
  return status;
}

done_t drone_tick(drone_t *d, why_t *why) {
  if (d->params.restart) TRY(restart(d, why));
  return tick(d, why);
}

static void plan(drone_t *d) {
  const scene_t *const s = &d->scene;
  d->plan = (plan_t){.n_way = 1,
                     .end_s = FOREVER_S,
                     .take_off_s = FOREVER_S,
                     .seed = s->seed,
                     .integrate = INTEGRATE_RK4,
                     .noise = s->setup.plan.noise,
                     .start = body_standing(&s->setup.model),
                     .in_flight = true};
  d->plan.start.discharged = 1.0 - s->battery;
  d->pilot = (pilot_t){.state = d, .step = step, .reset = reset, .tell = tell};
}

static done_t open_log(drone_t *d, why_t *why) {
  if (!d->log) return DONE;
  TRY(record_reserve(&d->record, ROWS, why));
  d->record.app = malloc(sizeof(float) * (size_t)ROWS * (size_t)sections_logs());
  if (!d->record.app) return error_failed(why, "out of memory");
  record_write_names(&d->record, d->log);
  return DONE;
}

static done_t open(drone_t *d, why_t *why) {
  TRY(disturbed_open(&d->disturbed, &d->scene.setup.model, why));
  plan(d);
  for (int i = 0; i < desk_param_count; i++) d->initial[i] = desk_ranges[i].initial;
  d->initial[desk_param_find("ceiling")] = fmin(d->scene.setup.model.ceiling_m, DISTURBED_NO_CEILING_M);
  d->initial[desk_param_find("battery")] = d->scene.battery;
  d->initial[desk_param_find("loss")] = d->scene.loss;
  d->initial[desk_param_find("delay")] = d->scene.delay_s;
  begin(d);
  d->more = (firmware_more_t){desk_param_rows, desk_log_rows, desk_param_count, desk_log_count,
                              params_of,       logs_of,       d->initial,       written};
  TRY(open_log(d, why));
  TRY(switch_on(d, why));
  link_init(&d->link, &d->firmware, &d->storage);
  return DONE;
}

done_t drone_open(drone_t *d, const scene_t *scene, const char *storage, FILE *log, FILE *commands,
                  why_t *why) {
  memset(d, 0, sizeof *d);
  d->scene = *scene;
  d->stored = storage;
  d->log = log;
  d->commands = commands;
  const done_t status = open(d, why);
  if (status == DONE) return DONE;
  d->log = d->commands = NULL; // nothing to write: nothing has flown
  why_t lost;
  (void)!drone_close(d, &lost);
  return status;
}

done_t drone_close(drone_t *d, why_t *why) {
  const done_t status = write_rows(d, why);
  record_free(&d->record);
  switch_off(d);
  storage_close(&d->storage);
  if (status == DONE && d->commands && (fflush(d->commands) != 0 || ferror(d->commands)))
    return error_failed(why, "the recording of what came over the link cannot be written");
  return status;
}
