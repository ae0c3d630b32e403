// pairs.h - two effects that hide each other.
//
// Forward selection sees one effect at a time. Two that pull opposite ways, such as stronger rotors and a
// battery that sags, leave so much of each other that neither alone is sure, and none ever enters. Of such a
// pair the two together take more than the one alone and the other alone add up to (a suppressor: Horst
// 1941).
#ifndef SIM_GAP_5_INFER_PAIRS_H
#define SIM_GAP_5_INFER_PAIRS_H

#include "gap/5_infer/round.h"

typedef struct {
  int of[2];   // candidates
  double more; // of the sum of squares, that the two take together and not one by one
} hiding_t;

typedef struct {
  int n;
  hiding_t *pair; // the most first
} pairs_t;

// Finds the pairs that may stand beside the round's choice and take at least SELECT_GAIN of what it leaves
// together beyond what they take one by one. out: by candidate, it may not come in. FAILED: no memory.
// Free it, also on an error.
MUST_CHECK done_t pairs_find(pairs_t *p, const round_t *r, const bool *out, why_t *why);
void pairs_free(pairs_t *p);

// True if each of the two, beside the other, has p < SELECT_ALPHA over the number of pairs.
bool pairs_sure(const round_t *r, const hiding_t *pair);

#endif
