// by_turns.h - what is held out where no flight is: stretches of each flight, by turns.
//
// The last third of a lone flight is no fair judge: what was met there alone, as a ceiling, is not in what is
// fitted, and what was met before alone is not judged. So names and shapes are sought in all rows, and each
// stretch of BLOCK_S is held against sizes that the rows of the two other turns give. A size that noise made
// is seen so; a choice that noise made, less than by flights of which nothing was seen.
#ifndef SIM_GAP_5_INFER_BY_TURNS_H
#define SIM_GAP_5_INFER_BY_TURNS_H

#include "gap/5_infer/score.h"
#include "gap/5_infer/timing.h"

// Of stretches, no unit: as of three flights one is held out. gap_turns_are_taken_every_two_seconds
#define TURNS 3

// The numbers by which held-out rows are predicted, by turn. n 1: the same for all, other flights gave them.
typedef struct {
  int n;
  chosen_t of[TURNS];
} by_turns_t;

// Whose turn it is to be held out.
static inline int by_turns_at(const grid_t *g, int point) {
  return set_block_of(g, point) % TURNS;
}

// Whether every turn has a whole stretch, so that something is held out.
bool by_turns_cover(const set_t *s);

// Numbers of what is chosen, by least squares about those that it has, which all rows gave; what measured
// rotor speeds say stays. FAILED: no memory.
MUST_CHECK done_t by_turns_make(by_turns_t *t, const candidates_t *c, set_t *s, const model_t *base,
                                const chosen_t *chosen, const timing_t *timing, why_t *why);

// Sizes of `own`, the candidates of j in their order, by what the blocks of the two other turns hold; turn:
// of each block. A ridge keeps near 0 what these do not show. FAILED: no memory.
MUST_CHECK done_t by_turns_estimate(const score_t *j, const int *turn, int held_out, chosen_t *own,
                                    why_t *why);

// Takes a name out of every turn.
void by_turns_drop(by_turns_t *t, int candidate);

#endif
