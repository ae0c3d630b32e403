// for_a_time.h - which effects of the library would explain an unnamed residual, acting only for a time.
//
// A load that is picked up or a propeller that chips acts for a time; every effect of the library acts all
// the time, so none is named. The residual of the time in which it acts (a window, or all but a window) is
// fitted with each effect alone; the residual of the rest counts as noise. Times count from the beginning of
// each log.
#ifndef SIM_GAP_5_INFER_FOR_A_TIME_H
#define SIM_GAP_5_INFER_FOR_A_TIME_H

#include "gap/5_infer/acts_as.h"
#include "gap/5_infer/windows.h"

typedef struct {
  acts_as_t as;        // n 0: no effect of the library would do, or it is tied to no time
  bool outside;        // it acts at all other times
  double from_s, to_s; // of the log
} for_a_time_t;

// Fills *to for a residual that lies in cell and also (windows.h). The one along time is used, if it and the
// rest of the time are two blocks long or more. residual: what is left, by channel and row. base, chosen: the
// model, and what is named beside it. FAILED: no memory.
MUST_CHECK done_t for_a_time(for_a_time_t *to, set_t *s, double *const residual[CHANNELS],
                             const model_t *base, const candidates_t *c, const chosen_t *chosen,
                             const cell_t *cell, const cell_t *also, why_t *why);

#endif
