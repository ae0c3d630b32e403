// verdict.c - verdict.json. A number that is not finite becomes null.
#include "gap/8_report/report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// A key and its value: the text, or the number if text is null.
typedef struct {
  const char *key, *text;
  double number;
} field_t;

#define add(o, ...) add_fields(o, (const field_t[]){__VA_ARGS__, {.key = NULL}})

static void add_fields(cJSON *o, const field_t *p) {
  for (; p->key; p++)
    cJSON_AddItemToObject(o, p->key, p->text ? cJSON_CreateString(p->text) : cJSON_CreateNumber(p->number));
}

static cJSON *add_object(cJSON *list) {
  cJSON *const o = cJSON_CreateObject();
  cJSON_AddItemToArray(list, o);
  return o;
}

static void add_text(cJSON *list, const char *text) {
  cJSON_AddItemToArray(list, cJSON_CreateString(text));
}

static void add_notes(cJSON *root, const char *key, const notes_t *notes) {
  cJSON *const list = cJSON_AddArrayToObject(root, key);
  for (int i = 0; i < notes->n; i++) add_text(list, notes->line[i]);
}

// --- effects ----------------------------------------------------------------------------------------------

static cJSON *add_number(cJSON *all, const fx_param_t *param, double value, double error) {
  cJSON *const o = cJSON_AddObjectToObject(all, param->name);
  add(o, {.key = "value", .number = value}, {.key = "stderr", .number = error});
  return o;
}

static void add_parameters(cJSON *effect, const finding_t *f) {
  cJSON *const all = cJSON_AddObjectToObject(effect, "parameters");
  for (int k = 0; k < f->n_number; k++) {
    const number_t *const n = &f->number[k];
    cJSON *const o = add_number(all, n->param, n->value, n->stderr_);
    if (isfinite(n->in_file)) cJSON_AddNumberToObject(o, "in_file", n->in_file);
    cJSON_AddStringToObject(o, "unit", n->param->unit);
  }
}

// Adds what the set points as instrument say, if they were tried.
static void add_instrument(cJSON *effect, const finding_t *f) {
  const confirm_t *const a = &f->named->confirm;
  if (a->answer == CONFIRM_NOT_TRIED) return;
  const bool weak = a->answer == CONFIRM_WEAK;
  cJSON *const o = cJSON_AddObjectToObject(effect, "instrument");
  add(o, {.key = "answer", .text = report_feedback[a->answer]}, {.key = "F", .number = a->F});
  cJSON *const all = cJSON_AddObjectToObject(o, "parameters");
  for (int k = f->from; k < f->to && !weak; k++) {
    const number_t *const n = &f->number[k - f->from];
    cJSON_AddStringToObject(add_number(all, n->param, n->by_instrument, a->stderr_[k]), "unit",
                            n->param->unit);
  }
  add(o, {.key = "p", .number = weak ? (double)NAN : p_value(a->p)},
      {.key = "p_apart", .number = weak ? (double)NAN : p_value(a->p_apart)});
  cJSON_AddBoolToObject(o, "apart", a->apart);
}

