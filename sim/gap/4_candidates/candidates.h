// candidates.h - the effects that the model lacks or has with other numbers, and what each would add to every
// residual.
//
// For an effect that the vehicle file has, the numbers of a candidate are differences from the file's.
//
// An effect with a shape (the decay of a ceiling effect, the rotor that is damaged) is a candidate once for
// each form and shape. A column is the derivative of the replay with respect to one number of a candidate.
//
// What may be missing (candidates_t) is made once; what is presently taken to be there (chosen_t) is kept
// apart.
#ifndef SIM_GAP_4_CANDIDATES_CANDIDATES_H
#define SIM_GAP_4_CANDIDATES_CANDIDATES_H

#include "gap/2_predict/predict.h"
#include "gap/2_predict/residual.h"

// Share of what is typical, or of what a name gives, that a right form with other numbers leaves, and that
// linear columns are wrong by.
#define CANDIDATES_MISFIT 0.02

typedef struct {
  fx_use_t use; // with its shape; its sizes are 0
  bool in_file; // the vehicle file has it: its sizes are differences, shape and kind are the file's
  int first, n; // columns: the first, and how many
  // It is about its numbers from..to-1: the columns of the others are empty (fx->size_apart).
  int from, to;
  double typical[FX_SIZE_MAX], step[FX_SIZE_MAX]; // of its numbers, for this vehicle
  double least[FX_SIZE_MAX];  // the least value of each number, by sign and for this vehicle
  int n_shape;                // of its form: values that are tried, 0 or more,
  double shape[FX_SHAPE_MAX]; // for this vehicle's battery
  bool barred;                // ruled out: held-out flights or set points contradict it, or control makes it
} candidate_t;

typedef struct {
  candidate_t *candidate;
  int n, columns;
  double cells; // of the battery, in series
} candidates_t;

#define NAMED_MAX  8
#define CHOSEN_MAX (NAMED_MAX + 1) // and a lag or delay that is too short for a name

// Candidates that are taken to be there, each with its numbers, in the order of the candidates, because
// effects act in order.
typedef struct {
  int n, of[CHOSEN_MAX];
  fx_use_t use[CHOSEN_MAX];
} chosen_t;

// True for the same numbers of the same effect, perhaps in another form, shape or kind: at most one of them
// is there.
bool candidates_exclude(const candidate_t *a, const candidate_t *b);
// Bars a candidate in every form, kind and shape; of one whose shape is a number (which rotor) it alone.
void candidates_bar(candidates_t *c, int candidate);

// Returns its name for people; numbers that an effect has apart (fx->size_apart) have a name of their own.
const char *candidate_name(const candidate_t *c);

// Returns as how many candidates (forms, shapes and kinds) the numbers of this one are tried.
int candidates_of(const candidates_t *c, int candidate);

// Returns why an effect cannot be looked for in these logs at all; null: it can.
const char *candidates_obstacle(const fx_t *fx, const model_t *m, const set_t *s);

// Lists all effects that can be looked for in these logs. FAILED: no memory.
MUST_CHECK done_t candidates_make(candidates_t *c, const model_t *m, const set_t *s, why_t *why);
void candidates_free(candidates_t *c);

// True if commands are logged much more slowly than attitude control gives them. Then the log cannot tell how
// strongly they turn the vehicle, nor inertia from lag, nor mass from thrust scale.
bool candidates_slow(const set_t *s);

// True for a scale of the thrust where only turning is compared: in a log that misses commands these look
// like it, and nothing else tells its size.
bool candidates_by_turning(const fx_t *fx, const set_t *s);

// Returns the size, s, below which a lag or delay is never named: fx->size.least, or one period of the
// slowest log, if that is more. 0 for other effects.
double candidates_least(const fx_t *fx, const set_t *s);

// Returns a chosen candidate with its numbers; null: it is not chosen.
const fx_use_t *chosen_use(const chosen_t *chosen, int candidate);
// The same, to change its numbers. A candidate that is not chosen yet is added with sizes 0; there must be
// room.
fx_use_t *chosen_take(chosen_t *chosen, const candidates_t *c, int candidate);
void chosen_drop(chosen_t *chosen, int candidate);
// True if another model was flown than was found: a name that was flown is not found again, or a shape, lag
// or delay that was found was not flown, or is a tenth or more off. Other sizes do not make another model.
bool chosen_other(const candidates_t *c, const chosen_t *flown, const chosen_t *found);

// True if its shape is one of a few numbers (which rotor) rather than a length between others.
bool candidate_is_numbered(const candidate_t *c);

// True for two kinds of the same effect, or for a lag and a delay: on the same rows each would stand in for
// the other.
static inline bool candidates_alike(const fx_t *a, const fx_t *b) {
  return a == b || (a->group == FX_TIMING && b->group == FX_TIMING);
}

// Gives the candidates the shapes of those that are chosen.
void candidates_reshape(candidates_t *c, const chosen_t *chosen);

// Lists the chosen candidates alone, in their order, each with columns of its own. own: the same choice, by
// their numbers in that list. Free the list. FAILED: no memory.
MUST_CHECK done_t candidates_chosen(candidates_t *names, chosen_t *own, const candidates_t *all,
                                    const chosen_t *chosen, why_t *why);

// Returns value as number k of a candidate, or the nearest that the effect can have.
double candidate_possible(const candidate_t *c, int k, double value);

// Returns an effect with its whole numbers: those of the file (base) plus the differences.
fx_use_t effect_whole(const model_t *base, const fx_use_t *use);

// Makes the model with what is chosen. BAD_INPUT: too many effects.
MUST_CHECK done_t chosen_model(const chosen_t *chosen, const model_t *base, model_t *m, why_t *why);

// with: gets the derivative of a flight's replay, by channel and point, with respect to size k of an effect
// in whole numbers, which the model has or gets. now, base: the model's own replay, kept. step: of that size.
// BAD_INPUT: too many effects.
MUST_CHECK done_t column_differentiate(grid_t *g, const path_t *now, const fx_use_t *use, int k, double step,
                                       double *const base[CHANNELS], double *const with[CHANNELS],
                                       why_t *why);

// Columns and residual by row: x[channel][column], null where the column is zero throughout. The last column
// (number `columns`) is the residual to which the linear contribution of what is chosen is added back, so
// that coefficients are whole values.
typedef struct {
  int columns;
  double **x[CHANNELS];
  chosen_t about; // about whose numbers the columns of the other candidates were formed
  bool *chosen;   // by candidate: it was chosen when its column was formed
} design_t;

// Forms the columns of all candidates about the numbers of those that are chosen. FAILED: no memory.
MUST_CHECK done_t design_make(design_t *t, set_t *s, const model_t *base, const candidates_t *c,
                              const chosen_t *chosen, why_t *why);
// Forms the columns of the chosen candidates about other numbers, and the residual. The other columns stay as
// they are, but with `all` those of candidates that are no longer chosen are formed anew, and all of them
// where the choice has moved so far that it changes them. FAILED: no memory; then the design is empty.
MUST_CHECK done_t design_renew(design_t *t, set_t *s, const model_t *base, const candidates_t *c,
                               const chosen_t *chosen, bool all, why_t *why);
void design_free(design_t *t);

// Adds `times` the linear contribution of the chosen candidates to the residual.
void design_add_chosen(design_t *t, const set_t *s, const candidates_t *c, const chosen_t *chosen,
                       double times);

#endif
