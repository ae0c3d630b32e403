// settings.c - from parameters that are written one by one to sets that are flown as a whole.
#include "settings.h"

#include "glue.h"
#include <stdatomic.h>
#include <string.h>

// --- weights that belong together -------------------------------------------------------------------------

// Each step can be undone, so that one bit more or less always makes another sum.
static uint32_t mix(const rbf_weights_t *weights) {
  uint32_t sum = 0, bits;
  for (int i = 0; i < RBF_N; i++) {
    memcpy(&bits, &weights->w[i], sizeof bits);
    sum = (sum ^ bits) * 0x85ebca6bu; // odd, its bits spread
    sum ^= sum >> 15;
  }
  return sum;
}

bool settings_is_weight(const param_row_t *row) {
  const size_t first = offsetof(flight_param_t, curve.fixed);
  return row->offset >= first && row->offset < first + sizeof(rbf_weights_t);
}

static void make_sum(void) {
  GLUE.weights_sum = GLUE.sum_flown = mix(&GLUE.flown.curve.fixed) ^ GLUE.sum_default;
}

// --- judging ----------------------------------------------------------------------------------------------

static void note(int row) {
  GLUE.put_back[row / 32] |= 1u << (row % 32);
}

// A value out of its range goes back to what flies. Two that contradict each other wait for the next write.
static void mend(void) {
  for (int i = 0; i < params_count; i++) {
    const param_row_t *const row = &params_table[i];
    const float value = params_get(&GLUE.tuned, row);
    if (value >= row->min && value <= row->max) continue;
    (void)!params_set(&GLUE.tuned, row, params_get(&GLUE.flown, row));
    note(i);
  }
}

// A set that passes waits for the next tick, and a commit with it: never one that was written after the
// check.
static bool offer(const rbf_weights_t *weights) {
  GLUE.ready = 0; // a tick may come at any time
  atomic_signal_fence(memory_order_seq_cst);
  GLUE.candidate = GLUE.tuned;
  GLUE.candidate.curve.fixed = *weights;
  GLUE.commit_asked = GLUE.commit;
  if (params_check(&GLUE.candidate) != ST_OK) return false;
  atomic_signal_fence(memory_order_seq_cst);
  GLUE.ready = 1;
  return true;
}

static bool judge(const rbf_weights_t *weights) {
  if (offer(weights)) return true;
  GLUE.sets_refused++;
  mend();
  return false;
}

void settings_touched(void) {
  if (GLUE.shadow > 1) GLUE.shadow = 1;
  GLUE.weights_sum = GLUE.sum_flown; // the app's alone to make
  if (judge(GLUE.commit == COMMIT_TYPED ? &GLUE.tuned.curve.fixed : &GLUE.flown.curve.fixed)) return;
  if (GLUE.commit != 0) GLUE.commits_refused++;
  GLUE.commit = 0;
  (void)!offer(&GLUE.flown.curve.fixed); // what was written before, and did not fly yet
}

// --- start ------------------------------------------------------------------------------------------------

// All weights at once: of a set that was stored in part none is flown.
static void put_weights_back(void) {
  for (int i = 0; i < params_count; i++) {
    const param_row_t *const row = &params_table[i];
    if (settings_is_weight(row) && params_get(&GLUE.tuned, row) != params_get(&GLUE.flown, row)) note(i);
  }
  GLUE.tuned.curve.fixed = GLUE.flown.curve.fixed;
}

void settings_start(void) {
  const bool asked = GLUE.commit == COMMIT_TYPED;
  GLUE.commit = 0;
  if (!GLUE.started) {
    params_default(&GLUE.flown);
    GLUE.sum_default = mix(&GLUE.flown.curve.fixed);
  }
  GLUE.started = 1;
  GLUE.weights_mixed = !asked && (mix(&GLUE.tuned.curve.fixed) ^ GLUE.sum_default) != GLUE.weights_sum;
  if (GLUE.weights_mixed) put_weights_back();
  if (!judge(&GLUE.tuned.curve.fixed) && !offer(&GLUE.tuned.curve.fixed)) GLUE.tuned = GLUE.flown;
  if (GLUE.ready) GLUE.flown = GLUE.candidate;
  GLUE.ready = 0;
  make_sum();
  (void)!flight_init(&GLUE.flight, &GLUE.flown); // a set that passed its checks
}

// --- flying -----------------------------------------------------------------------------------------------

bool settings_learning(void) {
  return GLUE.flown.curve.mode == CURVE_LIVE && !GLUE.in.no_lesson && GLUE.in.setpoint.z != AXIS_OFF;
}

// The candidate's weights: what was typed in, or what was learned.
static bool commit(unsigned which) {
  learn_t *const learn = &GLUE.flight.outer.learn;
  if (settings_learning() || (which != COMMIT_TYPED && which != COMMIT_LEARNED)) return false;
  if (which == COMMIT_LEARNED) GLUE.candidate.curve.fixed = learn->rls.theta;
  if (learn_init(learn, &GLUE.candidate.learn, &GLUE.candidate.curve.fixed) != ST_OK) return false;
  GLUE.tuned.curve.fixed = GLUE.candidate.curve.fixed;
  return true;
}

static void take_commit(unsigned which) {
  if (commit(which)) {
    GLUE.commits++;
    GLUE.recorder.tunes++;
    GLUE.flown.curve.fixed = GLUE.candidate.curve.fixed; // also where another write makes another candidate
    make_sum();
  } else {
    GLUE.commits_refused++;
    GLUE.candidate.curve.fixed = GLUE.flown.curve.fixed;
  }
}

void settings_take(void) {
  const unsigned phase = GLUE.flight.phase; // of the call before
  // A bit that flipped in the parameters would stay for ever.
  if (phase == 5) (void)!flight_tune(&GLUE.flight, &GLUE.flown);
  if (!GLUE.ready || phase % 2 != 0) return; // now comes no inner loop
  if (GLUE.commit_asked != 0) {              // in a tick of its own: both would be too much for one
    take_commit(GLUE.commit_asked);
    GLUE.commit = GLUE.commit_asked = 0;
    return;
  }
  GLUE.ready = 0;
  GLUE.flown = GLUE.candidate;
  GLUE.recorder.tunes++;
  (void)!flight_tune(&GLUE.flight, &GLUE.flown);
}