static void add_effect(cJSON *list, const finding_t *f) {
  const int channel = f->profile.channel, coordinate = f->profile.coordinate;
  cJSON *const o = add_object(list);
  cJSON_AddStringToObject(o, "name", f->fx->name);
  cJSON_AddStringToObject(o, "law", f->fx->law);
  if (f->use->form) cJSON_AddStringToObject(o, "form", f->use->form->brief);
  add_parameters(o, f);
  add(o, {.key = "p", .number = p_value(f->named->p)},
      {.key = "probability", .number = report_probability(f)},
      {.key = "standing", .text = standing_name[f->standing]}, {.key = "says", .text = f->says},
      {.key = "share", .number = f->named->share});
  cJSON *const family = cJSON_AddArrayToObject(o, "family");
  cJSON *const rivals = cJSON_AddArrayToObject(o, "rivals");
  add_text(family, f->fx->name);
  for (int i = 0; i < f->named->n_rival; i++) {
    add_text(family, f->named->rival[i]->name);
    add_text(rivals, f->named->rival[i]->name);
  }
  cJSON *const where = cJSON_AddObjectToObject(o, "where");
  add(where, {.key = "coordinate", .text = coordinate_name(coordinate)},
      {.key = "from", .number = f->where.from}, {.key = "to", .number = f->where.to},
      {.key = "unit", .text = coordinate_unit(coordinate)});
  cJSON *const matters = cJSON_AddObjectToObject(o, "matters");
  add(matters, {.key = "channel", .text = gap_channel[channel]}, {.key = "unit", .text = gap_unit[channel]},
      {.key = "from", .number = f->matters.from}, {.key = "to", .number = f->matters.to},
      {.key = "before", .number = f->before}, {.key = "after", .number = f->after});
  cJSON_AddStringToObject(o, "fly", f->fly);
  add_instrument(o, f);
}

// --- what has no name, what is left, what could not be seen -----------------------------------------------

static void add_place(cJSON *o, const cell_t *c) {
  add(o, {.key = "channel", .text = gap_channel[c->channel]},
      {.key = "axes", .text = c->world ? "world" : "body"}, {.key = "coordinate", .text = c->coordinate},
      {.key = "from", .number = c->from}, {.key = "to", .number = c->to});
  if (c->is_pulse) add(o, {.key = "log", .text = c->log->name});
  if (!c->is_patch) return;
  add(o, {.key = "y_from", .number = c->y_from_m}, {.key = "y_to", .number = c->y_to_m});
}

static void add_form(cJSON *o, const fx_use_t *use) {
  if (use->form) cJSON_AddStringToObject(o, "form", use->form->name);
}

// Adds the effects that would explain the residual from from_s to to_s, or (outside) at all other times.
static void add_acts_as(cJSON *o, const for_a_time_t *f) {
  cJSON *const list = cJSON_AddArrayToObject(o, "acts_as");
  for (int i = 0; i < f->as.n; i++) {
    const would_do_t *const one = &f->as.would[i];
    cJSON *const would = add_object(list);
    int n;
    const fx_param_t *const param = fx_use_params(&one->use, &n);
    cJSON_AddStringToObject(would, "name", one->use.fx->name);
    add_form(would, &one->use);
    cJSON *const all = cJSON_AddObjectToObject(would, "parameters");
    for (int k = 0; k < n; k++) cJSON_AddNumberToObject(all, param[k].name, one->use.p[k]);
    cJSON_AddBoolToObject(would, "outside", f->outside);
    add(would, {.key = "from_s", .number = f->from_s}, {.key = "to_s", .number = f->to_s},
        {.key = "share", .number = one->share});
  }
}

static void add_sizes(cJSON *list, const fx_use_t *use) {
  cJSON *const all = add_object(list);
  int n;
  const fx_param_t *const param = fx_use_params(use, &n);
  for (int k = 0; k < n; k++) cJSON_AddNumberToObject(all, param[k].name, use->p[k]);
}

