// diagnose.h - the workflow on flights in memory: stages 2 to 5, and 7.
#ifndef SIM_GAP_DIAGNOSE_H
#define SIM_GAP_DIAGNOSE_H

#include "gap/5_infer/flights_differ.h"
#include "gap/5_infer/for_a_time.h"
#include "gap/5_infer/unknown.h"
#include "gap/7_verify/verify.h"

typedef struct {
  const gap_flights_t *fit, *held; // held: null or empty: each flight by turns (by_turns.h)
  const model_t *model;
  const flown_by_t *flown_by; // null: not known
  unsigned long seed;
  void (*progress)(const char *what); // is told what begins; may be null
} diagnose_job_t;

// What made a name that is refuted: feedback (least squares see it, the set points as instruments do not),
// commands that the log misses, noise that is fed back, or control that answers a disturbance (own_work.h).
typedef enum { MADE_BY_FEEDBACK, MADE_BY_MISSED_COMMANDS, MADE_BY_NOISE, MADE_BY_CONTROL } maker_t;

typedef struct {
  const fx_t *fx;
  int number; // the first of its numbers that the name is about
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
      *why_not_confirmed; // why set points could not be the instrument; null: they were, or there are none
  int rounds;             // times that all columns were formed, by all looks
  withdrawn_list_t withdrawn;
  int n_refuted;
  refuted_t refuted[NAMED_MAX];
  by_turns_t turns; // numbers by which the held-out rows are judged
  model_t extended;
  closed_loop_t loop;
  timing_t timing;         // of the fitted flights
  chosen_t before;         // what the last look found: the next one begins with it
  chosen_t flown;          // what nominal flights had besides the model
  bool nominal_flew;       // false: none could fly; then names need more evidence and nothing is unknown
  judged_t left;           // what no name explains
  bool unknown;            // what is left is beyond its bound
  for_a_time_t for_a_time; // effects that would do for it, for a time
  flights_differ_t differ[GROUPS]; // by group of channels; n 0 where flights do not differ
  own_t own;                       // what a held-out flight may have of its own
  held_t held_out;
  double *residual[CHANNELS]; // what the extended model leaves of the fitted flights
} diagnosis_t;

// Runs the stages. BAD_INPUT: the flights cannot be used; FAILED: no memory. Free after use, also on an
// error.
MUST_CHECK done_t diagnose(const diagnose_job_t *job, diagnosis_t *d, why_t *why);
void diagnosis_free(diagnosis_t *d);

#endif
