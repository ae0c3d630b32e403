// excluded.h - channels in which these logs cannot be compared with any model.
//
// Turning follows from differences of commands. Where commands are logged more slowly than they were given,
// what is logged is mostly noise, and every effect that makes predictions smaller (inertia, lag) seems to be
// missing. Such a channel shows by its slope: row to row, the measured turning is far less than the predicted
// one, whatever the lag. Where it goes the other way, a sign or the order of the motors is wrong.
//
// Two motors that are exchanged cancel two of the moments: turning follows the commands about one axis alone.
// With all spins of the other sign turning follows about x and y, and about z once they are turned round.
// Where a channel is excluded every other order of the motors is tried; one that turns about all three axes
// as measured is the right one.
#ifndef SIM_GAP_2_PREDICT_EXCLUDED_H
#define SIM_GAP_2_PREDICT_EXCLUDED_H

#include "gap/2_predict/residual.h"

#define EXCLUDED_SLOPE   0.25
#define EXCLUDED_AGAINST -0.5 // correlation

// Sets s->excluded, and s->spins_other where `spin` of the vehicle file has the other sign. BAD_INPUT: the
// vehicle turns against its commands, or as they say with the motors in another order. FAILED: no memory.
MUST_CHECK done_t excluded_find(set_t *s, const model_t *m, why_t *why);

#endif
