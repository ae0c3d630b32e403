// round.h - a round of the selection: what is chosen, and the white columns of all candidates, formed about
// the chosen numbers.
//
// select.c owns it and is the only one that changes it; the other modules of this folder read it.
#ifndef SIM_GAP_5_INFER_ROUND_H
#define SIM_GAP_5_INFER_ROUND_H

#include "gap/5_infer/score.h"

typedef struct {
  const candidates_t *c;
  set_t *s;
  const model_t *given, *base; // the model; the same with the lag or delay that rotor speeds show
  const nominal_t *nominal;
  const bool *never; // by candidate: it is ruled out
  choice_t choice;   // in the order in which they entered
  chosen_t chosen;   // the same with their numbers, as of the last round_take
  bool strict;       // colours of what the choice leaves, not of what all candidates leave
  bool turning_told; // round_tells_turning(), known once there are nominal flights
  int rounds;        // times that all columns were formed
  design_t table;
  gram_t gram;
  score_t score;
} round_t;

// Forms columns, colours and products about the chosen numbers. FAILED: no memory; then the round is closed.
MUST_CHECK done_t round_open(round_t *r, why_t *why);
// The same for the columns of the choice alone, which its estimates need; nothing else may then be asked of
// the round. Unless strict, the colours stay. FAILED: no memory; then the round is closed.
MUST_CHECK done_t round_renew(round_t *r, why_t *why);
// As round_open(), for a round that is open: forms the columns that have changed.
MUST_CHECK done_t round_complete(round_t *r, why_t *why);
void round_close(round_t *r);

// Moves the numbers of the choice by this share of the way to their present estimates. Returns the longest
// full way, over the typical size.
double round_take(round_t *r, double share);

const fx_t *round_fx(const round_t *r, int candidate);

// Returns the choice with the shapes that leave least (score_left), because what a name is worth beside
// others must not depend on shapes that were found for another choice.
choice_t round_reshaped(const round_t *r, const choice_t *choice);

// Returns what a choice leaves (score_left), plus twice the logarithm of how many forms each of its effects
// has, as if all forms were equally likely. Of choices that leave the same, the one with fewest forms is
// taken: in a log without moments a weak rotor leaves what a thrust scale leaves, but it turns the nominal
// flights, and the log's vehicle was not turned.
double round_left(const round_t *r, const choice_t *choice);

// True if the log tells how strongly commands tilt the vehicle: on nominal flights, what control makes of
// noise looks like less than an inertia of typical size. Mass and thrust scale, which differ in nothing
// else, may then both be named. An inertia about all axes does to the turning nearly what the scale does, so
// it may be their rival then, and their errors hold half of the way to it. Without this condition a real
// vehicle's log (the brushless one's), in which control's work looks like one and a half such inertias, was
// told as twice the thrust and 15 g.
bool round_tells_turning(const round_t *r);

// True if the candidate may stand beside a choice: the choice has room, no other shape of its effect, and no
// other effect of its group where only one is there (lag and delay) or can be told (mass and thrust scale).
bool round_fits(const round_t *r, const choice_t *choice, int candidate);

// True if `other` may stand beside `rest` in place of `own`: it is another effect, not ruled out, and not of
// a group in which the two exclude each other.
bool round_may_stand_for(const round_t *r, const choice_t *rest, int own, int other);

#endif
