// lift.h - the factor, row by row, of a flight's own constant.
//
// Most differences between flights go with the lift: another weight or centre of mass, weaker rotors, a
// tilted accelerometer. If they were modelled as constant, the rest, which varies with the lift, would be
// taken for a bend in the thrust curve.
#ifndef SIM_GAP_2_PREDICT_LIFT_H
#define SIM_GAP_2_PREDICT_LIFT_H

#include "gap/2_predict/set.h"

// Fills rows_t.lift of the smooth rows: the lift that the model predicts, over its mean. For sets of several
// flights, or of flights that are compared with several. FAILED: no memory.
MUST_CHECK done_t lift_find(set_t *s, const model_t *m, why_t *why);

#endif
