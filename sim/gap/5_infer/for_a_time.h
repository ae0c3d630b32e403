// for_a_time.h - which effects of the library would do for what has no name, if they acted for a time only.
//
// A load that is picked up, a propeller that chips: every effect of the library acts all the time, and so
// none is named. What is left while it acts, in that time or in all other, is fitted with each effect alone;
// what the rest of the time leaves is noise. Times count from the beginning of each log.
#ifndef SIM_GAP_5_INFER_FOR_A_TIME_H
#define SIM_GAP_5_INFER_FOR_A_TIME_H

#include "gap/5_infer/acts_as.h"
#include "gap/5_infer/windows.h"

typedef struct {
  acts_as_t as;        // n 0: nothing of the library would do, or it is of no time
  bool outside;        // in all the time but that
  double from_s, to_s; // of the log
} for_a_time_t;

// cell, also: where it is (windows.h). Of these the one that is along the time counts, if it is two blocks
// long, and the rest of the time, too. residual: what is left, by channel and row. base, chosen: the model,
// and what is named beside it. FAILED: no memory.
MUST_CHECK done_t for_a_time(for_a_time_t *to, set_t *s, double *const residual[CHANNELS],
                             const model_t *base, const candidates_t *c, const chosen_t *chosen,
                             const cell_t *cell, const cell_t *also, why_t *why);

#endif
