// family.h - the rivals of each name: other effects that these flights cannot separate from it.
//
// Another effect belongs to a name's family in two cases. Either it gives most of what the name gives in
// these flights, alone or beside the other names, at a possible size, and the name fits better by no more
// than chance, the unexplained residual and the error of linearisation allow. Or it leaves less in the name's
// place, and beside it the name gives less than half. A rival would move the other names' numbers: half of
// that shift counts as their error.
#ifndef SIM_GAP_5_INFER_FAMILY_H
#define SIM_GAP_5_INFER_FAMILY_H

#include "gap/5_infer/found.h"

// Sets for `found`, which found_describe() has filled: the rivals of every name, the best fitting first; the
// probability that the name or one of its rivals is there; and which columns these flights could not tell
// apart at their typical size. Where the name and its rivals are less likely than not (evidence.h), the best
// effect of the likeliest other set becomes the last rival. measured: rotor speeds were logged, which tell
// lag from delay. FAILED: no memory.
MUST_CHECK done_t family_find(const round_t *r, bool measured, found_t *found, why_t *why);

#endif
