// verify.h - held-out flights, before and after the names.
#ifndef SIM_GAP_7_VERIFY_VERIFY_H
#define SIM_GAP_7_VERIFY_VERIFY_H

#include "gap/3_feedback/nominal.h"
#include "gap/5_infer/by_turns.h"
#include "gap/5_infer/found.h"

typedef struct {
  bool used;
  double before, after, floor; // rms of rows; the first two without what each flight has of its own
  double jumps; // share of the changes in what is left that comes by jumps (2_predict/residual.h)
} gap_part_t;

// All held-out flights together.
typedef struct {
  gap_part_t channel[CHANNELS];
  double left_before, left_after; // whitened sums of squares
} held_t;

// A name found in the fitted flights that the held-out ones contradict.
typedef struct {
  const fx_t *fx;
  int candidate;
  int channel;          // that the name grows most, or shrinks least
  double without, with; // rms of that channel in the held-out flights
  bool by_share;        // withdrawn by `share`: no channel grows by more than it may
  // How much the held-out rows show of what the name adds to them: below a half they are explained worse with
  // it. 1: as much as was found, or the errors of the name's inputs make it less.
  double share, stderr_;
} withdrawn_t;

typedef struct {
  int n;
  withdrawn_t name[NAMED_MAX];
} withdrawn_list_t;

// Factor by which a name may at most grow the held-out rms of any channel, beside the other names, where it
// does not shrink the others by twice that (in logarithms). What errors of the name's inputs, such as
// velocities, make of a right name where the vehicle hardly moves does not count: flights of the model along
// the held-out tracks tell it.
#define VERIFY_GROWS 1.05

// How far, by channel and in its unit, a held-out flight's constant may be from that of the fitted ones:
// where these differ, it has something of its own, too. Under each model its own part is the one that leaves
// least, as in that model's likelihood. 0: it has none.
typedef struct {
  double may[CHANNELS];
} own_t;

// Finds where the fitted flights differ beyond their bound (unknown_differ): there another one may differ as
// far as 99 of 100 such flights do (limits_another). m: the model with all that was found, also what is
// withdrawn later; residual: what it leaves of the fitted flights. apart: false: by turns, where each flight
// is one of the fitted and is made level with all. FAILED: no memory.
MUST_CHECK done_t own_find(own_t *own, const set_t *fit, const model_t *m, double *const residual[CHANNELS],
                           const nominal_t *nominal, bool apart, why_t *why);

// What was found, and the flights against which it is held.
typedef struct {
  set_t *held, *fit;
  const model_t *base; // without what was found
  const closed_loop_t *loop;
  found_t *found;
  by_turns_t *turns; // the numbers by which each held-out row is judged
  const own_t *own;
} verify_job_t;

// Finds what the model leaves of every held-out row, without and with what was found. its_own (may be null):
// what was taken out of `after`, of flight f and channel ch [f * CHANNELS + ch]. FAILED: no memory. Free both
// lines, also on an error.
MUST_CHECK done_t verify_lines(const verify_job_t *job, lines_t *before, lines_t *after, double *its_own,
                               why_t *why);

// Measures the held-out flights before and after. FAILED: no memory.
MUST_CHECK done_t verify_held(const verify_job_t *job, const nominal_t *nominal, held_t *held, why_t *why);

// Withdraws the names that grow a channel by more, or of which the rows show less than half while all
// channels together grow, the worst first: they are no longer found. The others keep their values: estimated
// anew, they would take up what the fitted flights alone have. Sets held_share of those that stay. FAILED: no
// memory.
MUST_CHECK done_t verify_names(const verify_job_t *d, withdrawn_list_t *withdrawn, why_t *why);

#endif
