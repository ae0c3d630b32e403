// either.h - one of two numbers, and one of a list, in code that is compiled for eight vehicles at a time,
// too (base/lane_c.hpp): what takes the place of `? :` and [] where they depend on numbers. Header only.
#ifndef SIM_BASE_EITHER_H
#define SIM_BASE_EITHER_H

// A whole number that is one and the same for all of them.
typedef int alike_t;

// a where it holds, else b; eight at a time both are computed.
#ifndef EITHER // flight/v3.h has it, too
#define EITHER(holds, a, b) ((holds) ? (a) : (b))
#endif

// Whether it holds for any of them: what is begun for one is computed for all, and EITHER says for whom it
// counts.
#ifndef ANY
#define ANY(holds) (holds)
#endif

// What follows is done where it holds. It changes *state, in which there is no double, and what it makes
// itself, nothing else: of several vehicles the state of the others stays.
#ifndef FOR_WHOM
#define FOR_WHOM(holds, state) if (holds)
#endif

// Element i, which may be another one for each vehicle.
#ifndef PICK
#define PICK(list, i) ((list)[i])
#endif

#endif
