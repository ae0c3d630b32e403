// verdict.c - verdict.json.
#include "gap/8_report/report.h"

#include "gap/5_infer/unknown.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void add_number(cJSON *o, const char *key, double v) {
  if (isfinite(v))
    cJSON_AddNumberToObject(o, key, v);
  else
    cJSON_AddNullToObject(o, key);
}

static void add_parameters(cJSON *effect, const finding_t *f) {
  cJSON *const all = cJSON_AddObjectToObject(effect, "parameters");
  int n;
  const fx_param_t *const param = fx_use_params(f->use, &n);
  for (int k = 0; k < f->fx->n_size; k++) {
    const fx_param_t *const p = &param[f->fx->size[k].param];
    cJSON *const one = cJSON_AddObjectToObject(all, p->name);
    add_number(one, "value", fx_use_size(f->use, k));
    add_number(one, "stderr", f->named->stderr_[k]);
    cJSON_AddStringToObject(one, "unit", p->unit);
  }
  if (!f->fx->n_shape) return;
  const fx_param_t *const p = &param[f->fx->shape_param];
  cJSON *const one = cJSON_AddObjectToObject(all, p->name);
  add_number(one, "value", f->use->p[f->fx->shape_param]);
  add_number(one, "stderr", f->named->shape_stderr > 0.0 ? f->named->shape_stderr : (double)NAN);
  cJSON_AddStringToObject(one, "unit", p->unit);
}

// Only where it was tried.
static void add_instrument(cJSON *o, const finding_t *f) {
  static const char *const answer[] = {"", "instrument too weak", "not confirmed", "confirmed"};
  const confirm_t *const a = &f->named->confirm;
  int n;
  const fx_param_t *const param = fx_use_params(f->use, &n);
  if (a->answer == CONFIRM_NOT_TRIED) return;
  const bool weak = a->answer == CONFIRM_WEAK;
  cJSON *const i = cJSON_AddObjectToObject(o, "instrument");
  cJSON_AddStringToObject(i, "answer", answer[a->answer]);
  add_number(i, "F", a->F);
  cJSON *const all = cJSON_AddObjectToObject(i, "parameters");
  for (int k = 0; k < f->fx->n_size && !weak; k++) {
    const fx_param_t *const p = &param[f->fx->size[k].param];
    cJSON *const one = cJSON_AddObjectToObject(all, p->name);
    add_number(one, "value", a->value[k]);
    add_number(one, "stderr", a->stderr_[k]);
    cJSON_AddStringToObject(one, "unit", p->unit);
  }
  add_number(i, "p", weak ? (double)NAN : p_value(a->p));
  add_number(i, "p_apart", weak ? (double)NAN : p_value(a->p_apart));
  cJSON_AddBoolToObject(i, "apart", a->apart);
}

static void add_effect(cJSON *list, const finding_t *f) {
  cJSON *const o = cJSON_CreateObject();
  cJSON_AddItemToArray(list, o);
  cJSON_AddStringToObject(o, "name", f->fx->name);
  add_parameters(o, f);
  add_number(o, "p", p_value(f->named->p));
  add_number(o, "share", f->named->share);
  cJSON *const rivals = cJSON_AddArrayToObject(o, "rivals");
  for (int i = 0; i < f->named->n_rival; i++)
    cJSON_AddItemToArray(rivals, cJSON_CreateString(f->named->rival[i]->name));
  cJSON *const where = cJSON_AddObjectToObject(o, "where");
  cJSON_AddStringToObject(where, "coordinate", coordinate_name(f->profile.coordinate));
  add_number(where, "from", f->where.from);
  add_number(where, "to", f->where.to);
  cJSON_AddStringToObject(where, "unit", coordinate_unit(f->profile.coordinate));
  cJSON *const matters = cJSON_AddObjectToObject(o, "matters");
  cJSON_AddStringToObject(matters, "channel", gap_channel[f->profile.channel]);
  cJSON_AddStringToObject(matters, "unit", gap_unit[f->profile.channel]);
  add_number(matters, "from", f->matters.from);
  add_number(matters, "to", f->matters.to);
  add_number(matters, "before", f->before);
  add_number(matters, "after", f->after);
  cJSON_AddStringToObject(o, "fly", f->fly);
  add_instrument(o, f);
}

static void add_unknown(cJSON *root, const diagnosis_t *d) {
  if (!d->unknown) {
    cJSON_AddNullToObject(root, "unknown");
    return;
  }
  cJSON *const o = cJSON_AddObjectToObject(root, "unknown");
  cJSON_AddStringToObject(o, "channel", gap_channel[d->cell.channel]);
  cJSON_AddStringToObject(o, "coordinate", d->cell.coordinate);
  add_number(o, "from", d->cell.from);
  add_number(o, "to", d->cell.to);
  add_number(o, "size", d->cell.size);
  // Of the size; from and to are in the coordinate's (m, m/s, V, N, rad/s or s).
  cJSON_AddStringToObject(o, "unit", gap_unit[d->cell.channel]);
}

