// round.h - a round of the selection: what is chosen, and the columns of all candidates about its numbers,
// white.
//
// select.c owns it and alone changes it; local.h and found.h read it.
#ifndef SIM_GAP_5_INFER_ROUND_H
#define SIM_GAP_5_INFER_ROUND_H

#include "gap/5_infer/score.h"

typedef struct {
  const candidates_t *c;
  set_t *s;
  const model_t *given, *base; // the model; with what measured rotor speeds say of it
  const nominal_t *nominal;
  const bool *never; // by candidate: it is out of question
  choice_t choice;   // in the order in which they entered
  chosen_t chosen;   // the same with their numbers, as of the last round_take
  bool strict;       // colours of what is chosen alone, not of all candidates
  bool turning_told; // round_tells_turning, of a look with nominal flights
  int rounds;        // times that all columns were formed
  design_t table;
  gram_t gram;
  score_t score;
} round_t;

// Forms columns, colours and products about the chosen numbers. FAILED: no memory; then it is closed.
MUST_CHECK done_t round_open(round_t *r, why_t *why);
// The same of the choice alone, by which its numbers are estimated: nothing else may be asked then. Unless
// strict, the colours stay. FAILED: no memory; then it is closed.
MUST_CHECK done_t round_renew(round_t *r, why_t *why);
// As round_open, once it is open: the columns that this changes.
MUST_CHECK done_t round_complete(round_t *r, why_t *why);
void round_close(round_t *r);

// Brings the numbers of the choice by this share of the way to what is estimated now. Returns the largest
// way, in parts of what is typical.
double round_take(round_t *r, double share);

const fx_t *round_fx(const round_t *r, int candidate);

// The choice with the shapes that leave least (score_left): what one name is worth beside others must not
// hang on shapes that were found for another choice.
choice_t round_reshaped(const round_t *r, const choice_t *choice);

// How strongly commands tilt the vehicle can be told, though control makes something of noise, too: on
// nominal flights it looks like less than an inertia of typical size. Then mass and thrust scale may both be
// named, which differ in nothing else. What the scale does to the turning an inertia about all axes does
// nearly as well: it may be their rival then, and their errors hold half of the way to it. A real vehicle's
// log in which it looks like one and a half (the brushless one's) was told as twice the thrust and 15 g.
bool round_tells_turning(const round_t *r);

// Whether the candidate may stand beside a choice: not another shape of the same effect, nor another one of
// its class, of which one alone is there (lag and delay), or can be told (mass and thrust scale).
bool round_fits(const round_t *r, const choice_t *choice, int candidate);

// Another name, and not one of the same class, that may stand beside `rest` in place of `own`.
bool round_may_stand_for(const round_t *r, const choice_t *rest, int own, int other);

#endif
