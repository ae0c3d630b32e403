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

// A number that was chosen among a few, and has no error.
static void add_kind(cJSON *all, const finding_t *f) {
  int n;
  const fx_param_t *const p = &fx_use_params(f->use, &n)[fx_use_kind(f->use)];
  cJSON *const one = cJSON_AddObjectToObject(all, p->name);
  add_number(one, "value", f->use->p[fx_use_kind(f->use)]);
  add_number(one, "stderr", (double)NAN);
  cJSON_AddStringToObject(one, "unit", p->unit);
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
    if (f->in_file) add_number(one, "in_file", fx_use_size(f->in_file, k));
    cJSON_AddStringToObject(one, "unit", p->unit);
  }
  if (f->fx->n_kind) add_kind(all, f);
  if (!fx_use_has_shape(f->use)) return;
  const fx_param_t *const p = &param[f->fx->shape_param];
  cJSON *const one = cJSON_AddObjectToObject(all, p->name);
  add_number(one, "value", f->use->p[f->fx->shape_param]);
  add_number(one, "stderr", f->named->shape_stderr > 0.0 ? f->named->shape_stderr : (double)NAN);
  cJSON_AddStringToObject(one, "unit", p->unit);
}

// Only where it was tried.
static void add_instrument(cJSON *o, const finding_t *f) {
  const confirm_t *const a = &f->named->confirm;
  int n;
  const fx_param_t *const param = fx_use_params(f->use, &n);
  if (a->answer == CONFIRM_NOT_TRIED) return;
  const bool weak = a->answer == CONFIRM_WEAK;
  cJSON *const i = cJSON_AddObjectToObject(o, "instrument");
  cJSON_AddStringToObject(i, "answer", report_feedback[a->answer]);
  add_number(i, "F", a->F);
  cJSON *const all = cJSON_AddObjectToObject(i, "parameters");
  for (int k = 0; k < f->fx->n_size && !weak; k++) {
    const fx_param_t *const p = &param[f->fx->size[k].param];
    cJSON *const one = cJSON_AddObjectToObject(all, p->name);
    add_number(one, "value", a->value[k] + (f->in_file ? fx_use_size(f->in_file, k) : 0.0));
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
  add_number(o, "probability", f->named->probability);
  cJSON_AddStringToObject(o, "standing", standing_name[f->standing]);
  cJSON_AddStringToObject(o, "says", f->says);
  add_number(o, "share", f->named->share);
  cJSON *const family = cJSON_AddArrayToObject(o, "family");
  cJSON_AddItemToArray(family, cJSON_CreateString(f->fx->name));
  for (int i = 0; i < f->named->n_rival; i++)
    cJSON_AddItemToArray(family, cJSON_CreateString(f->named->rival[i]->name));
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

static void add_place(cJSON *o, const cell_t *c) {
  cJSON_AddStringToObject(o, "channel", gap_channel[c->channel]);
  cJSON_AddStringToObject(o, "axes", c->world ? "world" : "body");
  cJSON_AddStringToObject(o, "coordinate", c->coordinate);
  add_number(o, "from", c->from);
  add_number(o, "to", c->to);
  if (!c->is_patch) return;
  add_number(o, "y_from", c->y_from_m);
  add_number(o, "y_to", c->y_to_m);
}

static void add_unknown(cJSON *root, const diagnosis_t *d) {
  if (!d->unknown) {
    cJSON_AddNullToObject(root, "unknown");
    return;
  }
  cJSON *const o = cJSON_AddObjectToObject(root, "unknown");
  add_place(o, &d->left.cell);
  add_number(o, "size", d->left.cell.size);
  add_number(o, "stderr", fabs(d->left.cell.size) / d->left.cell.statistic);
  if (d->left.also.statistic > 0.0) {
    cJSON *const also = cJSON_AddObjectToObject(o, "also"); // explains as much but for a fifth
    add_place(also, &d->left.also);
  }
  // Of the size; from and to are in the coordinate's (m, m/s, V, N, rad/s, s or Hz).
  cJSON_AddStringToObject(o, "unit", gap_unit[d->left.cell.channel]);
}

static void add_gap(cJSON *root, const report_t *r) {
  const study_t *const s = r->study;
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
    cJSON_AddStringToObject(o, "adequacy", left_name[report_adequacy(r, ch)]);
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

// What was looked for in vain: the smallest size that these flights would have shown.
static void add_would_show(cJSON *root, const report_t *r) {
  cJSON *const list = cJSON_AddArrayToObject(root, "would_show");
  for (int i = 0; i < r->n_untested; i++) {
    const untested_t *const u = &r->untested[i];
    if (u->obstacle || !u->testable) continue;
    cJSON *const o = cJSON_CreateObject();
    cJSON_AddItemToArray(list, o);
    cJSON_AddStringToObject(o, "effect", u->fx->name);
    cJSON_AddStringToObject(o, "parameter", u->param->name);
    add_number(o, "from", u->seen_from);
    cJSON_AddStringToObject(o, "unit", u->param->unit);
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
    add_number(o, "rate_Hz", s->flight[i].rate_Hz);
    cJSON_AddBoolToObject(o, "held_out", i >= s->fit.n);
  }
}

// What the vehicle file has: these effects were not looked for, their numbers were believed.
static void add_in_model(cJSON *root, const model_t *m) {
  cJSON *const list = cJSON_AddArrayToObject(root, "already_in_model");
  for (int i = 0; i < m->n_fx; i++) {
    cJSON *const o = cJSON_CreateObject();
    cJSON_AddItemToArray(list, o);
    cJSON_AddStringToObject(o, "name", m->fx[i].fx->name);
    cJSON *const all = cJSON_AddObjectToObject(o, "parameters");
    int n;
    const fx_param_t *const param = fx_use_params(&m->fx[i], &n);
    for (int k = 0; k < n; k++) add_number(all, param[k].name, m->fx[i].p[k]);
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
  add_gap(root, r);
  cJSON_AddStringToObject(root, "adequacy", left_name[report_adequacy_of_all(r)]);
  add_in_model(root, &s->vehicle);
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
  add_would_show(root, r);
  cJSON *const to_do = cJSON_AddArrayToObject(root, "to_do");
  for (int i = 0; i < REPORT_ADVICE; i++) cJSON_AddItemToArray(to_do, cJSON_CreateString(r->advice[i]));
  cJSON_AddNullToObject(root, "refused");
  cJSON *const warnings = cJSON_AddArrayToObject(root, "warnings");
  for (int i = 0; i < r->n_warning; i++) cJSON_AddItemToArray(warnings, cJSON_CreateString(r->warning[i]));
  add_made(root, s);
  return root;
}

// Which of the order's files a message begins with, maybe behind an option; null: none.
static const char *file_of(const char *text, const study_order_t *o) {
  const char *best = NULL;
  for (int i = -2; i < o->n_log + o->n_hold_out; i++) {
    const char *const path = i == -2        ? o->vehicle
                             : i == -1      ? o->columns
                             : i < o->n_log ? o->log[i]
                                            : o->hold_out[i - o->n_log];
    const char *const from = strncmp(text, "--hold-out ", 11) == 0 ? text + 11 : text;
    if (path && strncmp(from, path, strlen(path)) == 0 && from[strlen(path)] == ':' &&
        (!best || strlen(path) > strlen(best)))
      best = path;
  }
  return best;
}

// "flight.csv:812: column acc.z: not a number": the file, the line and the column that the message has.
static void add_refused(cJSON *root, const char *text, const study_order_t *order) {
  cJSON *const o = cJSON_AddObjectToObject(root, "refused");
  const char *const file = file_of(text, order), *const column = strstr(text, "column ");
  const char *const behind = file ? strstr(text, file) + strlen(file) + 1 : text;
  char name[80] = "", *end = NULL;
  const double line = file ? strtod(behind, &end) : (double)NAN;
  const bool has_line = end && end > behind && *end == ':';
  if (column) snprintf(name, sizeof name, "%.*s", (int)strcspn(column + 7, " :,;"), column + 7);
  cJSON_AddItemToObject(o, "file", file ? cJSON_CreateString(file) : cJSON_CreateNull());
  add_number(o, "line", has_line ? line : (double)NAN);
  cJSON_AddItemToObject(o, "column", column ? cJSON_CreateString(name) : cJSON_CreateNull());
}

cJSON *report_refused(const char *line, const study_order_t *order) {
  cJSON *const root = cJSON_CreateObject();
  if (!root) return NULL;
  cJSON_AddStringToObject(root, "verdict", "refused");
  cJSON_AddArrayToObject(root, "effects");
  cJSON_AddNullToObject(root, "unknown");
  cJSON_AddArrayToObject(root, "gap");
  cJSON_AddNullToObject(root, "resimulation");
  cJSON_AddStringToObject(root, "adequacy", left_name[LEFT_UNKNOWN]);
  cJSON_AddArrayToObject(root, "already_in_model");
  cJSON_AddArrayToObject(root, "not_testable");
  cJSON_AddArrayToObject(root, "would_show");
  cJSON_AddArrayToObject(root, "to_do");
  add_refused(root, line, order);
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
