// many.h - many flights of one scenario, one line each, whose bytes do not depend on how the work was
// divided.
//
// Seeds from..to are written in order. As text: `seed 3 contacts 9 gap_mm 4.08 tilt_deg 6.60 finite`. As JSON
// lines: what --json writes of one flight, without its run time but with the command that flies it alone, and
// `seed`, `min_gap_mm` and, in six degrees of freedom, `tilt_max_deg` of the whole flight. With one date
// (made.h) the lines of 1..10 are those of 1..5 followed by those of 6..10. A summary (summary.h) has no line
// per flight. One process uses all processors that OpenMP gives it (OMP_NUM_THREADS).
#ifndef SIM_FLIGHT_MANY_H
#define SIM_FLIGHT_MANY_H

#include "base/made.h"
#include "flight/scenario.h"
#include "flight/summary.h"
#include <stdio.h>

typedef struct {
  const scenario_t *scenario;
  const request_t *request; // its seed is not used
  uint64_t from, to;
  FILE *text, *json;  // null pointers for none
  summary_t *summary; // gets every flight; a null pointer for none
  const made_t *made; // how one flight is made, without its seed
  bool progress;      // a line on standard error, for people
  int *not_finite;    // gets how many flights did not stay finite
} many_t;

// Writes a line for each flight. BAD_INPUT, FAILED: as the scenario and summary_add; the lines of earlier
// seeds are written then.
MUST_CHECK done_t many_fly(const many_t *m, why_t *why);

#endif
