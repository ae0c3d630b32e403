// settings.c - from parameters that are written one by one to sets that are flown as a whole.
#include "settings.h"

#include "glue.h"
#include <string.h>

void settings_touched(void) {
  GLUE.touched = 1;
}

// A value out of its range goes back to what flies. Two that contradict each other wait for the next write.
static void mend(void) {
  for (int i = 0; i < params_count; i++) {
    const param_row_t *const row = &params_table[i];
    const float value = params_get(&GLUE.tuned, row);
    if (value >= row->min && value <= row->max) continue;
    (void)!params_set(&GLUE.tuned, row, params_get(&GLUE.flown, row));
  }
}

// Flies what is tuned with these weights, or counts and keeps what flew.
static bool take(const rbf_weights_t *weights) {
  GLUE.candidate = GLUE.tuned;
  GLUE.candidate.curve.fixed = *weights;
  if (params_check(&GLUE.candidate) == ST_OK) {
    GLUE.flown = GLUE.candidate;
    return true;
  }
  GLUE.sets_refused++;
  mend();
  return false;
}

void settings_start(void) {
  GLUE.touched = GLUE.commit = 0;
  params_default(&GLUE.flown);
  if (!take(&GLUE.tuned.curve.fixed) && !take(&GLUE.tuned.curve.fixed)) GLUE.tuned = GLUE.flown;
  (void)!flight_init(&GLUE.flight, &GLUE.flown); // a set that passed its checks
}

bool settings_learning(void) {
  return GLUE.flown.curve.mode == CURVE_LIVE && !GLUE.in.no_lesson && GLUE.in.setpoint.z != AXIS_OFF;
}

static bool commit(unsigned which) {
  learn_t *const learn = &GLUE.flight.outer.learn;
  if (settings_learning() || (which != COMMIT_TYPED && which != COMMIT_LEARNED)) return false;
  if (which == COMMIT_LEARNED) GLUE.tuned.curve.fixed = learn->rls.theta;
  if (!take(&GLUE.tuned.curve.fixed)) return false;
  return learn_init(learn, &GLUE.flown.learn, &GLUE.flown.curve.fixed) == ST_OK;
}

void settings_take(void) {
  if (!GLUE.touched) return;
  GLUE.touched = 0;
  if (GLUE.commit != 0) {
    if (commit(GLUE.commit))
      GLUE.commits++;
    else
      GLUE.commits_refused++;
    GLUE.commit = 0;
  }
  (void)take(&GLUE.flown.curve.fixed);
}
