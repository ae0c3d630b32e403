// hold.c - the ceiling's height in the world.
#include "flight/hold.h"

#include "flight/v3.h"

void hold_init(hold_t *s) {
  *s = (hold_t){.ceiling_z_m = NAN};
}

// The estimate is slow: it may lag behind what has changed, and one stray sample may lift it far.
static bool is_settled_far(const hold_t *s, const ceiling_t *c) {
  return s->samples >= HOLD_SAMPLES && s->against == 0 && c->zc_m > HOLD_BEYOND_M &&
         c->seen_m > HOLD_BEYOND_M;
}

void hold_step(hold_t *s, const ceiling_t *c, float z_m, float period_s, int32_t mode) {
  if (s->against > 0) s->against_s += period_s;
  if (!c->known) return;
  const bool follows = mode == HOLD_NOT || (mode == HOLD_LATCHED && is_settled_far(s, c));
  if (follows || !f_finite(s->ceiling_z_m)) s->ceiling_z_m = z_m + c->zc_m;
}

// True once samples have put the ceiling elsewhere for long enough.
static bool refuted(hold_t *s, float seen_z_m, float seen_m) {
  const float off_m = seen_z_m - s->ceiling_z_m; // NaN where no ceiling is known: no contradiction
  if (!(off_m < -HOLD_MARGIN_M || (off_m > HOLD_MARGIN_M && seen_m > HOLD_ROOM_M))) {
    s->against = 0;
    s->against_s = 0.0f;
    return false;
  }
  if (s->against < HOLD_AGAINST) s->against++;
  return s->against == HOLD_AGAINST && s->against_s >= HOLD_AGAINST_S;
}

void hold_sample(hold_t *s, const ceiling_t *c, float z_m, float climb_mps, int32_t mode) {
  const float seen_z_m = z_m + c->seen_m;
  if (refuted(s, seen_z_m, c->seen_m)) {
    hold_init(s);
    if (c->known) s->ceiling_z_m = seen_z_m;
  }
  const bool taken = c->known && c->blind_s == 0.0f; // not at the sensor's floor, not gated
  const bool more = mode == HOLD_MEAN && fabsf(climb_mps) <= HOLD_SLOW_MPS &&
                    fabsf(seen_z_m - s->ceiling_z_m) <= HOLD_NOISE_M;
  if (!taken || (s->samples >= HOLD_SAMPLES && !more)) return;
  if (s->samples < 0) s->samples = 0; // its sign flipped
  if (s->samples < HOLD_MEAN_SAMPLES) s->samples++;
  if (s->samples == 1) s->ceiling_z_m = seen_z_m;
  s->ceiling_z_m += (seen_z_m - s->ceiling_z_m) / (float)s->samples;
}
