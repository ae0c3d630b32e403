// nominal_sums.h - what the inference takes from flights in which nothing is hidden: sums of products of the
// candidates' columns, and what looks find in the residual.
#ifndef SIM_GAP_5_INFER_NOMINAL_SUMS_H
#define SIM_GAP_5_INFER_NOMINAL_SUMS_H

#include "gap/3_feedback/nominal.h"
#include "gap/5_infer/limits.h"
#include "gap/5_infer/unknown.h"

// A nominal flight along each track, and the residual that the flown model leaves of it.
typedef struct {
  gap_flights_t flights;
  set_t set;
  double *residual[CHANNELS];
} nominal_left_t;

// Sums of products of the candidates' columns and the residual, one matrix for each nominal flight.
typedef struct {
  int n, size;
  int flown, lost;         // flights that could be flown, and that could not
  double *total;           // n matrices, each size x size
  nominal_left_t *left;    // n; freed once they are looked at
  scan_t *scan;            // n: what looks find without a name (unknown.h); set by nominal_look()
  double *kept;            // by column, 0 to 1: share of a size that is found, because the column has errors
  double floor[CHANNELS];  // rms of a residual row, mean of the flights
  double misfit[CHANNELS]; // rms: CANDIDATES_MISFIT of the channel's largest effect at its typical size
} nominal_t;

// What is flown: the model with the chosen effects at their values. Nothing else is hidden, so every
// estimate is an error.
typedef struct {
  set_t *set;
  const model_t *base; // the model without the chosen effects
  model_t flown;       // the model with them
  const candidates_t *c;
  const chosen_t *chosen;
  const closed_loop_t *loop;
  unsigned long seed;
  const double *ridge; // null: in the colours of the residual; else of what all candidates leave
} nominal_job_t;

// Flies all flights of the set NOMINAL_FLIGHTS times, of each at most its first 60 s, and sums up the
// products of the candidates' columns and the residual. The colours let these flights differ as much as the
// log's do, because log and nominal flights are compared and have to be weighted alike. The first flight
// gives kept: x x' / x x, with a column x and the same column x' without errors. A flight that cannot be
// flown is left out, the others stay; n is 0 where none can be flown. FAILED: no memory.
MUST_CHECK done_t nominal_make(nominal_t *n, const nominal_job_t *job, why_t *why);
// Sets scan to what the looks find in each flight; base is that of the job. It is apart from nominal_make()
// because flights may be flown anew before anybody asks for their scans. FAILED: no memory.
MUST_CHECK done_t nominal_look(nominal_t *n, const model_t *base, why_t *why);
void nominal_free(nominal_t *n);

#endif
