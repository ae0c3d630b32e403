// nominal_sums.h - what the inference takes of flights in which nothing is hidden: sums of products of the
// candidates' columns, and what is found in what is left.
#ifndef SIM_GAP_5_INFER_NOMINAL_SUMS_H
#define SIM_GAP_5_INFER_NOMINAL_SUMS_H

#include "gap/3_feedback/nominal.h"
#include "gap/5_infer/limits.h"
#include "gap/5_infer/unknown.h"

// A flight along each track, and what the flown model leaves of its rows.
typedef struct {
  gap_flights_t flights;
  set_t set;
  double *residual[CHANNELS];
} nominal_left_t;

// Sums of products of nominal flights, one matrix each, with the columns of the candidates.
typedef struct {
  int n, size;
  int flown, lost;         // flights that could be flown, and that could not
  double *total;           // n matrices
  nominal_left_t *left;    // n, until they are looked at
  scan_t *scan;            // n: what looks without a name find (unknown.h), once somebody has asked
  double *kept;            // by column: what is found of a size, because what it is multiplied by has errors
  double floor[CHANNELS];  // rms of a residual row
  double misfit[CHANNELS]; // of the effect that is largest there at its typical size, rms
} nominal_t;

// What is flown: the model with what the first look has named, at its values. Nothing else is hidden; every
// estimate is an error.
typedef struct {
  set_t *set;
  const model_t *base; // without
  model_t flown;       // with
  const candidates_t *c;
  const chosen_t *chosen;
  const closed_loop_t *loop;
  unsigned long seed;
  const double *ridge; // null: sums in the colour of the residual; else of what all candidates leave
} nominal_job_t;

// NOMINAL_FLIGHTS times all flights of the set, of each its first 60 s at most: sums of products of the
// candidates' columns with the residual, in colours in which these flights may differ as much as the log's
// do, for what is compared is to be weighed alike; of the first one, by column x and without errors x', what
// least squares find of a size: x x' / x x. A flight that cannot be flown is left out alone; n is 0 where
// none can. FAILED: no memory.
MUST_CHECK done_t nominal_make(nominal_t *n, const nominal_job_t *job, why_t *why);
// What looks find in each, by the base that it was made with: not in flights that are flown anew before
// somebody asks. FAILED: no memory.
MUST_CHECK done_t nominal_look(nominal_t *n, const model_t *base, why_t *why);
void nominal_free(nominal_t *n);

#endif
