// range_up.h - new samples of the upward range sensor, from a value without time stamp.
//
// The firmware gives the last distance of a task that measures ten times a second. Another value is a new
// sample. The same value is one if its time has passed by 20 ms: it was measured at its time, and is by so
// much older. So a sensor that hangs gives samples that do not change, and the guard sees it.
#ifndef FIRMWARE_RANGE_UP_H
#define FIRMWARE_RANGE_UP_H

#include <stdbool.h>
#include <stdint.h>

#define RANGE_UP_PERIOD_MS 100
#define RANGE_UP_LATE_MS   20
#define RANGE_UP_AGE_S     0.07f // a value that just came was measured so long ago

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

// One millisecond: value_mm as the firmware gives it, now_ms a counter that may wrap.
range_up_sample_t range_up_poll(range_up_t *s, float value_mm, uint32_t now_ms);

#endif
