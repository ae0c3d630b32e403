// contact.h - instants at which the vehicle touches something, though its estimated place says that it does
// not.
//
// Where an estimate is off by a centimetre, a touch of ceiling or floor does not show by the distance. It
// shows by rows that stick out of what all candidates together can explain, near a surface: they are left
// out.
#ifndef SIM_GAP_5_INFER_CONTACT_H
#define SIM_GAP_5_INFER_CONTACT_H

#include "gap/4_candidates/candidates.h"

#define CONTACT_NEAR_M 0.03 // clearance below which a touch is thought of
#define CONTACT_SD     8.0  // so far a row sticks out, in robust standard deviations

// Takes such rows, and those that the filter mixes with them, out of the set's sequences. FAILED: no
// memory.
MUST_CHECK done_t contact_drop(set_t *s, const candidates_t *c, const model_t *m, why_t *why);

#endif
