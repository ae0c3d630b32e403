// verify.h - flights that were not fitted to, before and after.
#ifndef SIM_GAP_7_VERIFY_VERIFY_H
#define SIM_GAP_7_VERIFY_VERIFY_H

#include "gap/3_feedback/nominal.h"
#include "gap/5_infer/by_turns.h"
#include "gap/5_infer/found.h"

typedef struct {
  bool used;
  double before, after, floor; // rms of rows; the first two without what a flight has of its own
  double jumps;                // of what is left (2_predict/residual.h)
} gap_part_t;

// Held-out flights, all together.
typedef struct {
  gap_part_t channel[CHANNELS];
  double left_before, left_after; // white sums of squares
} held_t;

// A name of the fitted flights that the held-out ones contradict.
typedef struct {
  const fx_t *fx;
  int candidate;
  int channel;          // that it grows most, or shrinks least
  double without, with; // its held-out rms
  bool by_share;        // that grows by no more than it may, and yet
  // of what the name adds to the held-out rows these have so much: below a half they are explained worse with
  // it. Not where its inputs' own errors make it so. 1: as told.
  double share, stderr_;
} withdrawn_t;

typedef struct {
  int n;
  withdrawn_t name[NAMED_MAX];
} withdrawn_list_t;

// What a name may grow the held-out rms of any channel by, beside the other names, where it does not shrink
// the others by twice that (in logarithms). Not counted is what the errors of what multiplies the name, as
// velocities, make of a right one where the vehicle hardly moves: flights of the model along the held-out
// tracks tell it.
#define VERIFY_GROWS 1.05

// By how much, by channel and in its unit, a held-out flight's constant may be off the fitted ones': it has
// something of its own, too, where they differ. Under each model it has what leaves least, as in the
// likelihood of that model; 0: nothing.
typedef struct {
  double may[CHANNELS];
} own_t;

// m: all that was found, also of what is withdrawn then; residual: what it leaves of the fitted flights. They
// differ beyond their bound (unknown_differ), and another one as 99 of 100 would (limits_another). apart:
// false: by turns, in which each flight is one of them and is made level with all. FAILED: no memory.
MUST_CHECK done_t own_find(own_t *own, const set_t *fit, const model_t *m, double *const residual[CHANNELS],
                           const nominal_t *nominal, bool apart, why_t *why);

// What was found, and the flights that it is held against.
typedef struct {
  set_t *held, *fit;
  const model_t *base; // without what was found
  const closed_loop_t *loop;
  found_t *found;
  by_turns_t *turns; // its numbers for each held-out row
  const own_t *own;
} verify_job_t;

// What the model leaves of every held-out row, without and with what was found; its_own (may be null): what
// was taken out of the latter, of flight f and channel ch [f * CHANNELS + ch]. FAILED: no memory. Free both
// lines, also on an error.
MUST_CHECK done_t verify_lines(const verify_job_t *job, lines_t *before, lines_t *after, double *its_own,
                               why_t *why);

// FAILED: no memory.
MUST_CHECK done_t verify_held(const verify_job_t *job, const nominal_t *nominal, held_t *held, why_t *why);

// Withdraws the names that grow one by more, or of which the rows have less than half while all channels
// together grow, the worst first: they are no longer found. The others keep their values: what these flights
// alone had would else go into them. Of those that stay held_share is known. FAILED: no memory.
MUST_CHECK done_t verify_names(const verify_job_t *d, withdrawn_list_t *withdrawn, why_t *why);

#endif
