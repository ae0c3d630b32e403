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
  double *color_ridge; // the same, and holds at 0 what a disturbance that control cancels looks like
} score_t;

// FAILED: no memory.
MUST_CHECK done_t score_make(score_t *j, const candidates_t *c, const gram_t *g, const nominal_t *nominal,
                             why_t *why);
void score_free(score_t *j);

// Lists the columns of a choice; returns how many.
int choice_columns(const candidates_t *c, const choice_t *choice, int column[COLUMN_MAX]);
choice_t choice_with(const choice_t *choice, int candidate);
choice_t choice_without(const choice_t *choice, int candidate);
bool choice_has(const choice_t *choice, int candidate);

// Returns the sum of squares left on half-flights that were not fitted to. halves: by half-flight, or null.
double score_left(const score_t *j, const choice_t *choice, double *halves);

// True if the choice `with` leaves more of some group of channels, by more than chance (SELECT_ALPHA) and a
// twentieth of it and of what it takes from the others (HARM): what is right in one group is not wrong in
// another.
bool score_harms(const score_t *j, const choice_t *without, const choice_t *with);

// Returns the sum of squares left on the rows to which the choice is fitted.
double score_fitted(const score_t *j, const choice_t *choice);

// True if the gain from one choice to the other, summed over half-flights, exceeds its scatter between them
// (SELECT_SURE).
bool score_is_sure(const score_t *j, const choice_t *worse, const choice_t *better);

// The other choice does as well, within two standard errors, if it leaves D more and D is below
// SCORE_RIVAL_SPAN d, where the white fits are d apart, because D has a standard error of 2 d. The span is
// larger where nominal flights have more than noise along the difference of the fits (score.c).
#define SCORE_RIVAL_SPAN (SCORE_ERRORS * 2.0 * SCORE_CLUSTER)
#define SCORE_RIVAL_LEFT (SCORE_RIVAL_SPAN * SCORE_RIVAL_SPAN) // a fit that lacks D is sqrt(D) apart
// True if the other choice does as well. unexplained: what neither choice explains, in white standard
// errors; it may favour the wrong choice by 2 d times as much.
bool score_is_rival(const score_t *j, const choice_t *own, const choice_t *other, double unexplained);

// Returns the part, 0 to 1, of what `own` gives in the choice that the last candidate of `with` could give
// in its place. What the other candidates of `with` could give does not count.
double score_likeness(const score_t *j, const choice_t *choice, int own, const choice_t *with);

// Returns the part, 0 to 1, of a column that the candidate alone could give in its place.
double score_alike(const score_t *j, int column, int candidate);

// Estimates the numbers b of a choice and their cluster-robust covariance V (may be null), by its columns.
void score_estimate(const score_t *j, const choice_t *choice, double *b, double *V);

// A size that shows in no compared channel (a moment about an axis that is left out) is 0, and so is its
// error; if no size shows, p is 1.
typedef struct {
  double value[FX_SIZE_MAX], stderr_[FX_SIZE_MAX], p, over_nominal;
} verdict_t;

// Judges the last candidate of the choice beside the others. over_nominal: its size over the bound of
// what nominal flights that would show it make that could be taken for it; above 1 it passes gate (c).
verdict_t score_last(const score_t *j, const choice_t *choice);

// Returns by how much a number may lie beyond what is possible: if the vehicle does not have an effect of
// the vehicle file at all, errors of its estimate make it less than none as often as not.
static inline double score_margin(const candidate_t *c, double error) {
  return c->in_file ? SCORE_ERRORS * error : 0.0;
}

// True if the last candidate, with this verdict, passes gates (a), (b) and (c) of select.h.
bool score_allows(const score_t *j, const choice_t *choice, const verdict_t *v);

// True if the effect can have the sizes of the choice's last candidate, within two standard errors.
bool score_is_possible(const score_t *j, const choice_t *choice);

// Returns the rms of what n nominal flights make of a number, each weighted by the information that it holds
// about the number (1 / variance, white; null: all alike). An effect may pull the log's vehicle nearer to a
// surface than nominal flights come, and a nominal flight that hardly comes there tells of its own noise,
// not of the log's.
double score_rms(const double *value, const double *holds, int n);

// Both set the rms of the last candidate's numbers on nominal flights, beside the others of the choice.
// Where none could be flown, feedback is taken to make as much as is never named (SELECT_LEAST); 0 in a
// first look. score_nominal_rms() counts all flights alike, as many as limits_nominal() is told, and is for
// what would have been seen; score_nominal_error() weights each by what it holds (score_rms), and is for
// errors of the log's numbers.
void score_nominal_error(const score_t *j, const choice_t *choice, double rms[FX_SIZE_MAX]);
void score_nominal_rms(const score_t *j, const choice_t *choice, double rms[FX_SIZE_MAX]);

// Takes out of `value`, what nominal flights make of size k of a candidate, what could not be taken for it
// (gate (c)): from a size that can only be positive, a bias that makes it smaller (as errors of the height
// do to a ground effect). The number is wrong by it all the same: score_nominal_rms() has it.
void score_made(const candidate_t *c, int k, double *value, int flights);

// Sets the size of each number of the last candidate that would take `gain` from the sum of squares;
// HUGE_VAL: none would.
void score_least_gain(const score_t *j, const choice_t *choice, double gain, double size[FX_SIZE_MAX]);

#endif
