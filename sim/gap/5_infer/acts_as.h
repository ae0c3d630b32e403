// acts_as.h - which single effects of the library would explain what is left on some rows.
//
// They are not names: all that counts is how much of the squares they take there, beside the named effects.
#ifndef SIM_GAP_5_INFER_ACTS_AS_H
#define SIM_GAP_5_INFER_ACTS_AS_H

#include "gap/4_candidates/candidates.h"
#include "gap/5_infer/whiten.h"

enum { ACTS_AS_MAX = 3 };

typedef struct {
  int candidate;
  fx_use_t use; // with its numbers; differences if the model has the effect
  double share; // part of the squares beyond noise there that it takes, at most 1
  double worth; // that part, not capped, less CANDIDATES_MISFIT for each number beyond the first
} would_do_t;

typedef struct {
  int n;                         // 0: no effect of the library would do
  would_do_t would[ACTS_AS_MAX]; // one per effect, the largest worth first
} acts_as_t;

// Sums of products of all candidates' columns and the residual, scaled by spread alone (not whitened), and
// the numbers of the chosen effects.
typedef struct {
  gram_t g;
  int n, column[CHOSEN_MAX * FX_SIZE_MAX];
  double b[CHOSEN_MAX * FX_SIZE_MAX];
} remains_t;

// FAILED: no memory. Free it, also on an error.
MUST_CHECK done_t remains_make(remains_t *r, set_t *s, const model_t *base, const candidates_t *c,
                               const chosen_t *chosen, why_t *why);
void remains_free(remains_t *r);
// Puts the chosen effects back: in G, sums of products over some rows, the residual is that of the model
// without them (design_t), and afterwards that of the model with them.
void remains_put_back(const remains_t *r, double *G);

// Returns the squares that a candidate alone takes from such sums G. use: gets its numbers, fitted to the
// sums `fit` (of all that it acts on) and limited to possible ones. chosen: its present numbers if it is
// chosen, to which these add; else null.
double acts_takes(const candidate_t *c, const fx_use_t *chosen, const double *fit, const double *G, int size,
                  fx_use_t *use);

// Adds a candidate that is not barred, is worth SCORE_MOST or more, and has no number beyond the evidence's
// widest prior. taken: the squares that it takes, beyond: all squares beyond noise.
void acts_add(acts_as_t *to, const candidates_t *c, int candidate, const fx_use_t *use, double taken,
              double beyond);
// Drops entries that are worth less than the first by more than a fifth (UNKNOWN_TIE).
void acts_keep_best(acts_as_t *to);

#endif
