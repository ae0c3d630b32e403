// request_spec.h - what the command line asks for, from text.
#ifndef SIM_FLIGHT_REQUEST_SPEC_H
#define SIM_FLIGHT_REQUEST_SPEC_H

#include "flight/setup.h"

// Each takes the value of one option. BAD_INPUT: not such a value; says what is allowed.
MUST_CHECK done_t request_take_noise(request_t *r, const char *name, why_t *why);
MUST_CHECK done_t request_take_integrator(request_t *r, const char *name, why_t *why);
MUST_CHECK done_t request_take_log_rate(request_t *r, const char *text, why_t *why);
// A file of such lines; empty ones and those that begin with # are left out.
MUST_CHECK done_t request_take_sets(request_t *r, const char *path, why_t *why);
MUST_CHECK done_t request_take_set(request_t *r, const char *text, why_t *why);
// *kind is the caller's, and lives as long as the request.
MUST_CHECK done_t request_take_controller(request_t *r, fly_kind_t *kind, const char *name, why_t *why);
// NAME:KEY=VALUE,...; `none` switches off what the scenario has and what was asked for before.
MUST_CHECK done_t request_take_effect(request_t *r, const char *spec, why_t *why);

#endif