// Adds each group of channels in which flights differ.
static void add_differ(cJSON *o, const report_t *r) {
  cJSON *const list = cJSON_AddArrayToObject(o, "from_flight_to_flight");
  for (int g = 0; g < GROUPS; g++) {
    const flights_differ_t *const d = &r->study->diagnosis.differ[g];
    if (!d->n) continue;
    cJSON *const group = add_object(list);
    add(group, {.key = "channel", .text = gap_channel[d->cell.channel]},
        {.key = "unit", .text = gap_unit[d->cell.channel]});
    cJSON *const flights = cJSON_AddArrayToObject(group, "flights");
    for (int f = 0; f < d->n; f++)
      add(add_object(flights), {.key = "log", .text = r->study->fit.flight[f].name},
          {.key = "mean", .number = d->error[f] > 0.0 ? d->mean[f] : (double)NAN},
          {.key = "stderr", .number = d->error[f] > 0.0 ? d->error[f] : (double)NAN});
    cJSON *const acts_as = cJSON_AddArrayToObject(group, "acts_as");
    for (int i = 0; i < d->as.n; i++) {
      cJSON *const would = add_object(acts_as);
      cJSON_AddStringToObject(would, "name", d->as.would[i].use.fx->name);
      add_form(would, &d->as.would[i].use);
      cJSON *const sizes = cJSON_AddArrayToObject(would, "parameters");
      for (int f = 0; f < d->n; f++) add_sizes(sizes, &d->use[i * d->n + f]);
      add(would, {.key = "share", .number = d->as.would[i].share});
    }
  }
}

static void add_unknown(cJSON *root, const report_t *r) {
  const diagnosis_t *const d = &r->study->diagnosis;
  if (!d->unknown) {
    cJSON_AddNullToObject(root, "unknown");
    return;
  }
  const cell_t *const c = &d->left.cell;
  cJSON *const o = cJSON_AddObjectToObject(root, "unknown");
  add_place(o, c);
  add(o, {.key = "size", .number = c->size}, {.key = "stderr", .number = cell_error(c)});
  if (d->left.also.statistic > 0.0) add_place(cJSON_AddObjectToObject(o, "also"), &d->left.also);
  add_acts_as(o, &d->for_a_time);
  add_differ(o, r);
  // The unit of the size; from and to are in the coordinate's (m, m/s, V, N, rad/s, s or Hz).
  cJSON_AddStringToObject(o, "unit", gap_unit[c->channel]);
}

static void add_gap(cJSON *root, const report_t *r) {
  const study_t *const s = r->study;
  cJSON *const list = cJSON_AddArrayToObject(root, "gap");
  const gap_flights_t *const held = s->by_time ? &s->fit : &s->held;
  for (int ch = 0; ch < CHANNELS; ch++) {
    const gap_part_t *const p = &s->diagnosis.held_out.channel[ch];
    if (!p->used) continue;
    cJSON *const o = add_object(list);
    add(o, {.key = "channel", .text = gap_channel[ch]}, {.key = "unit", .text = gap_unit[ch]},
        {.key = "before", .number = p->before}, {.key = "after", .number = p->after},
        {.key = "floor", .number = s->diagnosis.nominal_flew ? p->floor : (double)NAN},
        {.key = "adequacy", .text = left_name[report_adequacy(r, ch)]});
    cJSON *const names = cJSON_AddArrayToObject(o, "held_out");
    for (int i = 0; i < held->n; i++) add_text(names, held->flight[i].name);
  }
}

static void add_resimulation(cJSON *root, const resimulation_t *a) {
  if (!a->flew) {
    cJSON_AddNullToObject(root, "resimulation");
    return;
  }
  cJSON *const o = cJSON_AddObjectToObject(root, "resimulation");
  add(o, {.key = "unit", .text = "m"}, {.key = "before", .number = a->before.rms_m},
      {.key = "after", .number = a->after.rms_m}, {.key = "height_before", .number = a->before.height_m},
      {.key = "height_after", .number = a->after.height_m});
}

static void add_others(cJSON *root, const report_t *r) {
  cJSON *const untested = cJSON_AddArrayToObject(root, "not_testable");
  for (int i = 0; i < r->n_untested; i++) {
    cJSON *const o = add_object(untested);
    add(o, {.key = "effect", .text = r->untested[i].fx->name}, {.key = "why", .text = r->untested[i].why},
        {.key = "fly", .text = r->untested[i].fx->fly});
  }
  cJSON *const shown = cJSON_AddArrayToObject(root, "would_show");
  for (int i = 0; i < r->n_shown; i++) {
    cJSON *const o = add_object(shown);
    add(o, {.key = "effect", .text = r->shown[i].fx->name},
        {.key = "parameter", .text = r->shown[i].param->name}, {.key = "from", .number = r->shown[i].from},
        {.key = "unit", .text = r->shown[i].param->unit});
  }
}

