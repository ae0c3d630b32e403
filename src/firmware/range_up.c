// range_up.c - new samples of the upward range sensor.
#include "range_up.h"

#include "flight/v3.h"

range_up_sample_t range_up_poll(range_up_t *s, float value_mm, uint32_t now_ms) {
  if (!s->started) *s = (range_up_t){.at_ms = now_ms, .started = true};
  const uint32_t since_ms = now_ms - s->at_ms;
  const bool other = value_mm != s->last_mm, again = since_ms >= RANGE_UP_PERIOD_MS + RANGE_UP_LATE_MS;
  if (!ANY(other || again)) return (range_up_sample_t){.is_new = false};
  // After a pause of the caller the counter may be far ahead.
  const uint32_t at_ms =
      EITHER(since_ms < 2 * RANGE_UP_PERIOD_MS, s->at_ms + RANGE_UP_PERIOD_MS, now_ms - RANGE_UP_LATE_MS);
  s->last_mm = EITHER(other, value_mm, s->last_mm);
  s->at_ms = EITHER(other, now_ms, EITHER(again, at_ms, s->at_ms));
  const float age_s = EITHER(other, RANGE_UP_AGE_S, RANGE_UP_AGE_S + 0.001f * RANGE_UP_LATE_MS);
  return (range_up_sample_t){other || again, 0.001f * value_mm, age_s};
}
