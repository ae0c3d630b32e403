// local.h - names that stand for something at one place or time only.
#ifndef SIM_GAP_5_INFER_LOCAL_H
#define SIM_GAP_5_INFER_LOCAL_H

#include "gap/5_infer/round.h"

// What a choice leaves, row by row, in the straight line's sense; the caller frees. FAILED: no memory.
MUST_CHECK done_t local_left(const round_t *r, const choice_t *choice, double *left[CHANNELS], why_t *why);

// The same effect, but in one range of place, height or time only, or only beside it, explains the rows
// better than the name does. FAILED: no memory.
MUST_CHECK done_t local_is_confined(const round_t *r, int candidate, bool *is, why_t *why);

// Tells for each candidate whether it would stand for this name, white or as a plain mean. FAILED: no memory.
MUST_CHECK done_t local_alike(const round_t *r, int candidate, bool *alike, why_t *why);

#endif
