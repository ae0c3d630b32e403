// local.h - names that stand for something at one place or time only.
#ifndef SIM_GAP_5_INFER_LOCAL_H
#define SIM_GAP_5_INFER_LOCAL_H

#include "gap/5_infer/round.h"

// Sets left[] to what a choice leaves, by channel and row, linearised; the caller frees. FAILED: no memory.
MUST_CHECK done_t local_left(const round_t *r, const choice_t *choice, double *left[CHANNELS], why_t *why);

// Sets *is if the effect, acting only inside or only outside one range of place, height or time, explains the
// rows better than the name does. FAILED: no memory.
MUST_CHECK done_t local_is_confined(const round_t *r, int candidate, bool *is, why_t *why);

// Sets alike[], by candidate: it would stand for this name, in white or in plain rows. FAILED: no memory.
MUST_CHECK done_t local_alike(const round_t *r, int candidate, bool *alike, why_t *why);

#endif
