// noise.h - named noise levels of the six-degree-of-freedom vehicle: the errors of its sensors, the motion of
// the air, and by how much vehicles and flights differ.
//
//   quiet  perfect except for rate, filter, age, floor and reach. In all levels the downward sensor's view
//          is the firmware's 15 deg, and the upward sensor's is the axis alone (unknown; to be set)
//   real   noise of the sensors only: no air moves, and the vehicle is the one in its file
//   flown  as real, and what differs between flights: gusts, and a vehicle and sensors that are not quite
//          those that the controller was told of, drawn from the flight's seed (flight/drawn.h)
//
// NOISE_ROWS is the only table: it defines the levels, what --noise LEVEL:KEY=VALUE may change, and the list
// of keys. `assumed`: a number without a source. Rows that differ from flight to flight begin with "vary.".
//
// Accelerometer in flight: 0.0075 g on z, 0.015 and 0.017 g on x and y, from the spectrum of a logged hover
// (jana05) from 8 to 20 Hz, where the true motion, according to the rotors' speeds, is a hundredth of that.
// From 0.3 to 1 Hz, what motion capture does not explain has the same density, so the noise is white. Over
// whole logs, motion included, z has 0.009 to 0.014 g; a simulated hover logs 0.009 g, as jana05 does.
#ifndef SIM_SENSE_NOISE_H
#define SIM_SENSE_NOISE_H

#include "sense/imu.h"
#include "sense/range.h"
#include <stddef.h>

// By how much flights differ. Shares are relative to the number in the vehicle file, or in the level's other
// rows. All zero: not at all.
typedef struct {
  double gust_min_mps2, gust_max_mps2; // sd of the gusts' force over mass, each axis: uniform between
  double gust_tau_s;                   // their correlation time (effect `wind`)
  double mass, thrust, rotor, lag;     // uniform within +- this share; rotor: one of the four, in addition
  double delay_s;                      // uniform from 0 to this
  double acc_bias_mps2;                // sd, each axis
  double range_scale, range_m;         // uniform within +- this; each range sensor has its own
  double curve_a, curve_b;             // uniform within +- this share
  double top_min_m, top_max_m;         // uniform between; relative to the vehicle file's
  double mount_rad;                    // uniform within +- this, about x and y
} vary_t;

typedef struct {
  const char *name;
  imu_param_t imu;
  range_param_t range;
  vary_t vary;
} noise_t;

#define NOISE_DEG RAD_PER_DEG
#define NOISE_G   G_MPS2

#define NOISE_AT_REST "sd over 11 s at rest, recorded"
#define NOISE_HOVERS  "spread of logged hovers above 20 Hz"
#define NOISE_N23     "assumed; n2 to n3 of the vertical axis"

