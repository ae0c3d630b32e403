// acts_as.h - which effects of the library, alone, would do for what is left on some rows.
//
// No names: nothing is asked of them but how much of the squares they take there, beside what is named.
#ifndef SIM_GAP_5_INFER_ACTS_AS_H
#define SIM_GAP_5_INFER_ACTS_AS_H

#include "gap/4_candidates/candidates.h"
#include "gap/5_infer/whiten.h"

enum { ACTS_AS_MAX = 3 };

typedef struct {
  int candidate;
  fx_use_t use; // with its numbers; of what the model has, the difference
  double share; // of what is left there beyond noise, of the squares: what it takes, at most 1
  double worth; // the same, less what a right form with other numbers leaves for each number more than one
} would_do_t;

typedef struct {
  int n;                         // 0: nothing of the library would do
  would_do_t would[ACTS_AS_MAX]; // one of each effect, the one that is worth most first
} acts_as_t;

// Columns of all candidates and the residual, by their spread alone, and the numbers of what is chosen.
typedef struct {
  gram_t g;
  int n, column[CHOSEN_MAX * FX_SIZE_MAX];
  double b[CHOSEN_MAX * FX_SIZE_MAX];
} remains_t;

// FAILED: no memory. Free it, also on an error.
MUST_CHECK done_t remains_make(remains_t *r, set_t *s, const model_t *base, const candidates_t *c,
                               const chosen_t *chosen, why_t *why);
void remains_free(remains_t *r);
// Sums of products over some rows: the last column, from which what is chosen was taken once more, gets it
// back.
void remains_put_back(const remains_t *r, double *G);

// What a candidate alone takes from such sums G, at numbers that it can have: of what is chosen (else null),
// beside its own. fit: the sums that give these numbers, of all that it acts on.
double acts_takes(const candidate_t *c, const fx_use_t *chosen, const double *fit, const double *G, int size,
                  fx_use_t *use);

// One more that would do: it is worth half of what is there, and no number of it is larger than the
// evidence's prior has it. taken: of `beyond`, both squares.
void acts_add(acts_as_t *to, const candidates_t *c, int candidate, const fx_use_t *use, double taken,
              double beyond);
// Without those that are worth less than the first by a fifth.
void acts_keep_best(acts_as_t *to);

#endif
