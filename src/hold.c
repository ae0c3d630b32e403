// hold.c - the ceiling's height in the world.
#include "flight/hold.h"

#include "flight/v3.h"

void hold_init(hold_t *s) {
  *s = (hold_t){.ceiling_z_m = NAN};
}

// Asks estimate and last sample: the estimate lags behind changes, and one stray sample may lift it far.
static bool is_settled_far(const hold_t *s, const ceiling_t *c) {
  return s->samples >= HOLD_SAMPLES && s->against == 0 && c->zc_m > HOLD_BEYOND_M &&
         c->seen_m > HOLD_BEYOND_M;
}

void hold_step(hold_t *s, const ceiling_t *c, float z_m, float period_s, int32_t mode) {
  s->against_s = EITHER(s->against > 0, s->against_s + period_s, s->against_s);
  const bool asked = mode == HOLD_NOT || (mode == HOLD_LATCHED && is_settled_far(s, c));
  const bool follows = c->known && (asked || !f_finite(s->ceiling_z_m));
  s->ceiling_z_m = EITHER(follows, z_m + c->zc_m, s->ceiling_z_m);
}

// True once samples have contradicted the height for long enough.
static bool refuted(hold_t *s, bool is, float seen_z_m, float seen_m) {
  const float off_m = seen_z_m - s->ceiling_z_m; // NaN where no ceiling is known: no contradiction
  const bool against = off_m < -HOLD_MARGIN_M || (off_m > HOLD_MARGIN_M && seen_m > HOLD_ROOM_M);
  const int times = EITHER(s->against < HOLD_AGAINST, s->against + 1, s->against);
  s->against = EITHER(is, EITHER(against, times, 0), s->against);
  s->against_s = EITHER(is && !against, 0.0f, s->against_s);
  return is && against && s->against == HOLD_AGAINST && s->against_s >= HOLD_AGAINST_S;
}

void hold_take(hold_t *s, const ceiling_t *c, bool is, float z_m, float climb_mps, int32_t mode) {
  const float seen_z_m = z_m + c->seen_m;
  if (refuted(s, is, seen_z_m, c->seen_m)) {
    hold_init(s);
    if (c->known) s->ceiling_z_m = seen_z_m;
  }
  const bool taken = is && c->known && c->blind_s == 0.0f; // not at the sensor's floor, not gated
  const bool more = mode == HOLD_MEAN && fabsf(climb_mps) <= HOLD_SLOW_MPS &&
                    fabsf(seen_z_m - s->ceiling_z_m) <= HOLD_NOISE_M;
  const bool counts = taken && (s->samples < HOLD_SAMPLES || more);
  if (!ANY(counts)) return;
  const int before = EITHER(s->samples < 0, 0, s->samples); // the sign bit flipped
  const int samples = EITHER(before < HOLD_MEAN_SAMPLES, before + 1, before);
  const float z_w_m = EITHER(samples == 1, seen_z_m, s->ceiling_z_m);
  s->samples = EITHER(counts, samples, s->samples);
  s->ceiling_z_m = EITHER(counts, z_w_m + (seen_z_m - z_w_m) / (float)samples, s->ceiling_z_m);
}

void hold_sample(hold_t *s, const ceiling_t *c, float z_m, float climb_mps, int32_t mode) {
  hold_take(s, c, true, z_m, climb_mps, mode);
}
