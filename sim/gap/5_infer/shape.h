// shape.h - after the selection: the shapes of what is named, between the values that were tried.
#ifndef SIM_GAP_5_INFER_SHAPE_H
#define SIM_GAP_5_INFER_SHAPE_H

#include "gap/5_infer/found.h"

// Shape and size of each named effect together (NLopt's BOBYQA: bounded, without derivatives) where they
// leave least of the fitted flights' white sum of squares, in the colours of the model as it was selected;
// the shape stays between the neighbours of the one that was selected. Names, p and shares stay, and a shape
// that is a number of something (a rotor).
//
// The standard errors of both follow from the curvature of that sum, H: the size's, which the selection gave
// for a known shape, times sqrt(H_11 (H^-1)_11), without what stands beside the regression's own; the shape's
// in the proportion that H gives. NaN: it ends at a bound, or there is no minimum. FAILED: no memory.
MUST_CHECK done_t shapes_refine(const candidates_t *c, set_t *s, const model_t *base, found_t *found,
                                why_t *why);

#endif
