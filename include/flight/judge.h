// judge.h - the parts of the guard's judgement, for guard.c alone: which reasons there are in this call.
// State and inputs are the guard's; the table in guard.h says what comes of a reason.
#ifndef FLIGHT_JUDGE_H
#define FLIGHT_JUDGE_H

#include "flight/guard.h"

// test: guard_counts_to_the_end_and_stops
#define JUDGE_MS_MAX 1000000 // nobody flies for so long, and it is far from where an int ends
// test: guard_gives_a_bias_when_it_has_settled_for_two_seconds
#define JUDGE_SETTLED_S 2.0f // after a step of the accelerometer's bias: its mean has stood for a second

// The time for which something lasts, ms more now.
static inline int judge_longer(int total_ms, bool lasts, int ms) {
  return EITHER(!lasts, 0, EITHER(total_ms < JUDGE_MS_MAX - ms, total_ms + ms, JUDGE_MS_MAX));
}

// The first plausible call.
void judge_begin(guard_t *g, const guard_in_t *in);

// The reasons GUARD_OF_MOTION; g->vel_w_mps is then the velocity that is believed.
unsigned judge_motion(guard_t *g, const guard_in_t *in);

// The reasons GUARD_OF_CEILING.
unsigned judge_ceiling(guard_t *g, const guard_param_t *p, const guard_in_t *in);

#endif
