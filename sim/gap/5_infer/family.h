// family.h - which other effects could stand in a name's place: what these flights cannot separate.
//
// Another effect is of a name's family if it gives, alone or beside the other names, most of what the name
// gives in these flights, at a size that it can have, and the name is not better by more than chance, what is
// left unexplained and the error of straight lines could make it; or if it leaves less in the name's place,
// and beside it the name gives less than half. The other names' numbers, which it would move, are known no
// better than half of that way.
#ifndef SIM_GAP_5_INFER_FAMILY_H
#define SIM_GAP_5_INFER_FAMILY_H

#include "gap/5_infer/found.h"

// Sets the rivals of every name of `found`, which is described already (found.h), the most likely first; how
// probable it is that one of them is there; and which columns could not be told apart in these flights if
// they were there with their typical size. Where the rows speak for a set without any of them (evidence.h),
// what that set has is a rival, too. measured: rotor speeds were logged, they tell lag from delay. FAILED: no
// memory.
MUST_CHECK done_t family_find(const round_t *r, bool measured, found_t *found, why_t *why);

#endif
