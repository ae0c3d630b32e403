// select.h - which effects are missing: forward selection of groups by cross-validation over half-flights.
//
// To enter, a candidate needs
//   (a) p < 0.01 over the number of candidates, of a cluster-robust Wald F over blocks of 2 s,
//   (b) the sign that physics gives it, and a size of at least 0.12 of what is typical (and its own least
//   one), (c) a coefficient above limits_nominal times its rms on nominal flights (nominal_sums.h), (d)
//   a cross-validated gain of 0.4 % of the sum of squares, that is not ups and downs among half-flights.
// A lag or delay below 5 ms, or below one period of the log, is what feedback alone looks like, or streams
// that are not aligned: it is taken into the model, and not named. A name that others could stand for is
// told with them (family.h). The best one enters, of those that leave the same the one with fewest forms
// (twice their logarithm counts with what is left: an effect is there in any of its forms), what is named is
// estimated anew about its present values, what no longer passes beside the others goes, and one is swapped
// for another where both models, replayed, say so; until nothing changes. Of what is left then, a name that
// the rows speak against, beside the others and what feedback makes of all of them together (evidence.h),
// goes out for good, the worst first.
// A first look begins with nothing, in the colours that would be left if everything that can be named were
// there, and what is chosen gets the shape that fits best beside the others; one with nominal flights begins
// where the look before it ended, in the colours of what the names leave. With nothing again, where one of
// these names is out of question now: what it hid was never looked for.
#ifndef SIM_GAP_5_INFER_SELECT_H
#define SIM_GAP_5_INFER_SELECT_H

#include "gap/5_infer/found.h"

typedef struct selection selection_t;

typedef struct {
  candidates_t *candidates; // a first look bends their shapes (bend.h)
  set_t *set;
  const model_t *model;
  const timing_t *timing;   // of this set and model
  const nominal_t *nominal; // a null pointer for a first look; with n 0 where none could be flown
  const chosen_t *before;   // what the look before found; a null pointer for a first one
} select_job_t;

// FAILED: no memory. Close the selection and free what is found, also on an error.
MUST_CHECK done_t select_effects(selection_t **selection, const select_job_t *job, found_t *found,
                                 why_t *why);
// What could stand in the place of each name, and how probable they are; the nominal flights were looked at
// (nominal_look). FAILED: no memory.
MUST_CHECK done_t select_rivals(const selection_t *selection, found_t *found, why_t *why);
void select_close(selection_t *selection);

#endif
