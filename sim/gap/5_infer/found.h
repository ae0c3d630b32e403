// found.h - what the selection found: names with their numbers and rivals, what could have been seen.
#ifndef SIM_GAP_5_INFER_FOUND_H
#define SIM_GAP_5_INFER_FOUND_H

#include "gap/5_infer/round.h"
#include "gap/5_infer/timing.h"

// Of the first stage, at least: with less the instrument's own bias counts (Staiger and Stock 1997).
#define CONFIRM_F 10.0

// What the reference trajectory as an instrument says of a name (confirm.h).
typedef enum { CONFIRM_NOT_TRIED, CONFIRM_WEAK, CONFIRM_NO, CONFIRM_YES } confirm_answer_t;

typedef struct {
  confirm_answer_t answer;
  double value[FX_SIZE_MAX], stderr_[FX_SIZE_MAX]; // not where it is weak
  double F;                                        // of the first stage, its weakest number
  double blocks;                                   // that tell of it, as if all told as much
  double p;                                        // of all its numbers together
  double p_apart;                                  // of its distance from least squares (Hausman)
  bool apart;                                      // they differ by more than the errors of both allow
} confirm_t;

typedef struct {
  int candidate;
  double value[FX_SIZE_MAX];
  // The regression's own standard error (robust, blocks of 2 s), and beside it the number's rms error on
  // nominal flights, bias and all, with its shape estimated, too, and half the least lag or delay that is
  // named.
  double stderr_[FX_SIZE_MAX];
  double beside[FX_SIZE_MAX]; // of stderr_, what is not the regression's own
  // Half of the way that it moves, at most, where another name gives its place to a rival (family.h): which
  // of the two is there nobody knows. Part of stderr_ once found_join_rivals has been called.
  double by_rivals[FX_SIZE_MAX];
  double shape_stderr; // of its shape (shape.h); NaN or 0: not known
  double shape_beside; // of it, rms over the shape, what nominal flights show (bend.h)
  double p;            // of the Wald test, all its numbers together
  double probability;  // that it, or a rival that is told, is there (evidence.h); NaN: not computed
  double share;        // of the sum of squares that the original model leaves and the effect explains
  int n_rival;         // family.h
  const fx_t *rival[FX_MAX];
  int rival_candidate[FX_MAX];
  double rival_share[FX_MAX]; // what each would explain in its place
  confirm_t confirm;
  // How much held-out rows have of what it adds to them beside the other names (7_verify). 1: all of it is
  // there; above a half it explains them better. NaN: nothing judges it.
  double held_share;
} named_t;

typedef struct {
  chosen_t chosen; // what the model gets: all that is named, and what is in it without a name
  int n;
  named_t named[NAMED_MAX];
  int rounds;          // times that all columns were formed: the time of a selection goes with it
  const fx_t *aligned; // lag or delay that is in the model without a name; null: none
  double aligned_s;
  double left, left_before; // white sums of squares, with and without what is named
  double *least; // by candidate: the smallest size that would have been seen, over what is typical; 0: none
  int *alike;    // by column: the first of those that these flights would not tell from it, or itself
  bool *echo;    // by candidate: something like it is there, at one place or time only: it was not tried
} found_t;

// Nothing found yet. FAILED: no memory. Free it, also on an error.
MUST_CHECK done_t found_make(found_t *f, const candidates_t *c, why_t *why);
void found_free(found_t *f);

// A name's effect with its numbers.
const fx_use_t *found_use(const found_t *f, const named_t *named);

// Takes the name number i back; the model no longer has it.
void found_withdraw(found_t *f, int i);

// When it is decided what stands: what rivals would make of numbers is an error of them, as half of an
// interval is in both_ways.h. Called once.
void found_join_rivals(found_t *f);

// What a finished selection says: names (their rivals are family.h's), and of each candidate the least that
// could have been seen. f->echo is known already.
void found_describe(found_t *f, const round_t *r, const timing_t *timing);

// The smallest size of an effect that would have been seen, over what is typical: of its shapes the one
// nearest to what is typical, of its rotors the one that shows worst. HUGE_VAL: none would. which (may be
// null): the candidate; a null pointer where no residual depends on it.
double found_least(const found_t *f, const candidates_t *c, const fx_t *fx, const candidate_t **which);

#endif
