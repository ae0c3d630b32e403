// drone.c - one simulated Crazyflie that clients fly.
#include "drone/drone.h"

#include "crazyflie/sections.h"
#include "crazyflie/values.h"
#include "pilots/pilot_outer.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define COVERED_M 0.04 // what the sensor says of a hand
#define ROWS      256  // samples kept before they are written
#define FOREVER_S 1e7
#define TICK_MS   2

uint32_t drone_now_ms(const drone_t *d) {
  return d->now_ms;
}

// --- what a person does to it ------------------------------------------------------------------------------

static fx_use_t *effect(drone_t *d, const char *name) {
  model_t *const m = loop_model(d->loop);
  const fx_t *const fx = fx_find(name);
  for (int i = 0; i < m->n_fx; i++)
    if (m->fx[i].fx == fx) return &m->fx[i];
  return NULL;
}

// The scene's own wind and payload stay; what is asked for comes on top.
static void push(drone_t *d) {
  const desk_params_t *const p = &d->params;
  body_push(loop_body(d->loop), d3(1e-3 * (double)p->windX, 1e-3 * (double)p->windY,
                                   1e-3 * ((double)p->windZ - 9.81 * (double)p->payload)));
}

static void move_ceiling(drone_t *d) {
  model_t *const m = loop_model(d->loop);
  m->ceiling_m = (double)d->params.ceiling;
  body_surround(&loop_body(d->loop)->touch, m);
}

static void weaken(drone_t *d) {
  fx_use_t *const use = effect(d, "motor_damage");
  if (!use) return;
  use->p[0] = d->params.weakMotor ? d->params.weakMotor : 1.0;
  use->p[1] = d->params.weakMotor ? (double)d->params.weakBy : 0.0;
  use->p[2] = 0.0;
}

static bool changed(const void *now, const void *was, size_t size) {
  return memcmp(now, was, size) != 0;
}

static void apply(drone_t *d) {
  const desk_params_t *const p = &d->params, *const w = &d->was;
  if (changed(&p->ceiling, &w->ceiling, sizeof p->ceiling)) move_ceiling(d);
  if (changed(&p->windX, &w->windX, 3 * sizeof(float)) ||
      changed(&p->payload, &w->payload, sizeof p->payload))
    push(d);
  if (p->weakMotor != w->weakMotor || changed(&p->weakBy, &w->weakBy, sizeof p->weakBy)) weaken(d);
  if (changed(&p->battery, &w->battery, sizeof p->battery)) loop_body(d->loop)->charge = (double)p->battery;
  d->was = *p;
}

static void *params_of(void *context) {
  return &((drone_t *)context)->params;
}
static void *logs_of(void *context) {
  return &((drone_t *)context)->logs;
}

static int first_param(const drone_t *d) {
  return firmware_params(&d->firmware) - desk_param_count;
}

// What is out of its range is put back, and the client is told.
static void written(void *context, int i) {
  drone_t *const d = context;
  const int number = first_param(d) + i;
  const double value = firmware_param(&d->firmware, number);
  const desk_range_t *const range = &desk_ranges[i];
  if (value >= range->min && value <= range->max) return;
  stand_in_print("DESK: desk.%s: allowed is %g to %g %s\n", desk_param_rows[i].name, range->min, range->max,
                 range->unit);
  memcpy((char *)&d->params + desk_param_rows[i].offset, (const char *)&d->was + desk_param_rows[i].offset,
         (size_t)link_param_bytes(desk_param_rows[i].type));
  link_params_changed(&d->link, number);
}

const char *drone_set(drone_t *d, const char *name, double value) {
  static _Thread_local char says[128];
  for (int i = 0; i < desk_param_count; i++) {
    const stock_row_t *const row = &desk_param_rows[i];
    if (strcmp(row->name, name) != 0) continue;
    if (!(value >= desk_ranges[i].min && value <= desk_ranges[i].max)) {
      snprintf(says, sizeof says, "desk.%s: allowed is %g to %g %s", name, desk_ranges[i].min,
               desk_ranges[i].max, desk_ranges[i].unit);
      return says;
    }
    // Over the link, so that it stands in the commands and the client hears of it.
    const int number = first_param(d) + i, bytes = link_param_bytes(row->type);
    uint8_t packet[7] = {0x2e, (uint8_t)number, (uint8_t)(number >> 8)};
    values_put(row->type, packet + 3, value);
    drone_take(d, packet, 3 + bytes);
    return NULL;
  }
  return "there is no such parameter in the group desk";
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
  TRY(record_add(&d->record, &d->seen, why));
  crazyflie_logs(&d->firmware.vehicle, d->record.app + (size_t)(d->record.n - 1) * (size_t)width);
  return d->record.n == ROWS ? write_rows(d, why) : DONE;
}

