// settings.c - from parameters that are written one by one to sets that are flown as a whole.
#include "settings.h"

#include "glue.h"
#include <stdatomic.h>
#include <string.h>

// --- weights that belong together -------------------------------------------------------------------------

// Copies the weights of both curves.
static void put_weights(flight_param_t *to, const flight_param_t *from) {
  to->curve.fixed = from->curve.fixed;
  to->ground.fixed = from->ground.fixed;
}

// Each step is invertible, so that a single changed bit always changes the sum.
static uint32_t mix(const rbf_weights_t *weights, uint32_t sum) {
  uint32_t bits;
  for (int i = 0; i < RBF_N; i++) {
    memcpy(&bits, &weights->w[i], sizeof bits);
    sum = (sum ^ bits) * 0x85ebca6bu; // odd, with spread bits
    sum ^= sum >> 15;
  }
  return sum;
}

// The curves begin with different sums, so that exchanging them changes the result.
static uint32_t sum_of(const flight_param_t *p) {
  return mix(&p->curve.fixed, 0u) ^ mix(&p->ground.fixed, 1u);
}

static bool is_in(const param_row_t *row, size_t first) {
  return row->offset >= first && row->offset < first + sizeof(rbf_weights_t);
}

bool settings_is_weight(const param_row_t *row) {
  return is_in(row, offsetof(flight_param_t, curve.fixed)) ||
         is_in(row, offsetof(flight_param_t, ground.fixed));
}

static void make_sum(void) {
  GLUE.weights_sum = GLUE.sum_flown = sum_of(&GLUE.flown) ^ GLUE.sum_default;
}

// --- judging ----------------------------------------------------------------------------------------------

static void note(int row) {
  GLUE.put_back[row / 32] |= 1u << (row % 32);
}

// Puts values out of their range back to those that fly. Two that contradict each other wait for a write.
static void mend(void) {
  for (int i = 0; i < params_count; i++) {
    const param_row_t *const row = &params_table[i];
    const float value = params_get(&GLUE.tuned, row);
    if (value >= row->min && value <= row->max) continue;
    (void)!params_set(&GLUE.tuned, row, params_get(&GLUE.flown, row));
    note(i);
  }
}

// Checks a set. One that passes waits for the next tick, and with it the commit that was asked for before the
// check, never a later one.
static bool offer(const flight_param_t *weights_from) {
  GLUE.ready = 0; // a tick may come at any time
  atomic_signal_fence(memory_order_seq_cst);
  GLUE.candidate = GLUE.tuned;
  put_weights(&GLUE.candidate, weights_from);
  GLUE.commit_asked = GLUE.commit;
  if (params_check(&GLUE.candidate) != ST_OK) return false;
  atomic_signal_fence(memory_order_seq_cst);
  GLUE.ready = 1;
  return true;
}

static bool judge(const flight_param_t *weights_from) {
  if (offer(weights_from)) return true;
  GLUE.sets_refused++;
  mend();
  return false;
}

void settings_touched(void) {
  if (GLUE.shadow > 1) GLUE.shadow = 1;
  GLUE.weights_sum = GLUE.sum_flown; // only the app may change it
  if (judge(GLUE.commit == COMMIT_TYPED ? &GLUE.tuned : &GLUE.flown)) return;
  if (GLUE.commit != 0) GLUE.commits_refused++;
  GLUE.commit = 0;
  (void)!offer(&GLUE.flown); // earlier writes that do not fly yet
}

// --- start ------------------------------------------------------------------------------------------------

// Puts back all weights at once: of a set that was stored in part none is flown.
static void put_weights_back(void) {
  for (int i = 0; i < params_count; i++) {
    const param_row_t *const row = &params_table[i];
    if (settings_is_weight(row) && params_get(&GLUE.tuned, row) != params_get(&GLUE.flown, row)) note(i);
  }
  put_weights(&GLUE.tuned, &GLUE.flown);
}

