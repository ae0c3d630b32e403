// score.h - how well a choice of candidates explains the rows, and whether one more is needed.
#ifndef SIM_GAP_5_INFER_SCORE_H
#define SIM_GAP_5_INFER_SCORE_H

#include "gap/5_infer/found.h"

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
} judge_t;

MUST_CHECK done_t judge_make(judge_t *j, const candidates_t *c, const gram_t *g, const nominal_t *nominal,
                             why_t *why);
void judge_free(judge_t *j);

// The columns of a choice; returns how many.
int choice_columns(const candidates_t *c, const choice_t *choice, int column[COLUMN_MAX]);
choice_t choice_with(const choice_t *choice, int candidate);
choice_t choice_without(const choice_t *choice, int candidate);
bool choice_has(const choice_t *choice, int candidate);

// Sum of squares left on half-flights that were not fitted to. halves: by half-flight, or null.
double judge_left(const judge_t *j, const choice_t *choice, double *halves);

// What is right in one group of channels is not wrong in another: the choice `with` leaves more of one of
// them.
bool judge_harms(const judge_t *j, const choice_t *without, const choice_t *with);

// Sum of squares left where it was fitted.
double judge_fitted(const judge_t *j, const choice_t *choice);

// The gain from one choice to another, summed over half-flights, stands out from its own ups and downs there.
bool judge_is_sure(const judge_t *j, const choice_t *worse, const choice_t *better);

// The other choice does as well, within two standard errors: it leaves D more, and D <= JUDGE_RIVAL_SPAN d
// where the two fits are d apart, white, because D has a standard error of 2 d.
#define JUDGE_CLUSTER    1.5 // standard errors grow by this: white rows are not quite independent
#define JUDGE_RIVAL_SPAN (2.0 * 2.0 * JUDGE_CLUSTER)
#define JUDGE_RIVAL_LEFT (JUDGE_RIVAL_SPAN * JUDGE_RIVAL_SPAN) // a fit that lacks D is sqrt(D) apart
bool judge_is_rival(const judge_t *j, const choice_t *own, const choice_t *other);

// The part of what `own` gives in the choice that `other` alone could give in its place, 0 to 1.
double judge_likeness(const judge_t *j, const choice_t *choice, int own, int other);

// The part of a column that the candidate alone could give in its place, 0 to 1.
double judge_alike(const judge_t *j, int column, int candidate);

// Estimates, and their cluster-robust covariance (column by column of the choice; V may be null).
void judge_estimate(const judge_t *j, const choice_t *choice, double *b, double *V);

typedef struct {
  double value[FX_SIZE_MAX], stderr_[FX_SIZE_MAX], p, over_nominal;
} verdict_t;

// What the last candidate of the choice is worth in it. over_nominal: its size over its rms on nominal
// flights.
verdict_t judge_last(const judge_t *j, const choice_t *choice);

// It may be in the choice: gates (a), (b), (c).
bool judge_allows(const judge_t *j, const choice_t *choice, const verdict_t *v);

// The sizes of the choice's last candidate are, within two standard errors, such as the effect can have.
bool judge_is_possible(const judge_t *j, const choice_t *choice);

// Rms of a candidate's numbers on nominal flights, given the others of the choice; 0 without such flights.
void judge_nominal_rms(const judge_t *j, const choice_t *choice, double rms[FX_SIZE_MAX]);

// The size of each number of the last candidate that would take so much from the sum of squares; HUGE_VAL:
// none would.
void judge_least_gain(const judge_t *j, const choice_t *choice, double gain, double size[FX_SIZE_MAX]);

#endif
