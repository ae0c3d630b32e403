// select_state.h - what the steps of the selection share (5_select.c). Within sim/gap only.
#ifndef GAP_SELECT_STATE_H
#define GAP_SELECT_STATE_H

#include "gap/5_select.h"
#include "gap/score.h"

typedef struct {
  candidates_t *c;
  set_t *s;
  const model_t *base;
  const nominal_t *nominal;
  choice_t choice;
  table_t table;
  gram_t gram;
  judge_t judge;
  bool strict; // colours of what is named alone, not of all candidates
  int *taken;  // by candidate: how often it was taken in
} select_t;

const fx_t *select_fx(const select_t *t, int candidate);

// Whether the candidate may stand beside the choice: not another shape of the same effect, nor another one
// of its class.
bool select_fits(const select_t *t, const choice_t *choice, int candidate);

// Something at one place, time or state explains more than this name does: the name is an echo of it.
// ST_FAILED: no memory.
MUST_CHECK status_t select_is_echo(const select_t *t, int candidate, bool *echo, why_t *why);

// What was named, its rivals, and the least of each candidate that could have been seen.
void select_describe(const select_t *t, found_t *found);

#endif
