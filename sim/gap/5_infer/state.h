// state.h - what the steps of the selection share (select.c). Within sim/gap only.
#ifndef SIM_GAP_5_INFER_STATE_H
#define SIM_GAP_5_INFER_STATE_H

#include "gap/5_infer/found.h"
#include "gap/5_infer/score.h"
#include <string.h>

#define TAKES 2 // what was taken out as often as this does not come back

typedef struct {
  candidates_t *c;
  set_t *s;
  const model_t *given, *base; // the model; with what measured rotor speeds say of it
  const nominal_t *nominal;
  choice_t choice;
  table_t table;
  gram_t gram;
  judge_t judge;
  int rounds;  // times that the columns were formed
  bool strict; // colours of what is named alone, not of all candidates
  int *taken;  // by candidate: how often it was taken in
  bool *never; // by candidate: it is out of question
  // What measured rotor speeds say of lag or delay: a candidate beside the choice, in the base; below 0:
  // nothing.
  int timing;
  double timing_s, timing_stderr_s, timing_p;
  model_t own_base; // with it
} select_t;

const fx_t *select_fx(const select_t *t, int candidate);

// Whether the candidate may stand beside the choice: not another shape of the same effect, nor another one
// of its class.
bool select_fits(const select_t *t, const choice_t *choice, int candidate);

// Starts the choice with a lag or a delay, if there is a long one; which of the two it is stays so.
MUST_CHECK done_t select_timing(select_t *t, why_t *why);

// The same by measured rotor speeds. known: there are some; then nothing else has a say in it.
MUST_CHECK done_t select_speeds(select_t *t, bool *known, why_t *why);

// Something at one place, time or state explains more than this name does: the name is an echo of it.
// FAILED: no memory.
MUST_CHECK done_t select_is_echo(const select_t *t, int candidate, bool *echo, why_t *why);

// The name is needed in one range of place, height or time only. FAILED: no memory.
MUST_CHECK done_t select_is_confined(const select_t *t, int candidate, bool *is, why_t *why);

// Takes what would stand for the candidate, white or as a plain mean, out of question until it is searched
// anew. FAILED: no memory.
MUST_CHECK done_t select_forbid_alike(select_t *t, int candidate, why_t *why);

// Moves a name, one at most, to found->open: another one does as well within two standard errors, and nearly
// all that it does the other could do. False: none is so.
bool select_drop_open(select_t *t, found_t *found);

#define SELECT_SAME 0.997 // of a name's contribution, that a rival could give

// Another name, and not one of the same class, that may stand in the choice in place of `own`.
bool select_may_stand_for(const select_t *t, const choice_t *rest, int own, int other);

// found->least and found->echo, by candidate.
void select_find_least(const select_t *t, found_t *found);

// What was named, its rivals, and the least of each candidate that could have been seen.
void select_describe(const select_t *t, found_t *found);

#endif
