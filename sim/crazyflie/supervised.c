// supervised.c - the firmware's supervisor.
#include "supervised.h"

#include "base/either.h"

#include <math.h>

#define FLYING_MS      2000 // it flies until this long after the last thrust
#define LEVEL_OUT_MS   500  // a set point older than this: level out
#define LOCK_MS        2000 // a set point older than this: lock
#define FED_MS         1000 // the watchdog fed longer ago than this: stop
#define FREE_FALL_G    0.1f // less on every axis is free fall
#define TILTED_G       0.5f // on z: 60 degrees
#define TILTED_MS      1000
#define UPSIDE_DOWN_G  -0.2f
#define UPSIDE_DOWN_MS 100

const supervised_param_t supervised_default = {.preflight_ms = 30000, .landed_ms = 3000, .tumble_check = 1};

enum {
  IS_ARMED = 1 << 0,
  IS_FLYING = 1 << 1,
  IS_TUMBLED = 1 << 2,
  IS_STALE = 1 << 3,   // the set point is old: level out
  IS_LOST = 1 << 4,    // the set point is too old: lock
  IS_STOPPED = 1 << 5, // emergency stop
  IS_CRASHED = 1 << 6,
  IS_OVERDUE = 1 << 7, // armed for too long without flying
  IS_DOWN = 1 << 8,    // landed long ago
};

// The first row that holds is taken. A row with `any` or `lacks` holds if a bit of `any` is set or one of
// `lacks` is clear; any other row, if all of `all` are set and none of `none`; none while a bit of its `but`
// is set.
typedef struct {
  supervised_state_t from, to;
  unsigned any, lacks, all, none, but;
} transition_t;

static const transition_t transitions[] = {
    {.from = SUPERVISED_BEGIN, .to = SUPERVISED_NOT_PASSED},
    {.from = SUPERVISED_NOT_PASSED, .to = SUPERVISED_FREE_FALL, .any = IS_STOPPED},
    {.from = SUPERVISED_NOT_PASSED, .to = SUPERVISED_PASSED, .but = IS_TUMBLED},
    {.from = SUPERVISED_PASSED, .to = SUPERVISED_FREE_FALL, .any = IS_STOPPED},
    {.from = SUPERVISED_PASSED, .to = SUPERVISED_NOT_PASSED, .any = IS_TUMBLED},
    {.from = SUPERVISED_PASSED, .to = SUPERVISED_ARMING, .all = IS_ARMED, .but = IS_TUMBLED},
    {.from = SUPERVISED_ARMING, .to = SUPERVISED_FREE_FALL, .any = IS_STOPPED},
    {.from = SUPERVISED_ARMING, .to = SUPERVISED_NOT_PASSED, .any = IS_TUMBLED, .lacks = IS_ARMED},
    {.from = SUPERVISED_ARMING, .to = SUPERVISED_READY},
    {.from = SUPERVISED_READY, .to = SUPERVISED_FREE_FALL, .any = IS_STOPPED},
    {.from = SUPERVISED_READY,
     .to = SUPERVISED_NOT_PASSED,
     .any = IS_TUMBLED | IS_OVERDUE,
     .lacks = IS_ARMED},
    {.from = SUPERVISED_READY, .to = SUPERVISED_FLYING, .all = IS_FLYING},
    {.from = SUPERVISED_FLYING, .to = SUPERVISED_FREE_FALL, .any = IS_LOST | IS_STOPPED},
    {.from = SUPERVISED_FLYING, .to = SUPERVISED_CRASHED, .any = IS_TUMBLED},
    {.from = SUPERVISED_FLYING, .to = SUPERVISED_RESET, .lacks = IS_ARMED},
    {.from = SUPERVISED_FLYING, .to = SUPERVISED_LEVEL_OUT, .any = IS_STALE},
    {.from = SUPERVISED_FLYING, .to = SUPERVISED_LANDED, .lacks = IS_FLYING},
    {.from = SUPERVISED_LANDED, .to = SUPERVISED_RESET, .any = IS_DOWN, .lacks = IS_ARMED},
    {.from = SUPERVISED_LANDED, .to = SUPERVISED_FLYING, .all = IS_FLYING},
    {.from = SUPERVISED_RESET, .to = SUPERVISED_NOT_PASSED},
    {.from = SUPERVISED_LEVEL_OUT, .to = SUPERVISED_FREE_FALL, .any = IS_LOST | IS_TUMBLED | IS_STOPPED},
    {.from = SUPERVISED_LEVEL_OUT, .to = SUPERVISED_FLYING, .none = IS_STALE | IS_LOST},
    {.from = SUPERVISED_FREE_FALL, .to = SUPERVISED_LOCKED},
    {.from = SUPERVISED_CRASHED, .to = SUPERVISED_NOT_PASSED, .none = IS_CRASHED | IS_TUMBLED},
    {.from = SUPERVISED_CRASHED, .to = SUPERVISED_LOCKED, .any = IS_STOPPED},
};

