// excluded.h - channels in which these logs cannot be compared with any model.
//
// Turning is predicted from differences between commands. Where commands are logged more slowly than they
// were given, these differences are mostly noise, and every effect that makes predictions smaller (inertia,
// lag) seems to be missing. The slope shows such a channel: from row to row, the measured turning is far less
// than the predicted one, whatever the lag. What goes with the thrust is no part of that: it is a centre of
// mass or a weak rotor that the vehicle file does not know. If the slope is negative, a sign or the order of
// the motors is wrong.
//
// If two motors are exchanged, two of the three moments cancel: turning follows the commands about one axis
// only. If all spins have the wrong sign, turning follows about x and y, and about z once they are reversed.
// Where a channel is excluded, every other order of the motors is tried; one with which turning follows about
// all three axes is the right one.
#ifndef SIM_GAP_2_PREDICT_EXCLUDED_H
#define SIM_GAP_2_PREDICT_EXCLUDED_H

#include "gap/2_predict/residual.h"

#define EXCLUDED_SLOPE   0.25 // measured over predicted increments; surely below, the channel is excluded
#define EXCLUDED_AGAINST -0.5 // correlation; below, the log is refused

// Sets s->excluded, and s->spins_other where `spin` of the vehicle file has the wrong sign. BAD_INPUT: the
// vehicle turns against its commands, or follows them with the motors in another order. FAILED: no memory.
MUST_CHECK done_t excluded_find(set_t *s, const model_t *m, why_t *why);

#endif
