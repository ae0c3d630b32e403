// stabilizer_types.h - stand-in: what goes into the firmware's controllers and what comes out.
#ifndef CRAZYFLIE_STABILIZER_TYPES_H
#define CRAZYFLIE_STABILIZER_TYPES_H

#include <stdbool.h>
#include <stdint.h>

#define STABILIZER_NR_OF_MOTORS 4

typedef uint32_t stabilizerStep_t; // counts calls at 1 kHz

typedef struct {
  float x, y, z;
} Axis3f;

typedef struct {
  uint32_t timestamp;
  float x, y, z;
} point_t, velocity_t, acc_t;

typedef struct {
  uint32_t timestamp;
  float roll, pitch, yaw; // deg; pitch nose up positive
} attitude_t;

// The first component is x, not w.
typedef struct {
  float x, y, z, w;
} quaternion_t;

typedef struct sensorData_s {
  Axis3f acc;  // g
  Axis3f gyro; // deg/s
} sensorData_t;

typedef struct state_s {
  attitude_t attitude;
  quaternion_t attitudeQuaternion; // right-handed, body to world
  point_t position;                // m
  velocity_t velocity;             // m/s
  acc_t acc;                       // g, without gravity
} state_t;

typedef enum {
  controlModeLegacy,
  controlModeForceTorque,
  controlModeForce,
} control_mode_t;

typedef struct control_s {
  union {
    struct {
      int16_t roll, pitch, yaw;
      float thrust; // 0..65535
    };
    struct {
      float thrustSi;                  // N
      float torqueX, torqueY, torqueZ; // N m
    };
    float normalizedForces[STABILIZER_NR_OF_MOTORS]; // 0..1
  };
  control_mode_t controlMode;
} control_t;

typedef enum { modeDisable, modeAbs, modeVelocity } stab_mode_t;

typedef struct {
  stab_mode_t x, y, z, roll, pitch, yaw, quat;
} setpoint_mode_t;

typedef struct setpoint_s {
  uint32_t timestamp;
  attitude_t attitude;     // deg
  attitude_t attitudeRate; // deg/s
  quaternion_t attitudeQuaternion;
  float thrust;        // 0..65535
  point_t position;    // m
  velocity_t velocity; // m/s
  acc_t acceleration;  // m/s2
  bool velocity_body;
  setpoint_mode_t mode;
} setpoint_t;

#define RATE_MAIN_LOOP                 1000
#define ATTITUDE_RATE                  500
#define RATE_DO_EXECUTE(rate_Hz, step) ((step) % (RATE_MAIN_LOOP / (rate_Hz)) == 0)

#endif
