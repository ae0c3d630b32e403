// local.h - names that stand for something at one place, time or state only.
#ifndef SIM_GAP_5_INFER_LOCAL_H
#define SIM_GAP_5_INFER_LOCAL_H

#include "gap/5_infer/round.h"

// What a choice leaves, row by row, in the straight line's sense; the caller frees. FAILED: no memory.
MUST_CHECK done_t local_left(const round_t *r, const choice_t *choice, double *left[CHANNELS], why_t *why);

// Something at one place, time or state explains more than this name does: the name is an echo of it.
// FAILED: no memory.
MUST_CHECK done_t local_is_echo(const round_t *r, int candidate, bool *is, why_t *why);

// The name is needed in one range of place, height or time only. FAILED: no memory.
MUST_CHECK done_t local_is_confined(const round_t *r, int candidate, bool *is, why_t *why);

// Tells for each candidate whether it would stand for this name, white or as a plain mean. FAILED: no memory.
MUST_CHECK done_t local_alike(const round_t *r, int candidate, bool *alike, why_t *why);

#endif
