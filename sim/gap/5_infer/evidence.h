// evidence.h - how probable each set of effects is, given the rows.
//
// Likelihood: white rows, y = X b + e. Prior: an effect's numbers are N(0, s^2), s a half, once, twice or
// four times what is typical, each as likely; one effect in a hundred is there. The numbers also have errors
// of covariance L L' + D. L, of low rank, is what feedback makes of them on nominal flights, with bias and
// correlations. D, diagonal, is the score's fluctuation over blocks beyond white noise, the misfit of a right
// form, the lateness of instruments, and, for effects that control can mimic, what feedback makes of them
// with another pilot. With A = X'X and N = [L, sqrt(D)] the rows' information on the effects is
//
//   F = A - A N (I + N'A N)^-1 N'A,   h = g - A N (I + N'A N)^-1 N'g
//
// where g = X'y, and the evidence of a set S is
//
//   log E(S) = 1/2 h_S' (F_S + P^-1)^-1 h_S - 1/2 log|I + P F_S|,   P: the prior's covariance
#ifndef SIM_GAP_5_INFER_EVIDENCE_H
#define SIM_GAP_5_INFER_EVIDENCE_H

#include "gap/5_infer/round.h"

#define EVIDENCE_DEPTH        NAMED_MAX // most effects of a set
#define EVIDENCE_TYPICAL_MOST 4.0       // times typical: the widest prior; effects rarely exceed it

typedef struct {
  int n, of[EVIDENCE_DEPTH];    // candidates, ascending
  double scale[EVIDENCE_DEPTH]; // prior sd of their numbers, over typical
  double mixed;                 // log of the evidence averaged over scales, over that of the best
  double log;                   // of evidence times prior, over that of the empty set
  double share;                 // posterior probability among all sets found
} evidence_set_t;

typedef struct {
  int n;
  evidence_set_t *set; // the most probable first
} evidence_t;

// Collects the sets that a beam search meets. FAILED: no memory. Free it, also on an error.
MUST_CHECK done_t evidence_make(evidence_t *e, const round_t *r, why_t *why);
void evidence_free(evidence_t *e);

// Sets odds[i], by member of the round's choice: log odds that it is there in any form, given the other
// members. FAILED: no memory.
MUST_CHECK done_t evidence_odds(const round_t *r, double odds[NAMED_MAX], why_t *why);

// Sets least[k], by column: the size, over what is typical, from which on the rows speak for this number
// alone, beside the others of the round's choice; HUGE_VAL: no size would. It asks of each number what
// evidence_odds() asks of an effect of one form and either sign: with a dozen forms that look unlike each
// other it is a fifth too small, of a size that is positive a twentieth too large. FAILED: no memory, or what
// feedback makes has no covariance.
MUST_CHECK done_t evidence_least(const round_t *r, double *least, why_t *why);

// Returns the probability that at least one of these candidates is there, in any form.
double evidence_of(const evidence_t *e, const candidates_t *c, int n, const int *candidate);

// Returns the most probable set with none of these candidates in any form; null: there is none.
const evidence_set_t *evidence_without(const evidence_t *e, const candidates_t *c, int n,
                                       const int *candidate);

// --- its parts --------------------------------------------------------------------------------------------

// F (n x n) and h of all columns, for numbers in units of what is typical.
typedef struct {
  int n;
  double *F, *h;
} information_t;

MUST_CHECK done_t information_make(information_t *f, const round_t *r, why_t *why);
void information_free(information_t *f);

// Returns log E of a set. p: 1 / variance of each column's prior. positive: its number cannot be negative.
double evidence_log(const information_t *f, int n, const int *column, const double *p, const bool *positive);

#endif
