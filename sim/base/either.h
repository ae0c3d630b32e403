// either.h - choices between numbers, and from a list, in code that is also compiled for eight vehicles at a
// time (base/lane_c.hpp). Replaces `? :` and [] where they depend on numbers. Header only.
#ifndef SIM_BASE_EITHER_H
#define SIM_BASE_EITHER_H

// A whole number that is the same for all vehicles.
typedef int alike_t;

// a where the condition holds, else b; for eight vehicles both are computed.
#ifndef EITHER // flight/v3.h defines it, too
#define EITHER(holds, a, b) ((holds) ? (a) : (b))
#endif

// True if the condition holds for any vehicle: work that one vehicle needs is done for all, and EITHER
// selects the vehicles whose result counts.
#ifndef ANY
#define ANY(holds) (holds)
#endif

// Executes the following statement where the condition holds. The statement may change only *state, which
// must contain no double, and its own variables: the other vehicles' state is restored.
#ifndef FOR_WHOM
#define FOR_WHOM(holds, state) if (holds)
#endif

// Element i of the list; i may differ from vehicle to vehicle.
#ifndef PICK
#define PICK(list, i) ((list)[i])
#endif

#endif
