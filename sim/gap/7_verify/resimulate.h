// resimulate.h - the held-out flight flown again by a model, in closed loop: does it stay on the measured
// track?
//
// The motors get the logged commands, plus what a pilot adds who sees how far the simulated vehicle is from
// the measured track. The pilot is proportional in place, velocity, attitude and rates, with the gains of
// nominal pilots (nominal.h), in height at least those of resimulate.c, and is the same for every model. A
// model without error needs no correction and stays on the track.
#ifndef SIM_GAP_7_VERIFY_RESIMULATE_H
#define SIM_GAP_7_VERIFY_RESIMULATE_H

#include "gap/3_feedback/nominal.h"
#include "gap/5_infer/by_turns.h"

// How far one model flies from the measured track, from which short-lived errors are taken out
// (2_predict/smooth.c).
typedef struct {
  double rms_m, height_m; // over all held-out flights: in space, and in height alone
  int lost;               // times that it was more than RESIMULATE_LOST_M away and was put back
  double *off_m[3];       // x, y, height by point of the first held-out flight; NaN where nothing flies
} again_t;

typedef struct {
  bool flew; // false: see why_not
  const char *why_not;
  again_t before, after;
  int n;
  double *t_s; // of the points; off_m lie in the same piece of memory
} resimulation_t;

#define RESIMULATE_LOST_M 2.0

// Flies the held-out flights again by both models. after: what the second one has besides, by turns: each
// turn flies all of a flight, and its own stretches count. FAILED: no memory. Free it, also on an error.
MUST_CHECK done_t resimulate(const set_t *held, const model_t *before, const by_turns_t *after,
                             const closed_loop_t *loop, resimulation_t *r, why_t *why);
void resimulation_free(resimulation_t *r);

#endif
