// request_spec.h - parses what the command line asks for.
#ifndef SIM_FLIGHT_REQUEST_SPEC_H
#define SIM_FLIGHT_REQUEST_SPEC_H

#include "flight/setup.h"

// Each takes the value of one option. BAD_INPUT: not a valid value; *why says what is allowed.
MUST_CHECK done_t request_take_noise(request_t *r, const char *name, why_t *why);
MUST_CHECK done_t request_take_integrator(request_t *r, const char *name, why_t *why);
MUST_CHECK done_t request_take_log_rate(request_t *r, const char *text, why_t *why);
// A file with a value of request_take_set on each line; empty lines and those that begin with # are skipped.
MUST_CHECK done_t request_take_sets(request_t *r, const char *path, why_t *why);
MUST_CHECK done_t request_take_set(request_t *r, const char *text, why_t *why);
// *kind belongs to the caller and must live as long as the request.
MUST_CHECK done_t request_take_controller(request_t *r, fly_kind_t *kind, const char *name, why_t *why);
// NAME:KEY=VALUE,...; `none` switches off what the scenario has and what was asked for before.
MUST_CHECK done_t request_take_effect(request_t *r, const char *spec, why_t *why);

#endif
