// param_spec.h - a parameter of the flight code as a person sets it: group.name=value.
#ifndef SIM_PARAM_SPEC_H
#define SIM_PARAM_SPEC_H

#include "error.h"
#include "flight/params.h"

// ST_BAD_INPUT: not of that form, no such parameter, or out of its range.
MUST_CHECK status_t param_parse(const char *text, const param_row_t **row, float *value, why_t *why);

// ST_BAD_INPUT: the set as a whole contradicts itself (params_check).
MUST_CHECK status_t param_check_all(const flight_param_t *p, why_t *why);

#endif