static bool holds(const transition_t *t, unsigned now) {
  const bool one = (now & t->any) != 0 || (~now & t->lacks) != 0;
  const bool all = (now & t->all) == t->all && (now & t->none) == 0;
  return (now & t->but) == 0 && EITHER(t->any != 0 || t->lacks != 0, one, all);
}

static supervised_state_t next(supervised_state_t state, unsigned now) {
  supervised_state_t to = state;
  bool found = false;
  for (unsigned i = 0; i < sizeof transitions / sizeof *transitions; i++) {
    const transition_t *const t = &transitions[i];
    const bool first = !found && t->from == state && holds(t, now);
    FOR_WHOM(first, &to) to = t->to;
    found = found || first;
  }
  return to;
}

// Tilted for TILTED_MS, or upside down for UPSIDE_DOWN_MS. Free fall is flight.
static bool tumbles(supervised_t *s, const supervised_in_t *in) {
  const float *const g = in->acc_g;
  const bool falls = fabsf(g[0]) < FREE_FALL_G && fabsf(g[1]) < FREE_FALL_G && fabsf(g[2]) < FREE_FALL_G;
  const bool tilted = g[2] < TILTED_G, begins = falls || s->tilted_ms == 0;
  s->tilted_ms = EITHER(tilted, EITHER(begins, in->now_ms, s->tilted_ms), (uint32_t)0);
  const uint32_t since_ms = in->now_ms - s->tilted_ms;
  return tilted && since_ms > EITHER(g[2] < UPSIDE_DOWN_G, UPSIDE_DOWN_MS, TILTED_MS);
}

static unsigned when(bool condition, unsigned bit) {
  return EITHER(condition, bit, 0u);
}

static unsigned look(supervised_t *s, const supervised_param_t *p, const supervised_in_t *in) {
  const uint32_t now_ms = in->now_ms, age_ms = now_ms - in->setpoint_ms;
  if (in->motors) s->thrust_ms = now_ms;
  s->tumbled = tumbles(s, in) && p->tumble_check;
  const bool starved = in->fed_ms > 0 && now_ms - in->fed_ms >= FED_MS;
  return when(s->armed, IS_ARMED) | when(s->thrust_ms != 0 && now_ms - s->thrust_ms < FLYING_MS, IS_FLYING) |
         when(s->tumbled, IS_TUMBLED) | when(age_ms > LEVEL_OUT_MS, IS_STALE) |
         when(age_ms > LOCK_MS, IS_LOST) | when(starved || in->stop, IS_STOPPED) |
         when(s->crashed, IS_CRASHED) |
         when(s->state == SUPERVISED_READY && now_ms - s->armed_ms > p->preflight_ms, IS_OVERDUE) |
         when(s->landed_ms != 0 && now_ms - s->landed_ms > p->landed_ms, IS_DOWN);
}

static void enter(supervised_t *s, supervised_state_t state, uint32_t now_ms) {
  s->state = state;
  s->armed_ms = EITHER(state == SUPERVISED_READY, now_ms, s->armed_ms);
  s->landed_ms = EITHER(state == SUPERVISED_LANDED, now_ms, s->landed_ms);
  s->crashed = s->crashed || state == SUPERVISED_CRASHED;
  // It arms itself.
  s->armed = state == SUPERVISED_PASSED || (s->armed && supervised_motors_run(s));
}

supervised_t supervised_begun(bool flies, uint32_t now_ms) {
  supervised_t s = {.state = SUPERVISED_BEGIN, .armed = true};
  enter(&s, flies ? SUPERVISED_FLYING : SUPERVISED_READY, now_ms);
  if (flies) s.thrust_ms = EITHER(now_ms > 0, now_ms, 1u);
  return s;
}

bool supervised_update(supervised_t *s, const supervised_param_t *p, const supervised_in_t *in) {
  const supervised_state_t to = next(s->state, look(s, p, in));
  const bool other = to != s->state;
  FOR_WHOM(other, s) enter(s, to, in->now_ms);
  return other;
}

bool supervised_arm(supervised_t *s, bool arm) {
  if (arm == s->armed) return true;
  if (arm && s->state != SUPERVISED_PASSED) return false;
  s->armed = arm;
  return true;
}

bool supervised_recover(supervised_t *s) {
  if (s->crashed && s->tumbled) return false;
  s->crashed = false;
  return true;
}

unsigned supervised_info(const supervised_t *s) {
  return when(s->state == SUPERVISED_PASSED, 1) | when(s->armed, 2) | 4 | when(supervised_can_fly(s), 8) |
         when(supervised_flies(s), 16) | when(s->tumbled, 32) | when(s->state == SUPERVISED_LOCKED, 64) |
         when(s->crashed, 128);
}

const char *supervised_words(supervised_state_t state) {
#define WORDS(name, words) words,
  static const char *const table[] = {SUPERVISED_STATES(WORDS)};
#undef WORDS
  return table[state];
}
