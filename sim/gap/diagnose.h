// diagnose.h - the workflow on flights in memory: stages 2 to 5, and 7.
#ifndef SIM_GAP_DIAGNOSE_H
#define SIM_GAP_DIAGNOSE_H

#include "gap/5_infer/flights_differ.h"
#include "gap/5_infer/for_a_time.h"
#include "gap/5_infer/unknown.h"
#include "gap/7_verify/verify.h"

typedef struct {
  const gap_flights_t *fit, *held; // held: none: each by turns (by_turns.h)
  const model_t *model;
  const flown_by_t *flown_by; // null: nobody knows
  unsigned long seed;
  void (*progress)(const char *what); // is told what begins; may be null
} diagnose_job_t;

// A name that feedback made: least squares see it, the set points as instruments do not; commands of which
// the log has too few; control that answers a disturbance (own_work.h).
typedef enum { MADE_BY_FEEDBACK, MADE_BY_MISSED_COMMANDS, MADE_BY_NOISE, MADE_BY_CONTROL } maker_t;

typedef struct {
  const fx_t *fx;
  int number; // of its numbers the first that the name is about
  double value;
  confirm_t by_set_points;
  maker_t by;
} refuted_t;

typedef struct {
  set_t fit, held;
  candidates_t candidates;
  nominal_t nominal;
  found_t found;
  const char
      *why_not_confirmed; // why the reference could not be the instrument; null: it was, or is not there
  int rounds;             // times that all columns were formed, by the first look and the last
  withdrawn_list_t withdrawn;
  int n_refuted;
  refuted_t refuted[NAMED_MAX];
  by_turns_t turns; // by which numbers the held-out rows are judged
  model_t extended;
  closed_loop_t loop;
  timing_t timing;                 // of the fitted flights
  chosen_t before;                 // what the last look found, with which the next one begins
  chosen_t flown;                  // what nominal flights had beside the model
  bool nominal_flew;               // false: none could; then names need more evidence and nothing is unknown
  judged_t left;                   // what no name explains
  bool unknown;                    // it is beyond its bound
  for_a_time_t for_a_time;         // what would do for it
  flights_differ_t differ[GROUPS]; // of each group of channels: n 0 where flights do not
  own_t own;                       // of a held-out flight
  held_t held_out;
  double *residual[CHANNELS]; // of the fitted flights, extended model
} diagnosis_t;

// BAD_INPUT: the flights cannot be used; FAILED: no memory. Free after use, also on an error.
MUST_CHECK done_t diagnose(const diagnose_job_t *job, diagnosis_t *d, why_t *why);
void diagnosis_free(diagnosis_t *d);

#endif
