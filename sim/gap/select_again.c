// select_again.c - after names were taken back: what is left, estimated anew.
#include "gap/select_state.h"
#include <stdlib.h>

status_t select_room(select_t *t, found_t *found, why_t *why) {
  const size_t n = (size_t)t->c->n + 1;
  if (!found->least) found->least = calloc(n, sizeof(double));
  if (!found->echo) found->echo = calloc(n, sizeof(bool));
  t->taken = calloc(n, sizeof(int));
  t->never = calloc(n, sizeof(bool));
  return found->least && found->echo && t->taken && t->never ? ST_OK : error_failed(why, "out of memory");
}

// A lag or delay by rotor speeds stays as it is; what else is marked is chosen.
static void take_marked(select_t *t, const found_t *found) {
  const bool by_speeds = select_has_speeds(t->s);
  for (int i = 0; i < found->n && by_speeds; i++) {
    const named_t *const named = &found->named[i];
    if (select_fx(t, named->candidate)->class != FX_TIMING) continue;
    t->timing = named->candidate;
    t->timing_s = named->value[0];
    t->timing_stderr_s = named->stderr_[0];
    t->timing_p = named->p;
    t->c->candidate[t->timing].named = false; // it is in the base
  }
  for (int i = 0; i < t->c->n; i++) {
    if (found->echo[i]) t->taken[i] = TAKES;
    t->never[i] = by_speeds && select_fx(t, i)->class == FX_TIMING;
    if (t->c->candidate[i].named) t->choice = choice_with(&t->choice, i);
  }
}

static status_t estimate(select_t *t, found_t *found, why_t *why) {
  take_marked(t, found);
  TRY(select_take_timing(t, why));
  TRY(select_open_round(t, why));
  status_t status = select_settle(t, why);
  while (status == ST_OK && select_prune_one(t)) status = select_settle(t, why);
  if (status != ST_OK) return status;
  found->n = 0;
  found->aligned_s = 0.0;
  select_describe(t, found);
  select_close_round(t);
  return ST_OK;
}

status_t select_again(candidates_t *c, set_t *s, const model_t *base, const nominal_t *nominal,
                      found_t *found, why_t *why) {
  select_t t = {
      .c = c, .s = s, .given = base, .base = base, .nominal = nominal, .timing = -1, .strict = true};
  status_t status = select_room(&t, found, why);
  if (status == ST_OK) status = estimate(&t, found, why);
  free(t.taken);
  free(t.never);
  return status;
}
