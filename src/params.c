// params.c - the parameter table and its range checks.
#include "flight/params.h"

#include <string.h>

#define ROW(group, key, kind, field, unit_, initial_, min_, max_, help_)                                     \
  {.name = #group "." #key,                                                                                  \
   .unit = unit_,                                                                                            \
   .help = help_,                                                                                            \
   .type = kind,                                                                                             \
   .offset = offsetof(flight_param_t, field),                                                                \
   .initial = initial_,                                                                                      \
   .min = min_,                                                                                              \
   .max = max_},

const param_row_t params_table[] = {FLIGHT_PARAMS(ROW)};
const int params_count = (int)(sizeof params_table / sizeof *params_table);

_Static_assert(sizeof(flight_param_t) == 4 * (sizeof params_table / sizeof *params_table),
               "a field of flight_param_t has no row, or is not four bytes wide");

static void store(flight_param_t *p, const param_row_t *row, float value) {
  char *const at = (char *)p + row->offset;
  const int32_t whole = (int32_t)value; // min..max was checked
  memcpy(at, row->type == PARAM_INT ? (const void *)&whole : (const void *)&value, 4);
}

void params_default(flight_param_t *p) {
  for (int i = 0; i < params_count; i++) store(p, &params_table[i], params_table[i].initial);
}

const param_row_t *params_find(const char *name) {
  for (int i = 0; i < params_count; i++)
    if (strcmp(params_table[i].name, name) == 0) return &params_table[i];
  return NULL;
}

float params_get(const flight_param_t *p, const param_row_t *row) {
  const char *const at = (const char *)p + row->offset;
  int32_t whole;
  float value;
  memcpy(&whole, at, 4);
  memcpy(&value, at, 4);
  return row->type == PARAM_INT ? (float)whole : value;
}

status_t params_set(flight_param_t *p, const param_row_t *row, float value) {
  if (!(value >= row->min && value <= row->max)) return ST_BAD_PARAM;
  if (row->type == PARAM_INT && value != (float)(int32_t)value) return ST_BAD_PARAM;
  store(p, row, value);
  return ST_OK;
}

status_t params_check(const flight_param_t *p) {
  for (int i = 0; i < params_count; i++) {
    const float value = params_get(p, &params_table[i]);
    if (!(value >= params_table[i].min && value <= params_table[i].max)) return ST_BAD_PARAM;
  }
  if (p->cutoff_Hz > 0.0f && p->cutoff_Hz < PARAMS_CUTOFF_MIN_HZ) return ST_BAD_PARAM;
  if (p->att_cutoff_Hz > 0.0f && p->att_cutoff_Hz < PARAMS_ATT_CUTOFF_MIN_HZ) return ST_BAD_PARAM;
  if (p->ceiling.floor_m > p->ceiling.near_m) return ST_BAD_PARAM;
  if (p->learn.near_m >= p->learn.far_m) return ST_BAD_PARAM;
  return ST_OK;
}
