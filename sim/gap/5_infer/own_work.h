// own_work.h - whether a delay, a lag, an inertia or a slope of the thrust is control's own work: its answer
// to what disturbs the vehicle.
//
// Who answers a moment that comes and goes is late by his way through motors and body, and gives less than
// all of it. In a calm flight that holds little else it looks as if commands acted late, or less: least
// squares of a closed loop err where the disturbance has a colour (Ljung, System Identification, 1999, 13.4).
// Nominal flights that have such a name do not show it: there it is the model's. So the model is flown
// without it, disturbed by as much as the log leaves then, and both are asked alike: what does the straight
// line about nothing take, over what it leaves, beside the other names? A real one leaves hardly anything in
// a log, and much in flights that are disturbed by all that it explains there.
//
// Of an inertia, three numbers, only how much they take together counts: one that is smaller is asked as one
// that is larger.
#ifndef SIM_GAP_5_INFER_OWN_WORK_H
#define SIM_GAP_5_INFER_OWN_WORK_H

#include "gap/3_feedback/nominal.h"
#include "gap/4_candidates/candidates.h"

typedef struct {
  const candidates_t *c;
  set_t *set;
  const model_t *base;
  const flown_by_t *flown_by; // null: nobody knows
  unsigned long seed;         // of the nominal flights,
  unsigned long trial_seed;   // and of those that say how much shakes them
} own_work_job_t;

// Of n candidates that are chosen, effects that answers look like (fx->answers): own of each says that it is.
// All together first; each beside the others then, if these say more: of them one stays at least. A name says
// more where it takes more than in nominal flights without it, by chance and by what is not known of who
// flew. Where none could be flown they do. FAILED: no memory. BAD_INPUT: too many effects.
MUST_CHECK done_t own_work(const own_work_job_t *job, const chosen_t *chosen, int n, const int *candidate,
                           bool *own, why_t *why);

#endif
