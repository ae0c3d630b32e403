// below.h - a vehicle below a ceiling, for tests of the distance estimate: 100 Hz, a range sample every tenth
// tick.
#ifndef TEST_RIG_BELOW_H
#define TEST_RIG_BELOW_H

#include "flight/ceiling.h"
#include "rig/test.h"

static const ceiling_param_t below_param = {.gain = 0.1f, .floor_m = 0.043f, .near_m = 0.05f, .far_m = 0.5f};

#define BELOW_PERIOD_S 0.01f
enum { BELOW_EVERY = 10 }; // ticks per sample

// A vehicle that knows of a ceiling at zc_m.
static inline ceiling_t below_ceiling(float zc_m) {
  ceiling_t s;
  ceiling_init(&s, BELOW_PERIOD_S);
  ceiling_predict(&s, &below_param, 0.0f);
  CHECK_OK(ceiling_correct(&s, &below_param, zc_m, 0.0f));
  return s;
}

// Ten ticks without motion, then a range sample.
static inline void below_hover_and_look(ceiling_t *s, float range_m) {
  for (int i = 0; i < BELOW_EVERY; i++) ceiling_predict(s, &below_param, 0.0f);
  CHECK_OK(ceiling_correct(s, &below_param, range_m, 0.0f));
}

#endif
