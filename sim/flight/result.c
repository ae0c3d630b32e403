// result.c - what a scenario found.
#include "flight/result.h"

#include "base/constants.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

done_t result_init(result_t *r, why_t *why) {
  *r = (result_t){.json = cJSON_CreateObject()};
  if (!r->json) return error_failed(why, "out of memory");
  cJSON_AddArrayToObject(r->json, "segments");
  cJSON_AddNumberToObject(r->json, "contacts", 0.0);
  cJSON_AddBoolToObject(r->json, "finite", true);
  cJSON_AddNumberToObject(r->json, "realtime_factor", 0.0);
  return DONE;
}

void result_free(result_t *r) {
  cJSON_Delete(r->json);
  record_free(&r->record);
}

// Returns the segment as JSON; NaN becomes null.
static cJSON *segment_of(const segment_t *s, bool tilts) {
  cJSON *o = cJSON_CreateObject();
  if (s->label[0]) cJSON_AddStringToObject(o, "label", s->label);
  cJSON_AddNumberToObject(o, "setpoint_m", s->setpoint_m);
  cJSON_AddNumberToObject(o, "overshoot_mm", s->overshoot_mm);
  cJSON_AddNumberToObject(o, "peaks", s->peaks);
  cJSON_AddNumberToObject(o, "t90_s", s->t90_s);
  cJSON_AddNumberToObject(o, "settle_1mm_s", s->settle_1mm_s);
  cJSON_AddNumberToObject(o, "mean_error_mm", s->mean_error_mm);
  cJSON_AddNumberToObject(o, "sd_mm", s->sd_mm);
  cJSON_AddNumberToObject(o, "rms_mm", s->rms_mm);
  cJSON_AddNumberToObject(o, "min_gap_mm", s->min_gap_mm);
  cJSON_AddNumberToObject(o, "contacts", s->contacts);
  if (tilts) cJSON_AddNumberToObject(o, "tilt_max_deg", DEG_PER_RAD * s->tilt_max_rad);
  return o;
}

static double number(const cJSON *o, const char *key) {
  const cJSON *item = cJSON_GetObjectItem(o, key);
  return cJSON_IsNumber(item) ? item->valuedouble : (double)NAN;
}

static void replace_number(cJSON *o, const char *key, double value) {
  cJSON_ReplaceItemInObject(o, key, cJSON_CreateNumber(value));
}

// Adds to "set" the parameters that differ from what ships; over several flights, those of all of them.
static void add_set(cJSON *json, const flown_t *flown) {
  const float *const flew = flown->record.param;
  if (!flew) return; // another controller flew
  cJSON *set = cJSON_GetObjectItem(json, "set");
  if (!set) set = cJSON_AddObjectToObject(json, "set");
  for (int i = 0; i < params_count; i++) {
    const param_row_t *const row = &params_table[i];
    if (flew[i] == params_get(&flown->shipped, row)) continue;
    cJSON_DeleteItemFromObject(set, row->name);
    char text[32]; // the shortest decimal number that is this float: what a person would type
    for (int digits = 6; digits <= 9; digits++) {
      snprintf(text, sizeof text, "%.*g", digits, (double)flew[i]);
      if (strtof(text, NULL) == flew[i]) break;
    }
    cJSON_AddRawToObject(set, row->name, text);
  }
}

static void add_totals(result_t *r, flown_t *flown, int contacts) {
  add_set(r->json, flown);
  replace_number(r->json, "contacts", number(r->json, "contacts") + contacts);
  replace_number(r->json, "realtime_factor", flown->outcome.realtime_factor);
  if (!flown->outcome.finite) cJSON_ReplaceItemInObject(r->json, "finite", cJSON_CreateFalse());
  record_free(&r->record);
  r->record = flown->record;
  flown->record = (record_t){0};
}

