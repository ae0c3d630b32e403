// param_spec.c - a parameter of the flight code as a person sets it.
#include "pilots/param_spec.h"

#include "base/number.h"
#include "crazyflie/sections.h"
#include "firmware/glue.h"
#include "flight/hold.h"
#include <string.h>

#define APP_ROW(name_, type, field, initial_, max_, help_)                                                   \
  {.name = "ceil." #name_, .help = help_, .initial = initial_, .max = max_},
const param_app_t param_app_table[] = {APP_PARAMS(APP_ROW)};
const int param_app_count = (int)(sizeof param_app_table / sizeof *param_app_table);

static const param_app_t *find_app(const char *name) {
  for (int i = 0; i < param_app_count; i++)
    if (strcmp(param_app_table[i].name, name) == 0) return &param_app_table[i];
  return NULL;
}

void param_thesis(flight_param_t *p) {
  static const struct {
    const char *name;
    float value;
  } row[] = {{"indiPos.kp", 1.0f},
             {"indiPos.kd", 5.0f},
             {"indiPos.kpz", 1.0f},
             {"indiPos.kdz", 5.0f},
             {"indiPos.quick", 1.0f},
             {"indiPos.cutoff", 8.0f},
             {"ceil.law", (float)LAW_THESIS},
             {"ceil.hold", (float)HOLD_LATCHED}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++)
    (void)!params_set(p, params_find(row[i].name), row[i].value); // each is in its range: a test checks it
}

const char *param_hint(const char *name, char hint[NEAREST_HINT]) {
  nearest_t nearest = nearest_to(name);
  for (int i = 0; i < params_count; i++) nearest_try(&nearest, params_table[i].name);
  for (int i = 0; i < param_app_count; i++) nearest_try(&nearest, param_app_table[i].name);
  return nearest_hint(&nearest, hint);
}

static bool fits(const param_set_t *set, double number) {
  flight_param_t trial;
  params_default(&trial);
  if (set->row) return params_set(&trial, set->row, (float)number) == ST_OK;
  return number >= 0.0 && number <= (double)set->app->max && number == (double)(int)number;
}

done_t param_parse(const char *text, param_set_t *set, why_t *why) {
  char name[32], hint[NEAREST_HINT];
  const size_t size = strcspn(text, "=");
  if (text[size] != '=' || size >= sizeof name)
    return error_set(why, "--set %s: allowed is group.name=value", text);
  memcpy(name, text, size);
  name[size] = '\0';
  *set = (param_set_t){.row = params_find(name), .app = find_app(name)};
  if ((!set->row && !set->app) || !sections_param(name))
    return error_set(why, "--set %s: no such parameter%s; fly --params lists them", name,
                     param_hint(name, hint));
  double number;
  const bool whole = !set->row || set->row->type == PARAM_INT;
  if (!number_parse(text + size + 1, &number) || !fits(set, number))
    return error_set(why, "--set %s: allowed is a %snumber from %g to %g", text, whole ? "whole " : "",
                     set->row ? (double)set->row->min : 0.0,
                     set->row ? (double)set->row->max : (double)set->app->max);
  set->value = (float)number;
  return DONE;
}

done_t param_check_all(const flight_param_t *p, why_t *why) {
  if (params_check(p) == ST_OK) return DONE;
  const float f = p->cutoff_Hz;
  if (f > 0.0f && f < PARAMS_CUTOFF_MIN_HZ)
    return error_set(why, "--set indiPos.cutoff=%g: allowed is 0, or 0.1 to 45 Hz", (double)f);
  const float g = p->att_cutoff_Hz;
  if (g > 0.0f && g < PARAMS_ATT_CUTOFF_MIN_HZ)
    return error_set(why, "--set indiAtt.cutoff=%g: allowed is 0, or 0.5 to 200 Hz", (double)g);
  return error_set(
      why,
      "--set: with rls.q=%g, rls.p0=%g, ceil.floor=%g, ceil.near=%g, ceil.far=%g, rls.zMin=%g, rls.zMax=%g: "
      "allowed is rls.q <= rls.p0, ceil.floor <= ceil.near < ceil.far, rls.zMin < rls.zMax",
      (double)p->learn.rls.q, (double)p->learn.rls.p0, (double)p->ceiling.floor_m, (double)p->ceiling.near_m,
      (double)p->ceiling.far_m, (double)p->learn.near_m, (double)p->learn.far_m);
}
