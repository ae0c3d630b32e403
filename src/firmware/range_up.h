// range_up.h - new samples of the upward range sensor, from a value without time stamp.
//
// The firmware gives the last distance of a task that measures ten times a second. A changed value is a new
// sample. An unchanged one counts as a sample 20 ms after it was due, and is older by these 20 ms. So a
// sensor that hangs gives samples that do not change, and the guard notices it.
#ifndef FIRMWARE_RANGE_UP_H
#define FIRMWARE_RANGE_UP_H

#include <stdbool.h>
#include <stdint.h>

#define RANGE_UP_PERIOD_MS 100
#define RANGE_UP_LATE_MS   20
#define RANGE_UP_AGE_S     0.07f // age of a value that has just changed

typedef struct {
  float last_mm;
  uint32_t at_ms; // of the last sample
  bool started;
} range_up_t;

typedef struct {
  bool is_new;
  float range_m; // 32.767: the sensor saw nothing
  float age_s;
} range_up_sample_t;

// Call every millisecond. value_mm: as the firmware gives it. now_ms: a counter that may wrap.
range_up_sample_t range_up_poll(range_up_t *s, float value_mm, uint32_t now_ms);

#endif
