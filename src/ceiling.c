// ceiling.c - distance to the ceiling from a slow range sensor.
#include "flight/ceiling.h"

#include "flight/v3.h"

_Static_assert((CEILING_HISTORY & (CEILING_HISTORY - 1)) == 0, "at() wraps");

void ceiling_init(ceiling_t *s, float period_s) {
  *s = (ceiling_t){.period_s = period_s};
}

static unsigned ticks_ago(const ceiling_t *s, float age_s) {
  return (unsigned)f_clamp(age_s / s->period_s + 0.5f, 0.0f, (float)(CEILING_HISTORY - 1));
}

// Returns an index within the ring, whatever `newest` is: after a flipped bit in it the climbs are of other
// ticks until the ring has gone round, but never from outside the ring. Unsigned, because ticks may exceed
// newest.
static unsigned at(const ceiling_t *s, unsigned ticks) {
  return (s->newest - ticks) % CEILING_HISTORY;
}

// Returns the climb of the last age_s.
static float climb_since_m(const ceiling_t *s, float age_s) {
  const unsigned ticks = ticks_ago(s, age_s);
  float climb_m = 0.0f;
  for (unsigned i = 0; ANY(i < ticks); i++) climb_m += EITHER(i < ticks, PICK(s->climbs_m, at(s, i)), 0.0f);
  return climb_m;
}

void ceiling_tilt(ceiling_t *s, float up) {
  for (int i = 0; i < CEILING_HISTORY && !s->tilt_known; i++) s->ups[i] = up;
  s->tilt_known = true;
  PLACE(s->ups, at(s, 0), up);
}

float ceiling_up(const ceiling_t *s, float age_s) {
  return s->tilt_known ? PICK(s->ups, at(s, ticks_ago(s, age_s))) : 1.0f;
}

// Sets the estimate where `is` holds; so do the functions below (flight/v3.h).
static void set(ceiling_t *s, const ceiling_param_t *p, bool is, float zc_m) {
  s->zc_m = EITHER(is, f_max(zc_m, 0.0f), s->zc_m);
  s->known = EITHER(is, s->zc_m < p->far_m, s->known);
}

void ceiling_predict(ceiling_t *s, const ceiling_param_t *p, float climb_m) {
  const float up = PICK(s->ups, at(s, 0));
  s->newest = (s->newest + 1) % CEILING_HISTORY;
  PLACE(s->climbs_m, s->newest, climb_m);
  PLACE(s->ups, s->newest, up);
  s->rival_m -= climb_m;
  s->blind_s += s->period_s;
  set(s, p, s->known, s->zc_m - climb_m);
}

void ceiling_predict_over(ceiling_t *s, const ceiling_param_t *p, float climb_m, int periods) {
  const int steps = EITHER(periods < CEILING_HISTORY, periods, CEILING_HISTORY); // more are not remembered
  for (int i = 0; i < steps; i++) ceiling_predict(s, p, climb_m / (float)steps);
  s->blind_s += (float)(periods - steps) * s->period_s;
}

// Takes a rival. Three in a row that agree overrule an estimate that the gate would keep for ever.
static void take_rival(ceiling_t *s, const ceiling_param_t *p, bool is, float zc_m) {
  const bool agrees = s->rivals > 0 && fabsf(zc_m - s->rival_m) <= CEILING_AGREE_M;
  const int rivals = EITHER(agrees, s->rivals + 1, 1);
  const float mean_m = EITHER(rivals == 1, zc_m, s->rival_m + (zc_m - s->rival_m) / (float)rivals);
  const bool enough = is && rivals >= CEILING_AGREE_COUNT;
  s->rival_m = EITHER(is, mean_m, s->rival_m);
  s->rivals = EITHER(is, EITHER(enough, 0, rivals), s->rivals);
  s->blind_s = EITHER(enough, 0.0f, s->blind_s);
  set(s, p, enough, mean_m);
}

bool ceiling_good(float range_m, float age_s) {
  return range_m > 0.0f && range_m <= CEILING_RANGE_MAX_M && age_s >= 0.0f && age_s <= FLT_MAX;
}

void ceiling_take(ceiling_t *s, const ceiling_param_t *p, bool is, float range_m, float age_s) {
  const float now_m = range_m - climb_since_m(s, age_s);
  s->seen_m = EITHER(is, now_m, s->seen_m);
  const bool at_floor = range_m < p->floor_m, beyond_gate = range_m >= p->near_m;
  const bool gated = s->known && s->zc_m < p->near_m;
  // A sample beyond the gate by noise alone does not contradict; samples at the floor do.
  const bool contradicts = is && EITHER(gated, beyond_gate && now_m > s->zc_m + CEILING_AGREE_M,
                                        s->known && (at_floor || now_m > s->zc_m + CEILING_JUMP_M));
  const bool counts = is && !contradicts && !(gated || at_floor || (!s->known && !beyond_gate));
  if (ANY(contradicts)) take_rival(s, p, contradicts, now_m);
  s->rivals = EITHER(is && !contradicts, 0, s->rivals);
  if (!ANY(counts)) return;
  s->blind_s = EITHER(counts, 0.0f, s->blind_s);
  const bool jumps = now_m < s->zc_m - CEILING_JUMP_M; // a nearer one is safe to believe
  set(s, p, counts, EITHER(s->known && !jumps, s->zc_m + p->gain * (now_m - s->zc_m), now_m));
}

status_t ceiling_correct(ceiling_t *s, const ceiling_param_t *p, float range_m, float age_s) {
  if (!ceiling_good(range_m, age_s)) return ST_BAD_RANGE;
  ceiling_take(s, p, true, range_m, age_s);
  return ST_OK;
}
