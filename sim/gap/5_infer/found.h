// found.h - the result of the selection: names with numbers and rivals, and what could have been seen.
#ifndef SIM_GAP_5_INFER_FOUND_H
#define SIM_GAP_5_INFER_FOUND_H

#include "gap/5_infer/round.h"
#include "gap/5_infer/timing.h"

// Least F of the first stage: with less the instrument's own bias counts (Staiger and Stock 1997).
#define CONFIRM_F 10.0

// What the reference trajectory as an instrument says of a name (confirm.h).
typedef enum { CONFIRM_NOT_TRIED, CONFIRM_WEAK, CONFIRM_NO, CONFIRM_YES } confirm_answer_t;

typedef struct {
  confirm_answer_t answer;
  double value[FX_SIZE_MAX], stderr_[FX_SIZE_MAX]; // not set where it is weak
  double F;                                        // of the first stage, for the weakest number
  double blocks;                                   // how many blocks of equal weight would say as much
  double p;                                        // of the Wald test of all its numbers
  double p_apart;                                  // of its distance from least squares (Hausman's test)
  bool apart; // it differs from least squares by more than both errors allow
} confirm_t;

typedef struct {
  int candidate;
  double value[FX_SIZE_MAX];
  // Standard errors: the regression's own (robust, blocks of 2 s) together with `beside`, which is the
  // number's rms on nominal flights (bias included, shape estimated, too) and half the least lag or delay
  // that is named.
  double stderr_[FX_SIZE_MAX];
  double beside[FX_SIZE_MAX]; // the part of stderr_ that is not the regression's own
  // Half of the furthest that the number moves when a rival takes another name's place (family.h), for nobody
  // knows which of the two is there. Part of stderr_ after found_join_rivals().
  double by_rivals[FX_SIZE_MAX];
  double shape_stderr; // of its shape (shape.h); NaN or 0: not known
  double shape_beside; // its part from nominal flights: rms over the shape (bend.h)
  double p;            // of the Wald test that all its numbers are 0
  double probability;  // that it or one of its rivals is there (evidence.h); NaN: not computed
  double share;        // what it explains of the white sum of squares that the original model leaves
  int n_rival;         // family.h
  const fx_t *rival[FX_MAX];
  int rival_candidate[FX_MAX];
  double rival_share[FX_MAX]; // share that each would explain in its place
  confirm_t confirm;
  // How much held-out rows show of what the name adds to them beside the other names (7_verify). 1: all of
  // it; above a half they are explained better with it. NaN: not judged.
  double held_share;
} named_t;

typedef struct {
  chosen_t chosen; // what the model gets, with a name or without
  int n;
  named_t named[NAMED_MAX];
  int rounds;          // how often all columns were formed: the run time grows with it
  const fx_t *aligned; // lag or delay that is in the model without a name; null: none
  double aligned_s;
  double left, left_before; // white sums of squares, with and without what is named
  double *least; // by candidate: smallest size that would have been seen, over typical; 0: it does not show
  int *alike;    // by column: the first column that these flights would not tell from it, or itself
  bool *echo;    // by candidate: not tried, for something like it acts at one place or time only
} found_t;

// Makes an empty result. FAILED: no memory. Free it, also on an error.
MUST_CHECK done_t found_make(found_t *f, const candidates_t *c, why_t *why);
void found_free(found_t *f);

// Returns a name's effect with its numbers.
const fx_use_t *found_use(const found_t *f, const named_t *named);

// Withdraws name number i; the model no longer has it.
void found_withdraw(found_t *f, int i);

// Adds by_rivals to the standard errors, as both_ways.h adds half of an interval. Call it once, when it is
// decided which names stand.
void found_join_rivals(found_t *f);

// Fills *f from a finished selection: names (family.h adds their rivals), and for each candidate the smallest
// size that would have been seen. f->echo must be set already. FAILED: as evidence_least().
MUST_CHECK done_t found_describe(found_t *f, const round_t *r, const timing_t *timing, why_t *why);

// Returns the smallest size of an effect that would have been seen, over the typical one: of its shapes the
// named one or else the one nearest to the typical one, of its rotors the one that shows worst. HUGE_VAL: no
// size would. which (may be null): the candidate; a null pointer where no residual depends on it.
double found_least(const found_t *f, const candidates_t *c, const fx_t *fx, const candidate_t **which);

#endif
