// candidates.h - the effects that the model lacks or has with other numbers, and what each would add to every
// residual.
//
// Of an effect that the vehicle file has, the numbers of a candidate are what they differ from the file's.
//
// An effect with a shape (the decay of a ceiling effect, the rotor that is damaged) is a candidate once for
// each shape. A column is the derivative of the replay with respect to one number of a candidate.
//
// What may be missing (candidates_t) is apart from what is presently taken to be (chosen_t): the one is made
// once.
#ifndef SIM_GAP_4_CANDIDATES_CANDIDATES_H
#define SIM_GAP_4_CANDIDATES_CANDIDATES_H

#include "gap/2_predict/predict.h"
#include "gap/2_predict/residual.h"

// Of what is typical, or of what a name gives: what a right form with other numbers beside it leaves, and
// what straight lines are wrong by.
#define CANDIDATES_MISFIT 0.02

typedef struct {
  fx_use_t use; // with its shape; its sizes are 0
  bool in_file; // the vehicle file has it: its sizes are differences, shape and kind the file's
  int first, n; // columns
  // Of its numbers those that it is about: the columns of the others are empty (fx->size_apart).
  int from, to;
  double typical[FX_SIZE_MAX], step[FX_SIZE_MAX]; // of its numbers, for this vehicle
  double least[FX_SIZE_MAX];                      // that its numbers can be, by sign and for this vehicle
  double shape[FX_SHAPE_MAX];                     // that are tried, for this vehicle's battery
  bool barred; // held-out flights or set points contradict it, or control makes it: it is out of question
} candidate_t;

typedef struct {
  candidate_t *candidate;
  int n, columns;
  double cells; // of the battery, in a row
} candidates_t;

#define NAMED_MAX  8
#define CHOSEN_MAX (NAMED_MAX + 1) // with a lag or delay that is too short for a name

// Candidates that are taken to be there, each with its numbers. In the candidates' order: effects act in
// order.
typedef struct {
  int n, of[CHOSEN_MAX];
  fx_use_t use[CHOSEN_MAX];
} chosen_t;

// The same numbers of the same effect, perhaps in another shape or kind: one of them is there at most.
bool candidates_exclude(const candidate_t *a, const candidate_t *b);

// Its name for people: of an effect's numbers that are apart their own.
const char *candidate_name(const candidate_t *c);

// As how many candidates the numbers of one are tried: its shapes and kinds.
int candidates_of(const candidates_t *c, int candidate);

// Why an effect cannot be looked for in these logs at all; a null pointer: it can.
const char *candidates_obstacle(const fx_t *fx, const model_t *m, const set_t *s);

// FAILED: no memory.
MUST_CHECK done_t candidates_make(candidates_t *c, const model_t *m, const set_t *s, why_t *why);
void candidates_free(candidates_t *c);

// Commands are logged much more slowly than attitude control gives them: how strongly they turn the vehicle
// cannot be told, nor inertia from lag, nor mass from thrust scale.
bool candidates_slow(const set_t *s);

// It is a scale of the thrust, of which nothing but turning is compared: of a log that misses commands these
// look like it, and nobody says how large it is otherwise.
bool candidates_by_turning(const fx_t *fx, const set_t *s);

// Of a lag or delay, what is never named: fx->size.least, or one period of the slowest log, whichever is
// more. Of other effects 0.
double candidates_least(const fx_t *fx, const set_t *s);

// A chosen candidate with its numbers; null pointer: it is not chosen.
const fx_use_t *chosen_use(const chosen_t *chosen, int candidate);
// The same, to change its numbers. Where it is not chosen yet, it is now, its sizes 0; there must be room.
fx_use_t *chosen_take(chosen_t *chosen, const candidates_t *c, int candidate);
void chosen_drop(chosen_t *chosen, int candidate);
// Another model was flown than was found: a name that was flown is not found again, or a shape, lag or delay
// that was found was not flown, or is a tenth or more off what was flown. Other sizes are not another model.
bool chosen_other(const candidates_t *c, const chosen_t *flown, const chosen_t *found);

// Its shape is one of a few numbers (which rotor), and not a length between others.
bool candidate_is_numbered(const candidate_t *c);

// Another kind of the same effect, or of a lag a delay: of the same rows each would be the other's stand-in.
static inline bool candidates_alike(const fx_t *a, const fx_t *b) {
  return a == b || (a->group == FX_TIMING && b->group == FX_TIMING);
}

// The candidates get the shapes of those that are chosen.
void candidates_reshape(candidates_t *c, const chosen_t *chosen);

// Those that are chosen alone, each with columns of its own, in their order; own: the same choice by their
// numbers there. Free them. FAILED: no memory.
MUST_CHECK done_t candidates_chosen(candidates_t *names, chosen_t *own, const candidates_t *all,
                                    const chosen_t *chosen, why_t *why);

// Number k of a candidate, or the nearest to it that the effect can have.
double candidate_possible(const candidate_t *c, int k, double value);

// An effect with its whole numbers: what the file has of it (base) and the differences.
fx_use_t effect_whole(const model_t *base, const fx_use_t *use);

// The model with what is chosen. BAD_INPUT: too many effects.
MUST_CHECK done_t chosen_model(const chosen_t *chosen, const model_t *base, model_t *m, why_t *why);

// The derivative of a flight's replay by point with respect to size k of an effect (whole), which the model
// has or gets. now, base: the model's own replay, kept. step: of that size. BAD_INPUT: too many effects.
MUST_CHECK done_t column_differentiate(grid_t *g, const path_t *now, const fx_use_t *use, int k, double step,
                                       double *const base[CHANNELS], double *const with[CHANNELS],
                                       why_t *why);

// Columns and residual by row. x[channel][column]: a null pointer where the column is zero throughout. The
// last column (number `columns`) is the residual with what is chosen taken out again, in the straight line's
// sense, so that coefficients are whole values.
typedef struct {
  int columns;
  double **x[CHANNELS];
  chosen_t about; // about whose numbers the columns of those that are not chosen were formed
  bool *chosen;   // by candidate: its column was formed as that of a chosen one
} design_t;

// Of all candidates, about the numbers of those that are chosen. FAILED: no memory.
MUST_CHECK done_t design_make(design_t *t, set_t *s, const model_t *base, const candidates_t *c,
                              const chosen_t *chosen, why_t *why);
// The columns of the chosen about other numbers, and the residual. The other columns stay as they are; with
// `all` those of candidates that are chosen no more are formed anew, and all where what is chosen has moved
// by so much that it changes them. FAILED: no memory; then it is empty.
MUST_CHECK done_t design_renew(design_t *t, set_t *s, const model_t *base, const candidates_t *c,
                               const chosen_t *chosen, bool all, why_t *why);
void design_free(design_t *t);

// Adds to the residual so many times what the straight line says that the chosen candidates do.
void design_add_chosen(design_t *t, const set_t *s, const candidates_t *c, const chosen_t *chosen,
                       double times);

#endif
