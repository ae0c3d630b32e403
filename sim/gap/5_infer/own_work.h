// own_work.h - whether a delay, a lag, an inertia or a slope of the thrust is control's own work: its answer
// to what disturbs the vehicle.
//
// When a moment comes and goes, control answers late, by its way through motors and body, and gives less
// than all of it. In a calm flight, which holds little else, commands then look as if they acted late, or
// less: least squares in closed loop err where the disturbance is coloured (Ljung, System Identification,
// 1999, 13.4). Nominal flights with such a name do not show this, because their model has it. So the model
// is flown without the name, disturbed by as much as the log then leaves. In the log and in these flights,
// the same ratio is formed: what the name's columns, formed about zero, take beside the other names, over
// what they leave. A real effect leaves hardly anything in the log, but much in flights that are disturbed
// by all that it explains there.
//
// Of an inertia's three numbers only how much they take together counts: a smaller inertia is treated as a
// larger one.
#ifndef SIM_GAP_5_INFER_OWN_WORK_H
#define SIM_GAP_5_INFER_OWN_WORK_H

#include "gap/3_feedback/nominal.h"
#include "gap/4_candidates/candidates.h"

typedef struct {
  const candidates_t *c;
  set_t *set;
  const model_t *base;
  const flown_by_t *flown_by; // null: not known who flew
  unsigned long seed;         // of the nominal flights
  unsigned long trial_seed;   // of the trial flights that say how much disturbs them
} own_work_job_t;

// Sets own[k] for each of n chosen candidates that control's answers look like (fx->answers): true if it is
// control's own work. All are tested together first; if together they exceed what control makes, each is
// tested beside the others, and one stays at least. A candidate exceeds it if it takes more than in nominal
// flights without it, by more than chance and the doubt about who flew. Where no flight could be flown all
// stay. FAILED: no memory. BAD_INPUT: too many effects.
MUST_CHECK done_t own_work(const own_work_job_t *job, const chosen_t *chosen, int n, const int *candidate,
                           bool *own, why_t *why);

#endif