static void look(drone_t *d) {
  const body_t *const b = d->seen.body;
  d->logs.x = (float)b->y[RIGID_POS_M];
  d->logs.y = (float)b->y[RIGID_POS_M + 1];
  d->logs.z = (float)b->y[RIGID_POS_M + 2];
  d->logs.gap = (float)record_gap_m(b);
  d->logs.ratio = (float)body_thrust_ratio(b, 0);
  d->logs.contacts = (uint32_t)b->ceiling_contacts;
  for (int i = 0; i < 6; i++) {
    const ekf_t *const e = loop_estimator(d->loop);
    d->firmware.variance[i] = (float)e->P[i][i];
  }
}

// A rise of kalman.resetEstimation: back to where the estimate starts, as the firmware does.
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
}

static done_t tick(drone_t *d, why_t *why) {
  apply(d);
  reset_estimate(d);
  d->now_ms += TICK_MS;
  if (!d->finite) return DONE;
  bool is_sample;
  d->finite = loop_tick(d->loop, &d->seen, &is_sample) == FLIGHT_FLIES;
  if (!d->finite) return DONE;
  if (is_sample) {
    d->has_seen = true;
    look(d);
    TRY(keep(d, why));
  }
  loop_move(d->loop);
  d->params.battery = d->was.battery = (float)loop_body(d->loop)->charge;
  return DONE;
}

// The app waits in a parameter's callback: the others go on.
static void wait(void *context, uint32_t ms) {
  drone_t *const d = context;
  why_t why;
  for (uint32_t i = 0; i < ms; i += TICK_MS)
    if (tick(d, &why) != DONE) return;
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

static done_t add_damage(model_t *m, why_t *why) {
  const fx_t *const damage = fx_find("motor_damage");
  if (model_fx(m, damage)) return DONE;
  fx_use_t use = fx_use(damage);
  use.p[1] = 0.0; // the loss
  return model_add_fx(m, &use, why);
}

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
  d->was = d->params;
  d->finite = true;
  d->reset_asked = d->has_seen = false;
  push(d);
  weaken(d);
  return DONE;
}

static void switch_off(drone_t *d) {
  loop_close(d->loop);
  d->loop = NULL;
  firmware_close(&d->firmware);
}

// What a person does to it begins anew as well. The link stays up, as no vehicle's does.
static void begin(drone_t *d) {
  for (int i = 0; i < desk_param_count; i++)
    values_put(desk_param_rows[i].type, (char *)&d->params + desk_param_rows[i].offset, d->initial[i]);
}

static done_t restart(drone_t *d, why_t *why) {
  switch_off(d);
  begin(d);
  return switch_on(d, why);
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
  TRY(add_damage(&d->scene.setup.model, why));
  plan(d);
  for (int i = 0; i < desk_param_count; i++) d->initial[i] = desk_ranges[i].initial;
  d->initial[0] = fmin(d->scene.setup.model.ceiling_m, desk_ranges[0].max);
  for (int i = 0; i < desk_param_count; i++)
    if (strcmp(desk_param_rows[i].name, "battery") == 0) d->initial[i] = d->scene.battery;
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
  d->log = NULL; // nothing has flown
  drone_close(d);
  return status;
}

void drone_close(drone_t *d) {
  why_t why;
  (void)!write_rows(d, &why);
  record_free(&d->record);
  switch_off(d);
  storage_close(&d->storage);
}

// --- flown anew --------------------------------------------------------------------------------------------

#define LINE 256 // of 64 bytes in hex, and the time

// "MS HEX", or "MS"
static int read_packet(const char *text, uint32_t *ms, uint8_t bytes[64]) {
  int at, n = 0;
  unsigned byte;
  if (sscanf(text, "%u %n", ms, &at) != 1) return -1;
  for (; n < 64 && sscanf(text + at, "%2x", &byte) == 1; at += 2) bytes[n++] = (uint8_t)byte;
  return text[at] == '\n' || text[at] == '\0' ? n : -1;
}

done_t drone_replay(drone_t *d, FILE *commands, const char *path, double more_s, why_t *why) {
  char text[LINE];
  uint32_t ms = 0;
  uint8_t bytes[64];
  d->storage.path = NULL; // what is stored again is stored nowhere
  for (int line = 1; fgets(text, sizeof text, commands); line++) {
    if (text[0] == '#') {
      while (!strchr(text, '\n') && fgets(text, sizeof text, commands)) continue;
      continue;
    }
    const int n = read_packet(text, &ms, bytes);
    if (n < 0 || ms < drone_now_ms(d))
      return error_set(why, "%s:%d: allowed is `MS HEX`, or `MS`, in the order of time", path, line);
    while (drone_now_ms(d) < ms) TRY(drone_tick(d, why));
    if (n > 0)
      drone_take(d, bytes, n);
    else
      drone_left(d);
  }
  for (packet_t packet; drone_now_ms(d) < ms + (uint32_t)(1e3 * more_s);) {
    TRY(drone_tick(d, why));
    while (link_give(&d->link, &packet)) continue;
  }
  return DONE;
}
