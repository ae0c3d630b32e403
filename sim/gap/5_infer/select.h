// select.h - which effects are missing: forward selection of groups by cross-validation over half-flights.
//
// To enter, a candidate needs
//   (a) p < 0.01 over the number of candidates, of a cluster-robust Wald F over blocks of 2 s,
//   (b) sizes that the effect can have, the largest of them above 0.12 of what is typical,
//   (c) sizes above limits_nominal() times their rms on the nominal flights that would show them,
//   (d) a cross-validated gain of 0.4 % of the sum of squares that exceeds its scatter between half-flights,
//   (e) no harm to any group of channels (score_harms).
// Until nothing changes, the best candidate enters (as first names of a first look also two that hide each
// other, pairs.h), the numbers of the choice are estimated anew about their present values, what no longer
// passes beside the others goes out, and one candidate is swapped for another where both models, replayed,
// confirm it. Twice the logarithm of the number of an effect's forms counts with what is left (round_left).
// Then the name that the rows speak against most, beside the others and what feedback makes of all of them
// together (evidence.h), goes out for good, and the search goes on.
//
// A lag or delay below 5 ms, or below one period of the log, is what feedback alone or streams that are not
// aligned look like: it is taken into the model, and not named. A name that others could stand for is told
// with them (family.h).
//
// A first look begins with nothing, in the colours that would be left if everything that can be named were
// there, and gives each chosen effect the shape that fits best beside the others. It takes an effect that
// control's work looks like only if control cannot have made it (beyond_control.h). A look with nominal
// flights begins where the look before it ended, in the colours of what the names leave; if one of these
// names is ruled out by now, it begins with nothing, because what that name hid was never looked for.
#ifndef SIM_GAP_5_INFER_SELECT_H
#define SIM_GAP_5_INFER_SELECT_H

#include "gap/5_infer/found.h"

typedef struct selection selection_t;

typedef struct {
  candidates_t *candidates; // a first look changes their shapes (bend.h)
  set_t *set;
  const model_t *model;
  const timing_t *timing;   // of this set and model
  const nominal_t *nominal; // null in a first look; n is 0 where none could be flown
  const chosen_t *before;   // what the look before found; null in a first look
} select_job_t;

// Selects the effects and describes them in `found`. FAILED: no memory. Close the selection and free what is
// found, also on an error.
MUST_CHECK done_t select_effects(selection_t **selection, const select_job_t *job, found_t *found,
                                 why_t *why);
// Finds what could stand in the place of each name, and how probable it is. Call nominal_look() before.
// FAILED: no memory.
MUST_CHECK done_t select_rivals(const selection_t *selection, found_t *found, why_t *why);
void select_close(selection_t *selection);

#endif
