// state.c - what flies at the desk, as the page asks for it.
#include "desk/state.h"

#include "crazyflie/values.h"
#include "flight/guard.h"
#include <math.h>

static void add(cJSON *to, const char *name, double value) {
  if (isfinite(value))
    cJSON_AddNumberToObject(to, name, value);
  else
    cJSON_AddNullToObject(to, name);
}

static void add_all(cJSON *to, const char *name, const double *values, int n) {
  cJSON_AddItemToObject(to, name, cJSON_CreateDoubleArray(values, n));
}

static void add_reasons(cJSON *to, const char *name, unsigned bits) {
  cJSON *const list = cJSON_AddArrayToObject(to, name);
#define SAY(bit, reason, lasts, down, ends, gone, words)                                                     \
  if (bits & 1u << (bit)) cJSON_AddItemToArray(list, cJSON_CreateString(words));
  GUARD_REASONS(SAY)
#undef SAY
}

static void add_place(cJSON *to, const drone_t *d, double beside_m) {
  const body_t *const b = d->seen.body;
  const double *const y = b->y, pos_m[] = {y[RIGID_POS_M], y[RIGID_POS_M + 1] + beside_m, y[RIGID_POS_M + 2]};
  add_all(to, "pos_m", pos_m, 3);
  add_all(to, "q", y + RIGID_Q_WB, 4);
  cJSON *const rotors = cJSON_AddArrayToObject(to, "rotor_m");
  for (int i = 0; i < ROTORS; i++) {
    const double at_m[] = {b->rigid.rotor_x_m[i], b->rigid.rotor_y_m[i], b->rigid.rotor_z_m[i]};
    cJSON_AddItemToArray(rotors, cJSON_CreateDoubleArray(at_m, 3));
  }
  add(to, "radius_m", b->model->rotor_radius_m);
  add(to, "floor_m", pos_m[2] - touch_above_floor_m(&b->touch, d3_of(y + RIGID_POS_M)));
  add(to, "ceiling_m", b->touch.ceiling_m);
  add(to, "gap_m", body_gap_m(b));
  double ratio[ROTORS], motor[ROTORS];
  for (int i = 0; i < ROTORS; i++) {
    ratio[i] = body_thrust_ratio(b, i);
    motor[i] = d->firmware.vehicle.around.duty[i] / 65535.0;
  }
  add_all(to, "ratio", ratio, ROTORS);
  add_all(to, "motor", motor, ROTORS);
}

static void add_thoughts(cJSON *to, const drone_t *d) {
  const thoughts_t *const t = d->seen.thoughts;
  const setpoint_t *const set = &d->firmware.vehicle.setpoint;
  add(to, "height_m", d->seen.estimate->pos_w_m.z);
  add(to, "setpoint_m", set->mode.z == modeAbs ? (double)set->position.z : (double)NAN);
  add(to, "zc_m", t->zc_m);
  add_all(to, "weights", t->weights, CURVE_WEIGHTS);
  add_reasons(to, "guard_now", t->guard_now);
  add_reasons(to, "guard_latched", t->guard_latched);
}

static const char *who_flies(const firmware_t *f) {
  if (f->params.stabilizer_controller == CONTROLLER_PID) return "stock PID";
  if (f->params.stabilizer_controller == CONTROLLER_INDI) return "stock INDI";
  return f->vehicle.app.shadow ? "stock PID (ceil.shadow 1)" : "app";
}

static void add_desk(cJSON *to, const drone_t *d) {
  cJSON *const list = cJSON_AddArrayToObject(to, "desk");
  for (int i = 0; i < desk_param_count; i++) {
    const stock_row_t *const row = &desk_param_rows[i];
    const desk_range_t *const range = &desk_ranges[i];
    cJSON *const one = cJSON_CreateObject();
    cJSON_AddStringToObject(one, "name", row->name);
    add(one, "value", values_of_param(row->type, (const char *)&d->params + row->offset));
    add(one, "min", range->min);
    add(one, "max", range->max);
    cJSON_AddStringToObject(one, "unit", range->unit);
    cJSON_AddStringToObject(one, "what", range->what);
    cJSON_AddStringToObject(one, "kind", range->is_switch ? "switch" : "number");
    cJSON_AddItemToArray(list, one);
  }
}

static void add_link(cJSON *to, const link_t *link, const datagrams_t *radio) {
  add(to, "clients", radio->has_client);
  add(to, "packets_in", link->in);
  add(to, "packets_out", link->out);
  add(to, "lost", radio->lost);
  add(to, "no_room", link->lost);
  add(to, "dropped", link->dropped);
  add(to, "strays", radio->dropped);
}

cJSON *state_of(const drone_t *d, const seen_as_t *as) {
  cJSON *const to = cJSON_CreateObject();
  if (!to) return NULL;
  cJSON_AddStringToObject(to, "uri", as->uri);
  if (d->has_seen) {
    add_place(to, d, as->beside_m);
    add_thoughts(to, d);
  }
  cJSON_AddStringToObject(to, "state", supervised_words(d->firmware.vehicle.supervised.state));
  cJSON_AddStringToObject(to, "controller", who_flies(&d->firmware));
  add(to, "vbat_V", (double)d->firmware.vehicle.around.battery_V);
  add_link(to, &d->link, as->radio);
  add_desk(to, d);
  return to;
}