void settings_start(void) {
  const bool asked = GLUE.commit == COMMIT_TYPED;
  GLUE.commit = 0;
  GLUE.ground_starts = false;
  if (!GLUE.started) {
    params_default(&GLUE.flown);
    GLUE.sum_default = sum_of(&GLUE.flown);
  }
  GLUE.started = 1;
  GLUE.weights_mixed = !asked && (sum_of(&GLUE.tuned) ^ GLUE.sum_default) != GLUE.weights_sum;
  if (GLUE.weights_mixed) put_weights_back();
  if (!judge(&GLUE.tuned) && !offer(&GLUE.tuned)) GLUE.tuned = GLUE.flown;
  if (GLUE.ready) GLUE.flown = GLUE.candidate;
  GLUE.ready = 0;
  make_sum();
  (void)!flight_init(&GLUE.flight, &GLUE.flown); // a set that passed its checks
}

// --- flying -----------------------------------------------------------------------------------------------

bool settings_learning(void) {
  const bool live = GLUE.flown.curve.mode == CURVE_LIVE || GLUE.flown.ground.mode == CURVE_LIVE;
  return live && !GLUE.in.no_lesson && GLUE.in.setpoint.z != AXIS_OFF;
}

// Commits the typed or the learned weights, of both curves or of none. True if it did.
static bool commit(unsigned which) {
  learn_t *const learn = &GLUE.flight.outer.learn;
  flight_param_t *const set = &GLUE.candidate;
  if (settings_learning() || (which != COMMIT_TYPED && which != COMMIT_LEARNED)) return false;
  if (which == COMMIT_LEARNED) {
    set->curve.fixed = learn->rls.theta;
    set->ground.fixed = GLUE.flight.ground.learn.rls.theta;
  }
  if (rls_check(&set->learn.rls, &set->ground.fixed) != ST_OK) return false;
  if (learn_init(learn, &set->learn, &set->curve.fixed) != ST_OK) return false;
  GLUE.ground_starts = true;
  put_weights(&GLUE.tuned, set);
  return true;
}

static void take_commit(unsigned which) {
  if (commit(which)) {
    GLUE.commits++;
    GLUE.recorder.tunes++;
    put_weights(&GLUE.flown, &GLUE.candidate); // in case a write replaces the candidate
    make_sum();
  } else {
    GLUE.commits_refused++;
    put_weights(&GLUE.candidate, &GLUE.flown);
  }
}

// Takes a commit, a set, or the ground's weights, each in its own tick: together they take too long.
static void take(void) {
  if (GLUE.ready && GLUE.commit_asked != 0) {
    take_commit(GLUE.commit_asked);
    GLUE.commit = GLUE.commit_asked = 0;
  } else if (GLUE.ready) {
    GLUE.ready = 0;
    GLUE.flown = GLUE.candidate;
    GLUE.recorder.tunes++;
    (void)!flight_tune(&GLUE.flight, &GLUE.flown);
  } else if (GLUE.ground_starts) { // with the set that came with the commit
    GLUE.ground_starts = false;
    (void)!learn_init(&GLUE.flight.ground.learn, &GLUE.flown.learn, &GLUE.flown.ground.fixed); // was checked
  }
}

void settings_take(void) {
  const bool inner_is_next = GLUE.flight.phase % 2 == 0; // the cheapest tick, unless a loop waits
  if (inner_is_next && GLUE.flight.waiting == 0) take();
}

void settings_mend(void) {
  if (!(GLUE.flight.due & FLIGHT_SCRUB)) return;
  if (GLUE.flight.waiting != 0 && (GLUE.ready || GLUE.ground_starts))
    take();
  else if (memcmp(&GLUE.flight.outer.param, &GLUE.flown, sizeof GLUE.flown) != 0) // else flight_step did it
    (void)!flight_tune(&GLUE.flight, &GLUE.flown);
}
