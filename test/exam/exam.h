// exam.h - the hidden-effect exam: random data sets, diagnosed without a look at the truth, then marked.
#ifndef TEST_EXAM_EXAM_H
#define TEST_EXAM_EXAM_H

#include "exam/flights.h"
#include "exam/reliability.h"
#include "exam/truth.h"
#include "gap/diagnose.h"

#define EXAM_FIT 3 // flights to fit; one more is held out

// A number of a hidden effect in a form of sim/effects that was named, and what was said of it.
typedef struct {
  const char *name, *param;
  double truth, value, stderr_;
} exam_value_t;

#define EXAM_VALUES (2 * FX_SIZE_MAX)
#define EXAM_WITHIN 2.0 // standard errors: what the truth is to lie within, in 95 of 100

typedef enum { EXAM_NOTHING, EXAM_ONE, EXAM_TWO, EXAM_STRANGE, EXAM_HOVER, EXAM_KINDS } exam_kind_t;

// One data set, and how it was answered.
typedef struct {
  exam_kind_t kind;
  bool own_form, flew;
  int drawn_again; // so often: the vehicle could not fly with what was hidden
  int n;           // hidden
  const char *hidden[2];
  double times[2];
  strange_t strange;
  // marks
  int found, wrong;     // of the hidden ones; names that are none of them
  bool exact;           // every hidden one, and nothing else
  bool rival_held[2];   // found, or among the rivals of a name
  reliability_t stated; // of the names: right if it, or a rival that is told, is hidden
  bool unknown, unknown_right;
  cell_t cell;            // of what has no name
  double least[2];        // smallest size told, over the exam's typical one
  bool says_not_testable; // of a hidden effect that was not named: typical ones are not, or none of its size
  bool shrink_known;      // the held-out flight has rows to compare
  double after, oracle;   // white sums of squares left on it, over that before; 0 if not known
  char answer[160];
  int n_value;
  exam_value_t value[EXAM_VALUES];
} exam_set_t;

// Makes, diagnoses and marks set `seed` of a kind. FAILED: no memory.
MUST_CHECK done_t exam_one(exam_kind_t kind, unsigned long seed, exam_set_t *set, why_t *why);

// The truth lies within EXAM_WITHIN standard errors.
bool exam_holds(const exam_value_t *v);

// White sums of squares become shares of `before`. False: a held-out flight without rows (all of them cut
// off, or saturated) tells nothing; both are 0 then.
bool exam_shrink(double before, double *after, double *oracle);

// The kind of set number i in a reported exam.
exam_kind_t exam_kind(int i);

#endif
