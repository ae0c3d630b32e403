// judge.h - the parts of the guard's judgement, for guard.c alone: which reasons there are in this call.
// State and inputs are the guard's; the table in guard.h says what a reason leads to.
#ifndef FLIGHT_JUDGE_H
#define FLIGHT_JUDGE_H

#include "flight/guard.h"

// test: guard_counts_to_the_end_and_stops
#define JUDGE_MS_MAX 1000000 // longer than any flight, and far below the largest int
// test: guard_gives_a_bias_when_it_has_settled_for_two_seconds
#define JUDGE_SETTLED_S 2.0f // after a step of the accelerometer's bias: its mean has not moved for a second

// Returns the time for which a condition has lasted: ms more if it `lasts`, else 0.
static inline int judge_longer(int total_ms, bool lasts, int ms) {
  return EITHER(!lasts, 0, EITHER(total_ms < JUDGE_MS_MAX - ms, total_ms + ms, JUDGE_MS_MAX));
}

// Starts the rules from the first plausible call.
void judge_begin(guard_t *g, const guard_in_t *in);

// Returns the reasons of GUARD_OF_MOTION, and sets g->vel_w_mps to the velocity that is believed.
unsigned judge_motion(guard_t *g, const guard_in_t *in);

// Returns the reasons of GUARD_OF_CEILING.
unsigned judge_ceiling(guard_t *g, const guard_param_t *p, const guard_in_t *in);

#endif