static void add_gap(cJSON *root, const study_t *s) {
  cJSON *const list = cJSON_AddArrayToObject(root, "gap");
  const gap_flights_t *const held = s->by_time ? &s->fit : &s->held;
  for (int ch = 0; ch < CHANNELS; ch++) {
    const gap_part_t *const p = &s->diagnosis.held_out.channel[ch];
    if (!p->used) continue;
    cJSON *const o = cJSON_CreateObject();
    cJSON_AddItemToArray(list, o);
    cJSON_AddStringToObject(o, "channel", gap_channel[ch]);
    cJSON_AddStringToObject(o, "unit", gap_unit[ch]);
    add_number(o, "before", p->before);
    add_number(o, "after", p->after);
    add_number(o, "floor", s->diagnosis.nominal_flew ? p->floor : (double)NAN);
    cJSON *const names = cJSON_AddArrayToObject(o, "held_out");
    for (int i = 0; i < held->n; i++) cJSON_AddItemToArray(names, cJSON_CreateString(held->flight[i].name));
  }
}

static void add_untested(cJSON *root, const report_t *r) {
  cJSON *const list = cJSON_AddArrayToObject(root, "not_testable");
  for (int i = 0; i < r->n_untested; i++) {
    const untested_t *const u = &r->untested[i];
    if (!u->obstacle && u->testable) continue;
    char why[REPORT_TEXT];
    report_why(u, why);
    cJSON *const o = cJSON_CreateObject();
    cJSON_AddItemToArray(list, o);
    cJSON_AddStringToObject(o, "effect", u->fx->name);
    cJSON_AddStringToObject(o, "why", why);
    cJSON_AddStringToObject(o, "fly", u->fx->fly);
  }
}

// Which rows: of each log as they stand in it, and the samples that they became.
static void add_made(cJSON *root, const study_t *s) {
  double rows = 0.0;
  for (int i = 0; i < s->fit.n + s->held.n; i++) rows += (double)s->flight[i].rows;
  if (!s->order.made) return;
  made_add(root, s->order.made, (double)s->order.seed, rows);
  cJSON *const logs = cJSON_AddArrayToObject(cJSON_GetObjectItem(root, "made"), "logs");
  for (int i = 0; i < s->fit.n + s->held.n; i++) {
    cJSON *const o = cJSON_CreateObject();
    cJSON_AddItemToArray(logs, o);
    cJSON_AddStringToObject(o, "file", s->flight[i].name);
    cJSON_AddNumberToObject(o, "rows", (double)s->flight[i].rows);
    cJSON_AddNumberToObject(o, "samples", s->flight[i].n);
    cJSON_AddBoolToObject(o, "held_out", i >= s->fit.n);
  }
}

cJSON *report_verdict(const report_t *r) {
  const study_t *const s = r->study;
  cJSON *const root = cJSON_CreateObject();
  if (!root) return NULL;
  cJSON_AddStringToObject(root, "verdict", r->verdict);
  cJSON *const effects = cJSON_AddArrayToObject(root, "effects");
  for (int i = 0; i < r->n_finding; i++) add_effect(effects, &r->finding[i]);
  add_unknown(root, &s->diagnosis);
  add_gap(root, s);
  if (s->resimulation.flew) {
    cJSON *const o = cJSON_AddObjectToObject(root, "resimulation");
    cJSON_AddStringToObject(o, "unit", "m");
    add_number(o, "before", s->resimulation.before_m);
    add_number(o, "after", s->resimulation.after_m);
    add_number(o, "height_before", s->resimulation.before_height_m);
    add_number(o, "height_after", s->resimulation.after_height_m);
  } else
    cJSON_AddNullToObject(root, "resimulation");
  add_untested(root, r);
  cJSON *const warnings = cJSON_AddArrayToObject(root, "warnings");
  for (int i = 0; i < r->n_warning; i++) cJSON_AddItemToArray(warnings, cJSON_CreateString(r->warning[i]));
  add_made(root, s);
  return root;
}

cJSON *report_refused(const char *line, const study_order_t *order) {
  cJSON *const root = cJSON_CreateObject();
  if (!root) return NULL;
  cJSON_AddStringToObject(root, "verdict", "refused");
  cJSON_AddArrayToObject(root, "effects");
  cJSON_AddNullToObject(root, "unknown");
  cJSON_AddArrayToObject(root, "gap");
  cJSON_AddNullToObject(root, "resimulation");
  cJSON_AddArrayToObject(root, "not_testable");
  cJSON *const warnings = cJSON_AddArrayToObject(root, "warnings");
  cJSON_AddItemToArray(warnings, cJSON_CreateString(line));
  if (order->made) made_add(root, order->made, (double)order->seed, (double)NAN);
  return root;
}

done_t report_write_json(const cJSON *json, FILE *out, why_t *why) {
  char *const text = json ? cJSON_Print(json) : NULL;
  if (!text) return error_failed(why, "out of memory");
  fprintf(out, "%s\n", text);
  free(text);
  return DONE;
}
