// score.h - how well a choice of candidates explains the rows, and whether one more is needed.
#ifndef SIM_GAP_5_INFER_SCORE_H
#define SIM_GAP_5_INFER_SCORE_H

#include "gap/5_infer/limits.h"
#include "gap/5_infer/nominal_sums.h"

enum { COLUMN_MAX = CHOSEN_MAX * FX_SIZE_MAX };

// Candidates, by number.
typedef struct {
  int n, of[NAMED_MAX + 1];
} choice_t;

typedef struct {
  const candidates_t *c;
  const gram_t *g;
  const nominal_t *nominal;
  double *ridge;       // by column: keeps what a half-flight does not show near 0
  double *color_ridge; // the same, and at 0 what disturbance cancelled by control looks like
} score_t;

MUST_CHECK done_t score_make(score_t *j, const candidates_t *c, const gram_t *g, const nominal_t *nominal,
                             why_t *why);
void score_free(score_t *j);

// The columns of a choice; returns how many.
int choice_columns(const candidates_t *c, const choice_t *choice, int column[COLUMN_MAX]);
choice_t choice_with(const choice_t *choice, int candidate);
choice_t choice_without(const choice_t *choice, int candidate);
bool choice_has(const choice_t *choice, int candidate);

// Sum of squares left on half-flights that were not fitted to. halves: by half-flight, or null.
double score_left(const score_t *j, const choice_t *choice, double *halves);

// What is right in one group of channels is not wrong in another: the choice `with` leaves more of one of
// them, by a twentieth of it and of what it takes from the others.
bool score_harms(const score_t *j, const choice_t *without, const choice_t *with);

// Sum of squares left where it was fitted.
double score_fitted(const score_t *j, const choice_t *choice);

// The gain from one choice to another, summed over half-flights, stands out from its own ups and downs there.
bool score_is_sure(const score_t *j, const choice_t *worse, const choice_t *better);

// The other choice does as well, within two standard errors: it leaves D more, and D <= SCORE_RIVAL_SPAN d
// where the two fits are d apart, white, because D has a standard error of 2 d; more where nominal flights
// have more than noise along what the fits differ by (score.c).
#define SCORE_RIVAL_SPAN (SCORE_ERRORS * 2.0 * SCORE_CLUSTER)
#define SCORE_RIVAL_LEFT (SCORE_RIVAL_SPAN * SCORE_RIVAL_SPAN) // a fit that lacks D is sqrt(D) apart
// unexplained: what neither explains, in white standard errors; it may prefer the wrong one by 2 d so much.
bool score_is_rival(const score_t *j, const choice_t *own, const choice_t *other, double unexplained);

// The part of what `own` gives in the choice, beyond what all but the last one of `with` could give in its
// place, that the last one could give: 0 to 1.
double score_likeness(const score_t *j, const choice_t *choice, int own, const choice_t *with);

// The part of a column that the candidate alone could give in its place, 0 to 1.
double score_alike(const score_t *j, int column, int candidate);

// Estimates, and their cluster-robust covariance (column by column of the choice; V may be null).
void score_estimate(const score_t *j, const choice_t *choice, double *b, double *V);

// A size on which nothing depends that is compared (a moment about an axis that is left out) is 0, and so is
// its error; of none a p of 1.
typedef struct {
  double value[FX_SIZE_MAX], stderr_[FX_SIZE_MAX], p, over_nominal;
} verdict_t;

// What the last candidate of the choice is worth in it. over_nominal: its size over what could be taken for
// it on nominal flights.
verdict_t score_last(const score_t *j, const choice_t *choice);

// By how much a number may lie beyond what it can be: what the vehicle file has too much of is found with
// errors, and if there is none at all, as often as not at less than none.
static inline double score_margin(const candidate_t *c, double error) {
  return c->in_file ? SCORE_ERRORS * error : 0.0;
}

// It may be in the choice: gates (a), (b), (c).
bool score_allows(const score_t *j, const choice_t *choice, const verdict_t *v);

// The sizes of the choice's last candidate are, within two standard errors, such as the effect can have.
bool score_is_possible(const score_t *j, const choice_t *choice);

// Rms of what n nominal flights make of a number, each counted by what it holds of it (the inverse of the
// number's variance, white; null: all alike). Whom an effect pulls towards a surface comes nearer to it than
// a nominal flight: one that hardly comes there says something of its own noise, not of the log's.
double score_rms(const double *value, const double *holds, int n);

// Rms of a candidate's numbers on nominal flights, given the others of the choice. Where none could be flown,
// feedback is taken to make as much as is never named; 0 for a first look. Gates count all flights alike, as
// many as limits_nominal() is told; an error of the log counts each by what it holds (score_rms).
void score_nominal_error(const score_t *j, const choice_t *choice, double rms[FX_SIZE_MAX]);
void score_nominal_rms(const score_t *j, const choice_t *choice, double rms[FX_SIZE_MAX]);

// Of what nominal flights make of size k of a candidate, what could be taken for it (gate (c)): of a size
// that can only be positive a bias that makes it smaller could not (a height with errors does it to a ground
// effect). Its number is wrong by it all the same: score_nominal_rms has it.
void score_made(const candidate_t *c, int k, double *value, int flights);

// The size of each number of the last candidate that would take so much from the sum of squares; HUGE_VAL:
// none would.
void score_least_gain(const score_t *j, const choice_t *choice, double gain, double size[FX_SIZE_MAX]);

#endif