// Adds the flight's random deviations, if there are any, in place of an earlier flight's.
static void add_drawn(cJSON *json, const drawn_t *drawn) {
  cJSON_DeleteItemFromObject(json, "drawn");
  cJSON *const all = cJSON_CreateObject();
  bool any = false;
  for (int i = 0; i < drawn_field_count; i++) {
    const double value = drawn_get(drawn, &drawn_fields[i]);
    any = any || (value != 0.0 && !drawn_fields[i].which);
    cJSON_AddNumberToObject(all, drawn_fields[i].name, value);
  }
  if (any)
    cJSON_AddItemToObject(json, "drawn", all);
  else
    cJSON_Delete(all);
}

void result_add_flight(result_t *r, flown_t *flown) {
  cJSON *segments = cJSON_GetObjectItem(r->json, "segments");
  for (int i = 0; i < flown->n_segment; i++)
    cJSON_AddItemToArray(segments, segment_of(&flown->segment[i], !flown->plan.vertical_only));
  if (!flown->plan.vertical_only) add_drawn(r->json, &flown->outcome.drawn);
  add_totals(r, flown, flown->outcome.contacts);
}

void result_add_weights(result_t *r, const rbf_weights_t *weights) {
  double w[RBF_N];
  for (int i = 0; i < RBF_N; i++) w[i] = (double)weights->w[i];
  cJSON_AddItemToObject(r->json, "weights", cJSON_CreateDoubleArray(w, RBF_N));
  for (int i = 0; i < RBF_N; i++) {
    cJSON *row = result_add_row(r, "learned");
    char name[24];
    snprintf(name, sizeof name, "ceil.w%d", i + 1);
    cJSON_AddStringToObject(row, "parameter", name);
    cJSON_AddNumberToObject(row, "value", w[i]);
  }
}

void result_add_segment(result_t *r, flown_t *flown, int segment, const char *label) {
  segment_t *s = &flown->segment[segment];
  snprintf(s->label, sizeof s->label, "%s", label);
  cJSON_AddItemToArray(cJSON_GetObjectItem(r->json, "segments"), segment_of(s, false));
  add_totals(r, flown, s->contacts);
}

cJSON *result_add_row(result_t *r, const char *table) {
  cJSON *rows = cJSON_GetObjectItem(r->json, table);
  if (!rows) rows = cJSON_AddArrayToObject(r->json, table);
  cJSON *row = cJSON_CreateObject();
  cJSON_AddItemToArray(rows, row);
  return row;
}

// --- as text ------------------------------------------------------------------------------------------

static void cell_text(const cJSON *cell, char *text, size_t size) {
  if (cJSON_IsString(cell))
    snprintf(text, size, "%s", cell->valuestring);
  else if (cJSON_IsNumber(cell) && isfinite(cell->valuedouble))
    snprintf(text, size, "%.4g", cell->valuedouble);
  else
    snprintf(text, size, "-");
}

// Returns the width of the key and every cell of that column.
static int column_width(const cJSON *rows, const char *key) {
  size_t width = strlen(key);
  const cJSON *row;
  cJSON_ArrayForEach(row, rows) {
    char text[64];
    cell_text(cJSON_GetObjectItem(row, key), text, sizeof text);
    if (strlen(text) > width) width = strlen(text);
  }
  return (int)width;
}

static void print_table(const cJSON *rows, FILE *out) {
  const cJSON *row, *cell;
  cJSON_ArrayForEach(cell, rows->child) fprintf(out, "  %*s", column_width(rows, cell->string), cell->string);
  fputc('\n', out);
  cJSON_ArrayForEach(row, rows) {
    cJSON_ArrayForEach(cell, row) {
      char text[64];
      cell_text(cell, text, sizeof text);
      fprintf(out, "  %*s", column_width(rows, cell->string), text);
    }
    fputc('\n', out);
  }
}

static bool is_table(const cJSON *item) {
  return cJSON_IsArray(item) && cJSON_IsObject(item->child) && strcmp(item->string, "flights") != 0;
}

