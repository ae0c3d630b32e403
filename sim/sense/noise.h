// noise.h - levels of noise of all sensors of the six-degree-of-freedom vehicle, by name.
//
//   quiet  perfect but for rate, filter, age, floor and reach; the downward sensor's view is the firmware's
//          15 deg in both levels, upward the axis alone (unknown; to be set)
//   real   at rest: spread of an 11 s recording. Motors on, gyro: spread of logged hovers above about 20 Hz.
//          Accelerometer: spectrum of a logged hover (jana05) from 8 to 20 Hz, where its true motion, as the
//          rotors' speeds tell it, is a hundredth: 0.0075 g on z, 0.015 and 0.017 g on x and y. What motion
//          capture does not explain from 0.3 to 1 Hz has the same density, hence white. Over whole logs,
//          motion included, z has 0.009 to 0.014 g; a simulated hover logs 0.009 g, as jana05 does.
//          Ranges: the firmware's own model, 3 mm upward as on the vertical axis. Flow: the 2 counts that the
//          firmware assumes.
#ifndef SIM_SENSE_NOISE_H
#define SIM_SENSE_NOISE_H

#include "sense/imu.h"
#include "sense/range.h"
#include <stddef.h>

typedef struct {
  const char *name;
  imu_param_t imu;
  range_param_t range;
} noise_t;

typedef struct {
  const char *name, *unit;
  double min, max;
  size_t offset; // of the number in noise_t
  const char *brief;
} noise_field_t;

extern const noise_t noise_levels[]; // the first is quiet
extern const int noise_count;

extern const noise_field_t noise_fields[];
extern const int noise_field_count;

// A null pointer if there is no level of that name.
const noise_t *noise_find(const char *name);

// Sets one number, as "acc.bias.z". False, and nothing changed, if there is none of that name or the value is
// out of its range.
bool noise_set(noise_t *noise, const char *field, double value);

#endif
