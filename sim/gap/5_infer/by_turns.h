// by_turns.h - holds out stretches of each flight, by turns, where no whole flight is held out.
//
// The last third of a lone flight is no fair judge: what was met only there, such as a ceiling, is missing
// from the fit, and what was met only before is not judged. So names and shapes are sought in all rows, and
// each stretch of BLOCK_S is judged by sizes that the rows of the two other turns give. This exposes sizes
// that are only noise. It exposes a choice of names that is only noise less well than unseen flights would.
#ifndef SIM_GAP_5_INFER_BY_TURNS_H
#define SIM_GAP_5_INFER_BY_TURNS_H

#include "gap/5_infer/score.h"
#include "gap/5_infer/timing.h"

// Number of turns: one in three is held out, as one of three flights is. Test:
// gap_turns_are_taken_every_two_seconds
#define TURNS 3

// The numbers that predict the held-out rows, by turn. n 1: the same for all rows, from other flights.
typedef struct {
  int n;
  chosen_t of[TURNS];
} by_turns_t;

// Returns the turn in which a point is held out, 0 to TURNS - 1.
static inline int by_turns_at(const grid_t *g, int point) {
  return set_block_of(g, point) % TURNS;
}

// True if every turn has a whole stretch of some flight, so that something is held out.
bool by_turns_cover(const set_t *s);

// Estimates the numbers of the chosen effects for each turn, by least squares linearised about their present
// values, which all rows gave. What measured rotor speeds gave stays. FAILED: no memory.
MUST_CHECK done_t by_turns_make(by_turns_t *t, const candidates_t *c, set_t *s, const model_t *base,
                                const chosen_t *chosen, const timing_t *timing, why_t *why);

// Sets the sizes of `own` (the candidates of j, in their order) from the blocks of the two other turns. turn:
// that of each block. A ridge keeps near 0 what these blocks do not show. FAILED: no memory.
MUST_CHECK done_t by_turns_estimate(const score_t *j, const int *turn, int held_out, chosen_t *own,
                                    why_t *why);

// Takes a name out of every turn.
void by_turns_drop(by_turns_t *t, int candidate);

#endif
