// exam.h - the hidden-effect exam: random data sets, diagnosed without knowledge of the truth, then marked.
#ifndef TEST_EXAM_EXAM_H
#define TEST_EXAM_EXAM_H

#include "exam/flights.h"
#include "exam/reliability.h"
#include "exam/truth.h"
#include "gap/diagnose.h"

#define EXAM_FIT 3 // flights to fit; one more is held out

// A number of a hidden effect (in a form of sim/effects) that was named: the truth, and what was answered.
typedef struct {
  const char *name, *param;
  double truth, value, stderr_;
} exam_value_t;

#define EXAM_VALUES (2 * FX_SIZE_MAX)
#define EXAM_WITHIN 2.0 // standard errors: the truth is to lie within them in 95 of 100

typedef enum { EXAM_NOTHING, EXAM_ONE, EXAM_TWO, EXAM_STRANGE, EXAM_HOVER, EXAM_KINDS } exam_kind_t;

// One data set, the answer, and its marks.
typedef struct {
  exam_kind_t kind;
  bool own_form, flew;
  int drawn_again; // how often it was drawn anew because the vehicle could not fly with what was hidden
  int n;           // number of hidden effects
  const char *hidden[2];
  double times[2];
  strange_t strange;
  // marks
  int found, wrong;     // of the hidden ones; names that are not hidden
  bool exact;           // every hidden one, and nothing else
  bool rival_held[2];   // named, or among the rivals of a name
  reliability_t stated; // of the names; right: the name, or a rival that is told, is hidden
  bool unknown, unknown_right;
  cell_t cell;            // where and in what something without a name was found
  double least[2];        // smallest visible size that was told, over the exam's typical one
  bool says_not_testable; // the answer says that a hidden effect's typical or true size cannot be seen
  bool shrink_known;      // the held-out flight has rows to compare
  double after, oracle;   // whitened sums of squares left on it, over that before; 0 if not known
  char answer[160];
  int n_value;
  exam_value_t value[EXAM_VALUES];
} exam_set_t;

// Makes, diagnoses and marks set `seed` of a kind. FAILED: no memory.
MUST_CHECK done_t exam_one(exam_kind_t kind, unsigned long seed, exam_set_t *set, why_t *why);

// True if the truth lies within EXAM_WITHIN standard errors.
bool exam_holds(const exam_value_t *v);

// Divides the whitened sums of squares `after` and `oracle` by `before`. False: the held-out flight has no
// rows (all cut off or saturated); both are 0 then.
bool exam_shrink(double before, double *after, double *oracle);

// The kind of set number i in a reported exam.
exam_kind_t exam_kind(int i);

#endif
