// shape.h - after the selection: refines the shapes of named effects between the values that were tried.
#ifndef SIM_GAP_5_INFER_SHAPE_H
#define SIM_GAP_5_INFER_SHAPE_H

#include "gap/5_infer/found.h"

// Refines shape and size of each named effect together, to leave least of the fitted flights' white sum of
// squares (NLopt's BOBYQA: bounded, without derivatives) in the colours of the model as it was selected. The
// shape stays between the neighbours of the selected one. Names, p and shares stay, and a shape that is a
// number of something (a rotor) or the vehicle file's.
//
// The standard errors follow from the curvature H of that sum. The size's own error, which the selection
// gave for a known shape, is multiplied by sqrt(H_11 (H^-1)_11); named_t.beside stays. The shape's error is
// sqrt((H^-1)_00), enlarged as the size's own is, with named_t.shape_beside. It is NaN, and the size's
// stays, where one of them ends at a bound or there is no minimum. FAILED: no memory.
MUST_CHECK done_t shapes_refine(const candidates_t *c, set_t *s, const model_t *base, found_t *found,
                                why_t *why);

#endif
