// lanes_of.c - which numbers of a body go into its lane.
#include "body/lanes_of.h"

#define BATTERY      (offsetof(battery_param_t, n) / NUMBER)
#define FROM_NUMBERS (sizeof(sensed_from_t) / NUMBER)

const lanes_door_t *lanes_door(int bits) {
  return bits == 512 ? &lanes_door_512 : &lanes_door_256;
}

lanes_t *lanes_open(const lanes_door_t *door) {
  static const lanes_numbers_t numbers = {RIGID_NUMBERS + ROTORS, TOUCH_NUMBERS, PLANT_NUMBERS, LOOK_NUMBERS,
                                          BATTERY};
  return door->open(&numbers);
}

// --- effects ----------------------------------------------------------------------------------------------

static int at(const void *const *table, int n, const void *one) {
  for (int i = 0; i < n; i++)
    if (table[i] == one) return i;
  return -1;
}

static int at_fx(const fx_use_t *use) {
  return at((const void *const *)fx_table, fx_count, use->fx);
}
static int at_form(const fx_use_t *use) {
  return use->form ? at((const void *const *)curve_table, curve_count, use->form) : -1;
}

lanes_effect_t lanes_effect(const fx_use_t *use) {
  lanes_effect_t effect = {.fx = at_fx(use), .form = at_form(use)};
  for (int i = 0; i < FX_PARAM_MAX; i++) effect.p[i] = use->p[i];
  return effect;
}

bool lanes_know_effect(const fx_use_t *use) {
  return at_fx(use) >= 0 && (!use->form || (at_form(use) >= 0 && !use->form->needs_points));
}

// Effects at ticks do not count, because each body applies them itself (abreast.c).
bool lanes_know(const body_t *b) {
  for (int k = 0; k < b->n_excess; k++)
    if (!lanes_know_effect(b->excess[k])) return false;
  for (int k = 0; k < b->n_load; k++)
    if (!lanes_know_effect(b->load[k])) return false;
  for (int k = 0; k < b->model->n_fx; k++)
    if (b->model->fx[k].fx->sense && !lanes_know_effect(&b->model->fx[k])) return false;
  return true;
}

int lanes_senses(const model_t *m, const fx_use_t *sense[FX_MAX]) {
  int n = 0;
  for (int k = 0; k < m->n_fx; k++)
    if (m->fx[k].fx->sense) sense[n++] = &m->fx[k];
  return n;
}

lanes_alike_t lanes_alike(const body_t *b) {
  lanes_alike_t a = {.lag_in_speed = b->rigid.lag_in_speed,
                     .plain_lag = b->rigid.plain_lag,
                     .ticks = b->n_tick > 0,
                     .pushed = b->pushed,
                     .looked = b->look_is_y,
                     .loaded = b->look.loaded,
                     .excess_of = b->excess_of,
                     .n_excess = b->n_excess,
                     .n_load = b->n_load,
                     .n_open_V = b->model->battery.n,
                     .span_s = b->span_s};
  const fx_use_t *sense[FX_MAX];
  a.n_sense = lanes_senses(b->model, sense);
  for (int k = 0; k < a.n_sense; k++) a.sense[k] = at_fx(sense[k]);
  for (int k = 0; k < b->n_excess; k++) {
    a.excess[k] = at_fx(b->excess[k]);
    a.excess_form[k] = at_form(b->excess[k]);
  }
  for (int k = 0; k < b->n_load; k++) a.load[k] = at_fx(b->load[k]);
  return a;
}

// --- numbers to their lane and back -----------------------------------------------------------------------

void lanes_take_model(const lanes_at_t *to, int lane, const model_t *m) {
  const fx_use_t *sense[FX_MAX];
  const int n = lanes_senses(m, sense);
  for (int k = 0; k < n; k++) lanes_put(to->sense[k], sense[k]->p, EFFECT_NUMBERS, lane);
  lanes_put(to->battery, (const double *)&m->battery, BATTERY, lane);
  lanes_put(to->open_V, m->battery.open_V, BATTERY_TABLE_MAX, lane);
  const sensed_from_t from = body_sensed_from(m);
  lanes_put(to->sensed_from, (const double *)&from, FROM_NUMBERS, lane);
}

void lanes_take_effects(const lanes_at_t *to, int lane, const body_t *b) {
  for (int k = 0; k < b->n_excess; k++) lanes_put(to->excess[k], b->excess[k]->p, EFFECT_NUMBERS, lane);
  for (int k = 0; k < b->n_load; k++) lanes_put(to->load[k], b->load[k]->p, EFFECT_NUMBERS, lane);
}