static void print_set(const cJSON *set, FILE *out) {
  const cJSON *item;
  if (!set) return;
  fputs("parameters as shipped", out);
  if (set->child) fputs(", but for", out);
  cJSON_ArrayForEach(item, set) fprintf(out, " --set %s=%s", item->string, item->valuestring);
  fputc('\n', out);
}

void result_print(const cJSON *json, FILE *out) {
  const cJSON *item;
  print_set(cJSON_GetObjectItem(json, "set"), out);
  cJSON_ArrayForEach(item, json) {
    if (!is_table(item)) continue;
    fprintf(out, "%s\n", item->string);
    print_table(item, out);
  }
  if (number(json, "realtime_factor") == 0.0) return; // nothing was flown
  fprintf(out, "contacts %g, %s, %.0f x real time\n", number(json, "contacts"),
          cJSON_IsTrue(cJSON_GetObjectItem(json, "finite")) ? "finite" : "NOT FINITE",
          number(json, "realtime_factor"));
}

done_t result_write(const cJSON *json, FILE *file, why_t *why) {
  char *text = cJSON_Print(json);
  if (!text) return error_failed(why, "out of memory");
  fprintf(file, "%s\n", text);
  cJSON_free(text);
  return DONE;
}

// --- over seeds ---------------------------------------------------------------------------------------

static double over_flights(cJSON *const *json, int n, int segment, const char *key) {
  const bool add = strcmp(key, "contacts") == 0, least = strcmp(key, "min_gap_mm") == 0;
  const bool most = strcmp(key, "tilt_max_deg") == 0;
  double sum = 0.0, low = HUGE_VAL, high = -HUGE_VAL;
  for (int i = 0; i < n; i++) {
    const cJSON *segments = cJSON_GetObjectItem(json[i], "segments");
    const double value = number(cJSON_GetArrayItem(segments, segment), key);
    sum += value;
    low = fmin(low, value);
    high = fmax(high, value);
  }
  return add ? sum : least ? low : most ? high : sum / n;
}

static cJSON *segments_over_seeds(cJSON *const *json, int n) {
  cJSON *all = cJSON_Duplicate(cJSON_GetObjectItem(json[0], "segments"), true), *row, *cell;
  int segment = 0;
  cJSON_ArrayForEach(row, all) {
    cJSON_ArrayForEach(cell, row) {
      if (!cJSON_IsNumber(cell)) continue;
      const double value = over_flights(json, n, segment, cell->string);
      cJSON_SetNumberHelper(cell, value);
    }
    segment++;
  }
  return all;
}

cJSON *result_over_seeds(cJSON *const *json, int n, uint64_t first_seed) {
  cJSON *all = cJSON_CreateObject(), *flights = cJSON_CreateArray();
  double contacts = 0.0, factor = 0.0;
  bool finite = true;
  for (int i = 0; i < n; i++) {
    contacts += number(json[i], "contacts");
    factor += number(json[i], "realtime_factor") / n;
    finite = finite && cJSON_IsTrue(cJSON_GetObjectItem(json[i], "finite"));
    cJSON *flight = cJSON_Duplicate(json[i], true);
    cJSON_AddNumberToObject(flight, "seed", (double)(first_seed + (uint64_t)i));
    cJSON_AddItemToArray(flights, flight);
  }
  const cJSON *const set = cJSON_GetObjectItem(json[0], "set"); // the same for all seeds
  if (set) cJSON_AddItemToObject(all, "set", cJSON_Duplicate(set, true));
  cJSON_AddItemToObject(all, "segments", segments_over_seeds(json, n));
  cJSON_AddNumberToObject(all, "contacts", contacts);
  cJSON_AddBoolToObject(all, "finite", finite);
  cJSON_AddNumberToObject(all, "realtime_factor", factor);
  cJSON_AddItemToObject(all, "flights", flights);
  return all;
}
