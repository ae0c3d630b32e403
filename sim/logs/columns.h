// columns.h - which column of a log is which of our signals, with units, signs and frames; one file per
// laboratory.
//
// A columns file (tools/columns/*.toml):
//
//   rest_height_m = 0.05                         optional: what z says when the vehicle stands on the ground
//   acceleration = "body"                        specific force in body axes (+1 g on z at rest), or
//                                                "world" (gravity taken out), or "world_with_gravity"
//   rows = "instants"                            optional: a row is what is at its time, its commands hold
//                                                from then on; or "means" of all columns over one period
//   [columns]                                    SIGNAL = {column, unit, and where wanted; without this
//                                                table the file is about the Crazyflie's own names
//   time = {column = "timestamp", unit = "ms"}             scale = 1, offset = 0, optional = false}
//   pitch = {column = "pitch", unit = "deg", scale = -1}
//   vbat = {value = 3.9, unit = "V"}             a battery that is always full, as simulators have
//
// The value is  scale x cell in SI + offset  (offset in SI), that of late_ms (-100 to 100; negative: the row
// is early) before the row's time, of motor commands, too. late_ms is the delay of a filter (7.5 ms for the
// Crazyflie's accelerometer, 2.8 ms for its gyro) or the age of a sample (70 ms for its upward range, 13 ms
// for the downward one; if left out: age_s of the vehicle file). A row of means stands at the middle of its
// period. Signals and units: columns.c. Attitude is a quaternion qw..qz that turns body into world (for the
// inverse: scale = -1 on qx, qy, qz), or roll, pitch, yaw (turned in the order yaw, pitch, roll; pitch nose
// down positive, as right-handed with y left).
//
// Motor commands are m1..m4: pwm, percent or share, rotor speeds (rad/s, rpm), or newton each; or `thrust` of
// all together with the torques tx, ty, tz: newton and Nm, or all four in pwm as the firmware's mixer takes
// them. w1..w4 are measured rotor speeds. range looks up, range_down down. set_x, set_y, set_z, set_vx,
// set_vy, set_vz and set_yaw are the controller's set points, in the world's axes and the frame of x, y, z.
#ifndef SIM_LOGS_COLUMNS_H
#define SIM_LOGS_COLUMNS_H

#include "base/error.h"
#include <stdbool.h>
#include <stdint.h>

typedef enum {
  SIG_TIME,
  SIG_X,
  SIG_Y,
  SIG_Z,
  SIG_VX,
  SIG_VY,
  SIG_VZ,
  SIG_AX,
  SIG_AY,
  SIG_AZ,
  SIG_QW,
  SIG_QX,
  SIG_QY,
  SIG_QZ,
  SIG_ROLL,
  SIG_PITCH,
  SIG_YAW,
  SIG_GX,
  SIG_GY,
  SIG_GZ,
  SIG_M1,
  SIG_M2,
  SIG_M3,
  SIG_M4,
  SIG_THRUST,
  SIG_VBAT,
  SIG_RANGE,
  SIG_RANGE_DOWN,
  SIG_TX,
  SIG_TY,
  SIG_TZ,
  SIG_W1,
  SIG_W2,
  SIG_W3,
  SIG_W4,
  SIG_SET_X, // what the controller was told: a place, a speed, a heading
  SIG_SET_Y,
  SIG_SET_Z,
  SIG_SET_VX,
  SIG_SET_VY,
  SIG_SET_VZ,
  SIG_SET_YAW,
  SIG_F1, // from here on computed from columns of a log: newton of each motor, as commanded
  SIG_F2,
  SIG_F3,
  SIG_F4,
  SIG_COUNT
} signal_id_t;

#define SIG_COLUMNS SIG_F1 // number of signals that can be columns

typedef uint64_t signals_t;
#define SIGNAL_BIT(signal) ((signals_t)1 << (signal))
#define SIGNALS(from, to)  ((SIGNAL_BIT((to) + 1) - 1u) & ~(SIGNAL_BIT(from) - 1u))

typedef enum { ACC_BODY, ACC_WORLD, ACC_WORLD_WITH_GRAVITY } acc_frame_t;
typedef enum { MOTORS_PWM, MOTORS_RADPS, MOTORS_N } motors_t;

#define COLUMN_NAME_MAX 64

typedef struct {
  char column[COLUMN_NAME_MAX]; // "": not in this log
  char unit[12];
  double factor;  // SI per unit of the cell, with sign and scale
  double offset;  // SI
  double late_s;  // -0.1..0.1  from the instant of the value to its row's time
  bool late_said; // by the columns file
  bool optional;  // may be missing in the CSV
  bool constant;  // no column: always `offset`
} column_t;

typedef struct {
  acc_frame_t acc;
  motors_t motors;      // what m1..m4 are
  bool mixed_pwm;       // thrust, tx, ty and tz are pwm
  bool rows_are_means;  // over the period of each row; else what is at its time
  bool crazyflie;       // a column that is missing may have another of its names (columns_also)
  double rest_height_m; // NaN: not said
  column_t of[SIG_COUNT];
} columns_t;

// What a Crazyflie logs, under its own names (also what the simulator writes). All but the time may be
// missing.
columns_t columns_crazyflie(void);

// Another column in which a Crazyflie's log may have the signal, i from 0; false: there is none.
bool columns_also(signal_id_t signal, int i, column_t *column);

// BAD_INPUT: not a columns file; names file, line, key and what is allowed. *c is kept.
MUST_CHECK done_t columns_read(const char *path, columns_t *c, why_t *why);

// The signal's name in columns files, and the SI unit of what is read.
const char *columns_name(signal_id_t signal);
const char *columns_si(const columns_t *c, signal_id_t signal);

// Bounds of what is plausible, in SI.
void columns_bounds(const columns_t *c, signal_id_t signal, double *min, double *max);

// The units in which a value (SI, as read) would lie in min..max, with the factors to them, as the end of a
// message: "; the unit mm would fit (factor 0.001)". Empty if there is none. Returns text.
#define COLUMNS_HINT 120
const char *columns_hint(const columns_t *c, signal_id_t signal, double value, double min, double max,
                         char text[COLUMNS_HINT]);

#endif