// Adds how the verdict was made, and of each log the number of its rows and of the samples made of them.
static void add_made(cJSON *root, const study_t *s) {
  double rows = 0.0;
  for (int i = 0; i < s->fit.n + s->held.n; i++) rows += (double)s->flight[i].rows;
  if (!s->order.made) return;
  made_add(root, s->order.made, (double)s->order.seed, rows);
  cJSON *const logs = cJSON_AddArrayToObject(cJSON_GetObjectItem(root, "made"), "logs");
  for (int i = 0; i < s->fit.n + s->held.n; i++) {
    cJSON *const o = add_object(logs);
    add(o, {.key = "file", .text = s->flight[i].name}, {.key = "rows", .number = (double)s->flight[i].rows},
        {.key = "samples", .number = s->flight[i].n}, {.key = "rate_Hz", .number = s->flight[i].rate_Hz});
    cJSON_AddBoolToObject(o, "held_out", i >= s->fit.n);
  }
}

// Adds the effects of the vehicle file with the file's numbers.
static void add_in_model(cJSON *root, const model_t *m) {
  cJSON *const list = cJSON_AddArrayToObject(root, "already_in_model");
  for (int i = 0; i < m->n_fx; i++) {
    cJSON *const o = add_object(list);
    cJSON_AddStringToObject(o, "name", m->fx[i].fx->name);
    cJSON *const all = cJSON_AddObjectToObject(o, "parameters");
    int n;
    const fx_param_t *const param = fx_use_params(&m->fx[i], &n);
    for (int k = 0; k < n; k++) cJSON_AddNumberToObject(all, param[k].name, m->fx[i].p[k]);
  }
}

cJSON *report_verdict(const report_t *r) {
  const study_t *const s = r->study;
  cJSON *const root = cJSON_CreateObject();
  if (!root) return NULL;
  cJSON_AddStringToObject(root, "verdict", r->verdict);
  cJSON *const effects = cJSON_AddArrayToObject(root, "effects");
  for (int i = 0; i < r->n_finding; i++) add_effect(effects, &r->finding[i]);
  add_unknown(root, r);
  add_gap(root, r);
  cJSON_AddStringToObject(root, "adequacy", left_name[report_adequacy_of_all(r)]);
  add_in_model(root, &s->vehicle);
  add_resimulation(root, &s->resimulation);
  add_others(root, r);
  add_notes(root, "to_do", &r->to_do);
  cJSON_AddNullToObject(root, "refused");
  add_notes(root, "warnings", &r->warnings);
  add_made(root, s);
  return root;
}

// --- refused ----------------------------------------------------------------------------------------------

// Returns the file of the order that a message begins with, possibly after `--hold-out `; null: none.
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

// Adds the file, line and column of a message such as "flight.csv:812: column acc.z: not a number".
static void add_refused(cJSON *root, const char *text, const study_order_t *order) {
  cJSON *const o = cJSON_AddObjectToObject(root, "refused");
  const char *const file = file_of(text, order), *const column = strstr(text, "column ");
  const char *const behind = file ? strstr(text, file) + strlen(file) + 1 : text;
  char name[80] = "", *end = NULL;
  const double line = file ? strtod(behind, &end) : (double)NAN;
  const bool has_line = end && end > behind && *end == ':';
  if (column) snprintf(name, sizeof name, "%.*s", (int)strcspn(column + 7, " :,;"), column + 7);
  cJSON_AddItemToObject(o, "file", file ? cJSON_CreateString(file) : cJSON_CreateNull());
  cJSON_AddNumberToObject(o, "line", has_line ? line : (double)NAN);
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
  add_text(cJSON_AddArrayToObject(root, "warnings"), line);
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
