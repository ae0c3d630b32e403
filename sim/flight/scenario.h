// scenario.h - a flight or a study that has a name. One file each; the build collects them.
#ifndef SIM_FLIGHT_SCENARIO_H
#define SIM_FLIGHT_SCENARIO_H

#include "flight/result.h"
#include "flight/setup.h"

typedef struct {
  const char *name; // on the command line
  const char *brief;
  // Flies and adds to *result, which is empty. BAD_INPUT: what was asked for cannot be flown.
  done_t (*run)(const request_t *request, result_t *result, why_t *why);
} scenario_t;

extern const scenario_t *const scenario_table[];
extern const int scenario_count;

// Returns the scenario of that name, or a null pointer.
const scenario_t *scenario_find(const char *name);
// The same for a name that a person typed. BAD_INPUT: there is none; *why names the one that may be meant.
MUST_CHECK done_t scenario_take(const char *name, const scenario_t **scenario, why_t *why);

// Sets up the thesis's appendix A: 32 g under a ceiling at 0.5 m, ceiling term not clipped, everything
// measured exactly. BAD_INPUT: a fault of the build, not of the user.
MUST_CHECK done_t scenario_appendix_a_setup(setup_t *setup, fly_kind_t kind, why_t *why);

// Sets up its learning flight with noise N1 and applies the request. BAD_INPUT: as setup_apply and
// scenario_check_ladder.
MUST_CHECK done_t scenario_learning_setup(setup_t *setup, const request_t *request, why_t *why);

// Sets up the thesis's flights in six degrees of freedom and applies the request; the caller adds the set
// points. BAD_INPUT: as setup_apply and scenario_check_ladder.
MUST_CHECK done_t scenario_thesis_setup(setup_t *setup, fly_kind_t kind, const request_t *request,
                                        why_t *why);

// Flies and adds the flight. BAD_INPUT, FAILED: as setup_fly.
MUST_CHECK done_t scenario_fly(const setup_t *setup, result_t *result, why_t *why);

// BAD_INPUT: no ceiling within 100 m, or one so low that the learning ladder would begin in the ground.
MUST_CHECK done_t scenario_check_ladder(const model_t *model, why_t *why);

// BAD_INPUT: with this request no curve of the ceiling is learned (ceil.mode is not 2). name: the scenario's.
MUST_CHECK done_t scenario_check_learns(const setup_t *setup, const char *name, why_t *why);

#endif
