// param_spec.h - a parameter of the flight code as a person sets it: group.name=value.
#ifndef SIM_PILOTS_PARAM_SPEC_H
#define SIM_PILOTS_PARAM_SPEC_H

#include "base/error.h"
#include "base/nearest.h"
#include "flight/params.h"

// A parameter that only the app has, not the flight code (ceil.shadow).
typedef struct {
  const char *name, *help;
  float initial, max; // whole numbers from 0
} param_app_t;

extern const param_app_t param_app_table[];
extern const int param_app_count;

typedef struct {
  const param_row_t *row; // null: one of the app
  const param_app_t *app; // null: one of the flight code
  float value;
} param_set_t;

// Reads "group.name=value"; the app must have the parameter (crazyflie/sections.h). BAD_INPUT: not of that
// form, no such parameter, or out of its range.
MUST_CHECK done_t param_parse(const char *text, param_set_t *set, why_t *why);

// Sets the parameters in which the thesis's control law differs from what ships to the thesis's values.
void param_thesis(flight_param_t *p);

// Fills and returns hint, a suggestion to follow a name that is no parameter: the one that may be meant
// (base/nearest.h).
const char *param_hint(const char *name, char hint[NEAREST_HINT]);

// BAD_INPUT: the set as a whole contradicts itself (params_check).
MUST_CHECK done_t param_check_all(const flight_param_t *p, why_t *why);

#endif
