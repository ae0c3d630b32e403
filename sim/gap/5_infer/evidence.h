// evidence.h - which sets of effects the rows speak for, each with its probability.
//
// One likelihood: white rows, y = X b + e. One prior: of an effect's numbers N(0, s^2), s a half, once, twice
// or four times what is typical, each as likely; one effect in a hundred is there. What is known of b beside
// it is a covariance of all of them: what feedback makes of each on nominal flights (low rank, with their
// correlations and bias), what the score's own ups and downs over blocks have beyond white noise, the misfit
// of a right form, and, of what control commands, how much feedback makes of it with another pilot (all
// diagonal). With A = X'X, N = [L, sqrt(D)] the rows hold
//
//   F = A - A N (I + N'A N)^-1 N'A,   h = g - A N (I + N'A N)^-1 N'g
//
// of what acts, and of a set S
//
//   log E(S) = 1/2 h_S' (F_S + P^-1)^-1 h_S - 1/2 log|I + P F_S|
#ifndef SIM_GAP_5_INFER_EVIDENCE_H
#define SIM_GAP_5_INFER_EVIDENCE_H

#include "gap/5_infer/round.h"

#define EVIDENCE_DEPTH        NAMED_MAX // effects of a set, at most
#define EVIDENCE_TYPICAL_MOST 4.0       // of what is typical: the widest prior; effects are rarely beyond it

typedef struct {
  int n, of[EVIDENCE_DEPTH];    // candidates, in their order
  double scale[EVIDENCE_DEPTH]; // of their numbers, over what is typical
  double mixed;                 // logarithm of how much all scales together fall behind the best ones
  double log;                   // of evidence times prior, over that of nothing
  double share;                 // of all sets' together
} evidence_set_t;

typedef struct {
  int n;
  evidence_set_t *set; // the most likely first
} evidence_t;

// All sets that a beam over them meets. FAILED: no memory. Free it, also on an error.
MUST_CHECK done_t evidence_make(evidence_t *e, const round_t *r, why_t *why);
void evidence_free(evidence_t *e);

// By how much (logarithm) a choice is more likely with its member number i, in any form, than without it,
// beside the others. FAILED: no memory.
MUST_CHECK done_t evidence_odds(const round_t *r, double odds[NAMED_MAX], why_t *why);

// The probability that one of these candidates is there, in any shape.
double evidence_of(const evidence_t *e, const candidates_t *c, int n, const int *candidate);

// The likeliest set that has none of these; null: there is none.
const evidence_set_t *evidence_without(const evidence_t *e, const candidates_t *c, int n,
                                       const int *candidate);

// --- its parts --------------------------------------------------------------------------------------------

// F and h of `n` columns, in parts of what is typical.
typedef struct {
  int n;
  double *F, *h;
} information_t;

MUST_CHECK done_t information_make(information_t *f, const round_t *r, why_t *why);
void information_free(information_t *f);

// log E of a set about F and h; p: 1 / variance of each column's prior, positive: it cannot be negative.
double evidence_log(const information_t *f, int n, const int *column, const double *p, const bool *positive);

#endif