// X(key, unit, min, max, member of noise_t, quiet, real, flown, meaning, source)
#define NOISE_ROWS(X)                                                                                        \
  X("acc.rest", "m/s2", 0.0, 10.0, imu.acc_rest_mps2, 0.0, 0.0012 * NOISE_G, 0.0012 * NOISE_G,               \
    "sd, motors off", NOISE_AT_REST)                                                                         \
  X("acc.xy", "m/s2", 0.0, 10.0, imu.acc_xy_mps2, 0.0, 0.016 * NOISE_G, 0.016 * NOISE_G,                     \
    "sd of x and y, motors on", "spectrum of the logged hover jana05, 8 to 20 Hz")                           \
  X("acc.z", "m/s2", 0.0, 10.0, imu.acc_z_mps2, 0.0, 0.008 * NOISE_G, 0.008 * NOISE_G, "sd of z, motors on", \
    "spectrum of the logged hover jana05, 8 to 20 Hz")                                                       \
  X("acc.bias.x", "m/s2", -10.0, 10.0, imu.acc_bias_b_mps2.x, 0.0, 0.0, 0.0, "constant error",               \
    "0; vary.bias draws it")                                                                                 \
  X("acc.bias.y", "m/s2", -10.0, 10.0, imu.acc_bias_b_mps2.y, 0.0, 0.0, 0.0, "constant error",               \
    "0; vary.bias draws it")                                                                                 \
  X("acc.bias.z", "m/s2", -10.0, 10.0, imu.acc_bias_b_mps2.z, 0.0, 0.0, 0.0, "constant error",               \
    "0; vary.bias draws it")                                                                                 \
  X("acc.scale", "", -0.2, 0.2, imu.acc_scale, 0.0, 0.0, 0.0, "relative error of the scale",                 \
    "the firmware scales |acc| to 1 g at rest")                                                              \
  X("gyro.rest", "rad/s", 0.0, 10.0, imu.gyro_rest_radps, 0.0, 0.14 * NOISE_DEG, 0.14 * NOISE_DEG,           \
    "sd, motors off", NOISE_AT_REST)                                                                         \
  X("gyro.xy", "rad/s", 0.0, 10.0, imu.gyro_xy_radps, 0.0, 1.0 * NOISE_DEG, 1.0 * NOISE_DEG,                 \
    "sd of x and y, motors on", NOISE_HOVERS)                                                                \
  X("gyro.z", "rad/s", 0.0, 10.0, imu.gyro_z_radps, 0.0, 0.5 * NOISE_DEG, 0.5 * NOISE_DEG,                   \
    "sd of z, motors on", NOISE_HOVERS)                                                                      \
  X("gyro.bias.x", "rad/s", -1.0, 1.0, imu.gyro_bias_b_radps.x, 0.0, 0.0, 0.0, "constant error",             \
    "the firmware takes out the mean at rest")                                                               \
  X("gyro.bias.y", "rad/s", -1.0, 1.0, imu.gyro_bias_b_radps.y, 0.0, 0.0, 0.0, "constant error",             \
    "the firmware takes out the mean at rest")                                                               \
  X("gyro.bias.z", "rad/s", -1.0, 1.0, imu.gyro_bias_b_radps.z, 0.0, 0.0, 0.0, "constant error",             \
    "the firmware takes out the mean at rest")                                                               \
  X("gyro.scale", "", -0.2, 0.2, imu.gyro_scale, 0.0, 0.0, 0.0, "relative error of the scale", "assumed")    \
  X("mount.x", "rad", -0.2, 0.2, imu.mount_rad.x, 0.0, 0.0, 0.0, "chip turned about x",                      \
    "0; vary.mount draws it")                                                                                \
  X("mount.y", "rad", -0.2, 0.2, imu.mount_rad.y, 0.0, 0.0, 0.0, "chip turned about y",                      \
    "0; vary.mount draws it")                                                                                \
  X("mount.z", "rad", -0.2, 0.2, imu.mount_rad.z, 0.0, 0.0, 0.0, "chip turned about z", "assumed")           \
  X("up", "m", 0.0, 1.0, range.up_m, 0.0, 0.003, 0.003, "sd of the upward range",                            \
    "assumed, as on the vertical axis")                                                                      \
  X("up.scale", "", -0.2, 0.2, range.up_scale, 0.0, 0.0, 0.0, "relative error of the scale",                 \
    "0; vary.scale draws it")                                                                                \
  X("up.offset", "m", -0.2, 0.2, range.up_offset_m, 0.0, 0.0, 0.0, "constant error",                         \
    "0; vary.offset draws it")                                                                               \
  X("up.cone", "rad", 0.0, 0.5, range.up_cone_rad, 0.0, 0.0, 0.0, "half the upward sensor's view",           \
    "unknown: the axis alone")                                                                               \
  X("down", "m", 0.0, 1.0, range.down_m, 0.0, 0.0025, 0.0025, "sd of the downward range near the ground",    \
    "the firmware's model of the sensor")                                                                    \
  X("down.scale", "", -0.2, 0.2, range.down_scale, 0.0, 0.0, 0.0, "relative error of the scale",             \
    "0; vary.scale draws it")                                                                                \
  X("down.offset", "m", -0.2, 0.2, range.down_offset_m, 0.0, 0.0, 0.0, "constant error",                     \
    "0; vary.offset draws it")                                                                               \
  X("down.cone", "rad", 0.0, 0.5, range.down_cone_rad, 7.5 * NOISE_DEG, 7.5 * NOISE_DEG, 7.5 * NOISE_DEG,    \
    "half the downward sensor's view", "the firmware's model of the sensor")                                 \
  X("flow", "counts", 0.0, 100.0, range.flow_counts, 0.0, 2.0, 2.0, "sd of the flow, each axis",             \
    "the firmware's model of the sensor")                                                                    \
  X("rounding", "", 0.0, 1.0, range.rounding, 0.0, 1.0, 1.0, "1: whole millimetres and counts",              \
    "the chips' registers")                                                                                  \
  X("vary.gust.min", "m/s2", 0.0, 10.0, vary.gust_min_mps2, 0.0, 0.0, 0.05,                                  \
    "sd of gusts, each axis: the calmest flight", NOISE_N23)                                                 \
  X("vary.gust.max", "m/s2", 0.0, 10.0, vary.gust_max_mps2, 0.0, 0.0, 0.15,                                  \
    "sd of gusts, each axis: the worst flight", NOISE_N23)                                                   \
  X("vary.gust.tau", "s", 0.01, 100.0, vary.gust_tau_s, 0.3, 0.3, 0.3, "their correlation time", NOISE_N23)  \
  X("vary.mass", "", 0.0, 0.5, vary.mass, 0.0, 0.0, 0.03, "mass, evenly within +- this share",               \
    "assumed: 1 g of 33")                                                                                    \
  X("vary.thrust", "", 0.0, 0.5, vary.thrust, 0.0, 0.0, 0.05, "thrust of all rotors, +- this share",         \
    "assumed; a thrust stand is -2 % off the map, and +1 % at hover")                                        \
  X("vary.rotor", "", 0.0, 0.5, vary.rotor, 0.0, 0.0, 0.02, "thrust of one rotor besides, +- this share",    \
    "assumed")                                                                                               \
  X("vary.lag", "", 0.0, 0.9, vary.lag, 0.0, 0.0, 0.15, "the motors' lag, +- this share",                    \
    "own fits to the flights jana00 to 11: 70 to 90 ms")                                                     \
  X("vary.delay", "s", 0.0, 0.2, vary.delay_s, 0.0, 0.0, 0.006,                                              \
    "delay of commands besides the vehicle's, 0 to this", "assumed")                                         \
  X("vary.bias", "m/s2", 0.0, 1.0, vary.acc_bias_mps2, 0.0, 0.0, 0.05, "sd of acc.bias, each axis",          \
    "BMI088 data sheet: 0.2 mg/K, 25 K from where it was calibrated")                                        \
  X("vary.scale", "", 0.0, 0.2, vary.range_scale, 0.0, 0.0, 0.01, "up.scale and down.scale, +- this",        \
    "assumed")                                                                                               \
  X("vary.offset", "m", 0.0, 0.2, vary.range_m, 0.0, 0.0, 0.003, "up.offset and down.offset, +- this",       \
    "assumed")                                                                                               \
  X("vary.Ca", "", 0.0, 0.9, vary.curve_a, 0.0, 0.0, 0.3,                                                    \
    "what the ceiling adds to the thrust, +- this share", "assumed")                                         \
  X("vary.Cb", "", 0.0, 0.9, vary.curve_b, 0.0, 0.0, 0.2,                                                    \
    "how fast that falls with the distance, +- this share", "assumed")                                       \
  X("vary.top.min", "m", -0.2, 0.2, vary.top_min_m, 0.0, 0.0, -0.001,                                        \
    "top of the body, from where it is: the lowest",                                                         \
    "captured flights of the air garage sit 6.7 to 9.5 mm below the ceiling")                                \
  X("vary.top.max", "m", -0.2, 0.2, vary.top_max_m, 0.0, 0.0, 0.002,                                         \
    "top of the body, from where it is: the highest",                                                        \
    "captured flights of the air garage sit 6.7 to 9.5 mm below the ceiling")                                \
  X("vary.mount", "rad", 0.0, 0.2, vary.mount_rad, 0.0, 0.0, 0.5 * NOISE_DEG,                                \
    "mount.x and mount.y, +- this", "assumed")

typedef struct {
  const char *name, *unit;
  double min, max;
  size_t offset; // of the number in noise_t
  const char *brief, *source;
} noise_field_t;

extern const noise_t noise_levels[]; // the first is quiet
extern const int noise_count;

extern const noise_field_t noise_fields[];
extern const int noise_field_count;

// The level of that name; null if there is none.
const noise_t *noise_find(const char *name);

// The number of a field.
double noise_get(const noise_t *noise, const noise_field_t *field);

// Sets one number by its name, as "acc.bias.z". False, with nothing changed, if there is no such name or the
// value is out of range.
bool noise_set(noise_t *noise, const char *field, double value);

#endif
