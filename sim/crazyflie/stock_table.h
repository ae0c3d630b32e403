// stock_table.h - the stock firmware's own parameters and logs that clients and scripts look for, beside
// those of the app.
//
// Names and types: bitcraze/crazyflie-firmware 2a18fc29. Logs of sensors that the host does not have
// (magnetometer, barometer) read 0.
#ifndef SIM_CRAZYFLIE_STOCK_TABLE_H
#define SIM_CRAZYFLIE_STOCK_TABLE_H

#include "stock_pid.h"
#include <stddef.h>

#define STOCK_U8  PARAM_UINT8
#define STOCK_U16 PARAM_UINT16
#define STOCK_U32 PARAM_UINT32
#define STOCK_F   PARAM_FLOAT
#define STOCK_RO  PARAM_RONLY
#define STOCK_P   PARAM_PERSISTENT

// A gain's three numbers: kp, ki, kd.
#define STOCK_GAINS(X, group, axis, p, i, d)                                                                 \
  X(group, axis##p, float, STOCK_F | STOCK_P, 0)                                                             \
  X(group, axis##i, float, STOCK_F | STOCK_P, 0)                                                             \
  X(group, axis##d, float, STOCK_F | STOCK_P, 0)

// X(group, name, C type, type and bits, initial value). Gains start as stock_pid_default() has them.
#define STOCK_PARAMS(X)                                                                                      \
  X(deck, bcFlow2, uint8_t, STOCK_U8 | STOCK_RO, 1)                                                          \
  X(deck, bcMultiranger, uint8_t, STOCK_U8 | STOCK_RO, 1)                                                    \
  X(deck, bcZRanger, uint8_t, STOCK_U8 | STOCK_RO, 0)                                                        \
  X(deck, bcZRanger2, uint8_t, STOCK_U8 | STOCK_RO, 0)                                                       \
  X(deck, bcFlow, uint8_t, STOCK_U8 | STOCK_RO, 0)                                                           \
  X(deck, bcLighthouse4, uint8_t, STOCK_U8 | STOCK_RO, 0)                                                    \
  X(deck, bcLoco, uint8_t, STOCK_U8 | STOCK_RO, 0)                                                           \
  X(deck, bcDWM1000, uint8_t, STOCK_U8 | STOCK_RO, 0)                                                        \
  X(deck, bcLedRing, uint8_t, STOCK_U8 | STOCK_RO, 0)                                                        \
  X(deck, bcColorLedTop, uint8_t, STOCK_U8 | STOCK_RO, 0)                                                    \
  X(deck, bcColorLedBot, uint8_t, STOCK_U8 | STOCK_RO, 0)                                                    \
  X(deck, bcBuzzer, uint8_t, STOCK_U8 | STOCK_RO, 0)                                                         \
  X(deck, bcAI, uint8_t, STOCK_U8 | STOCK_RO, 0)                                                             \
  X(deck, bcUSD, uint8_t, STOCK_U8 | STOCK_RO, 0)                                                            \
  X(firmware, revision0, uint32_t, STOCK_U32 | STOCK_RO, 0x2a18fc29)                                         \
  X(firmware, revision1, uint16_t, STOCK_U16 | STOCK_RO, 0)                                                  \
  X(firmware, modified, uint8_t, STOCK_U8 | STOCK_RO, 0)                                                     \
  X(imu_sensors, BMP3XX, uint8_t, STOCK_U8 | STOCK_RO, 0)                                                    \
  X(imu_sensors, imuPsi, float, STOCK_F | STOCK_P, 0)                                                        \
  X(imu_sensors, imuTheta, float, STOCK_F | STOCK_P, 0)                                                      \
  X(imu_sensors, imuPhi, float, STOCK_F | STOCK_P, 0)                                                        \
  X(stabilizer, estimator, uint8_t, STOCK_U8, 2)                                                             \
  X(stabilizer, controller, uint8_t, STOCK_U8, 6)                                                            \
  X(stabilizer, stop, uint8_t, STOCK_U8, 0)                                                                  \
  X(supervisor, infdmp, uint8_t, STOCK_U8, 0)                                                                \
  X(supervisor, prefltTimeout, uint16_t, STOCK_U16 | STOCK_P, 30000)                                         \
  X(supervisor, landedTimeout, uint16_t, STOCK_U16 | STOCK_P, 3000)                                          \
  X(supervisor, tmblChckEn, uint8_t, STOCK_U8 | STOCK_P, 1)                                                  \
  X(commander, enHighLevel, uint8_t, STOCK_U8, 1)                                                            \
  X(hlCommander, vtoff, float, STOCK_F, 0.5f)                                                                \
  X(hlCommander, vland, float, STOCK_F, 0.5f)                                                                \
  X(hlCommander, groupmask, uint8_t, STOCK_U8, 0)                                                            \
  X(flightmode, althold, uint8_t, STOCK_U8, 0)                                                               \
  X(flightmode, poshold, uint8_t, STOCK_U8, 0)                                                               \
  X(flightmode, posSet, uint8_t, STOCK_U8, 0)                                                                \
  X(flightmode, yawMode, uint8_t, STOCK_U8, 2)                                                               \
  X(flightmode, stabModeRoll, uint8_t, STOCK_U8, 1)                                                          \
  X(flightmode, stabModePitch, uint8_t, STOCK_U8, 1)                                                         \
  X(flightmode, stabModeYaw, uint8_t, STOCK_U8, 0)                                                           \
  X(kalman, resetEstimation, uint8_t, STOCK_U8, 0)                                                           \
  X(kalman, initialX, float, STOCK_F, 0)                                                                     \
  X(kalman, initialY, float, STOCK_F, 0)                                                                     \
  X(kalman, initialZ, float, STOCK_F, 0)                                                                     \
  X(kalman, initialYaw, float, STOCK_F, 0)                                                                   \
  X(motorPowerSet, enable, uint8_t, STOCK_U8, 0)                                                             \
  X(pm, lowVoltage, float, STOCK_F | STOCK_P, 3.2f)                                                          \
  X(pm, criticalLowVoltage, float, STOCK_F | STOCK_P, 3.0f)                                                  \
  X(led, bitmask, uint8_t, STOCK_U8, 0)                                                                      \
  X(ring, effect, uint8_t, STOCK_U8 | STOCK_P, 6)                                                            \
  X(ring, neffect, uint32_t, STOCK_U32 | STOCK_RO, 18)                                                       \
  X(ring, solidRed, uint8_t, STOCK_U8, 20)                                                                   \
  X(ring, solidGreen, uint8_t, STOCK_U8, 20)                                                                 \
  X(ring, solidBlue, uint8_t, STOCK_U8, 20)                                                                  \
  X(ring, headlightEnable, uint8_t, STOCK_U8, 0)                                                             \
  X(ring, emptyCharge, float, STOCK_F, 3.1f)                                                                 \
  X(ring, fullCharge, float, STOCK_F, 4.2f)                                                                  \
  X(ring, fadeColor, uint32_t, STOCK_U32, 0)                                                                 \
  X(ring, fadeTime, float, STOCK_F, 0.5f)                                                                    \
  X(activeMarker, front, uint8_t, STOCK_U8 | STOCK_P, 1)                                                     \
  X(activeMarker, back, uint8_t, STOCK_U8 | STOCK_P, 3)                                                      \
  X(activeMarker, left, uint8_t, STOCK_U8 | STOCK_P, 4)                                                      \
  X(activeMarker, right, uint8_t, STOCK_U8 | STOCK_P, 2)                                                     \
  X(activeMarker, mode, uint8_t, STOCK_U8 | STOCK_P, 3)                                                      \
  X(activeMarker, poll, uint8_t, STOCK_U8, 0)                                                                \
  X(sound, effect, uint8_t, STOCK_U8 | STOCK_P, 0)                                                           \
  X(system, selftestPassed, int8_t, PARAM_INT8 | STOCK_RO, 1)                                                \
  X(system, taskDump, uint8_t, STOCK_U8, 0)                                                                  \
  X(system, assertInfo, uint8_t, STOCK_U8, 0)                                                                \
  X(system, storageStats, uint8_t, STOCK_U8, 0)                                                              \
  X(health, startPropTest, uint8_t, STOCK_U8, 0)                                                             \
  X(health, startBatTest, uint8_t, STOCK_U8, 0)                                                              \
  X(cpu, flash, uint16_t, STOCK_U16 | STOCK_RO, 1024)                                                        \
  X(velCtlPid, vxKFF, float, STOCK_F | STOCK_P, 0)                                                           \
  X(velCtlPid, vyKFF, float, STOCK_F | STOCK_P, 0)                                                           \
  STOCK_GAINS(X, pid_attitude, roll_, kp, ki, kd)                                                            \
  STOCK_GAINS(X, pid_attitude, pitch_, kp, ki, kd)                                                           \
  STOCK_GAINS(X, pid_attitude, yaw_, kp, ki, kd)                                                             \
  STOCK_GAINS(X, pid_rate, roll_, kp, ki, kd)                                                                \
  STOCK_GAINS(X, pid_rate, pitch_, kp, ki, kd)                                                               \
  STOCK_GAINS(X, pid_rate, yaw_, kp, ki, kd)                                                                 \
  STOCK_GAINS(X, posCtlPid, x, Kp, Ki, Kd)                                                                   \
  STOCK_GAINS(X, posCtlPid, y, Kp, Ki, Kd)                                                                   \
  STOCK_GAINS(X, posCtlPid, z, Kp, Ki, Kd)                                                                   \
  STOCK_GAINS(X, velCtlPid, vx, Kp, Ki, Kd)                                                                  \
  STOCK_GAINS(X, velCtlPid, vy, Kp, Ki, Kd)                                                                  \
  STOCK_GAINS(X, velCtlPid, vz, Kp, Ki, Kd)

#define STOCK_XYZ(X, group)                                                                                  \
  X(group, x, float, LOG_FLOAT) X(group, y, float, LOG_FLOAT) X(group, z, float, LOG_FLOAT)
#define STOCK_RANGE(X, name)        X(range, name, uint16_t, LOG_UINT16)
#define STOCK_FLOAT(X, group, name) X(group, name, float, LOG_FLOAT)
#define STOCK_RPY(X, group, a, b, c)                                                                         \
  STOCK_FLOAT(X, group, a) STOCK_FLOAT(X, group, b) STOCK_FLOAT(X, group, c)

// X(group, name, C type, type)
#define STOCK_LOGS(X)                                                                                        \
  STOCK_XYZ(X, stateEstimate)                                                                                \
  STOCK_RPY(X, stateEstimate, vx, vy, vz)                                                                    \
  STOCK_RPY(X, stateEstimate, ax, ay, az)                                                                    \
  STOCK_RPY(X, stateEstimate, roll, pitch, yaw)                                                              \
  STOCK_RPY(X, stateEstimate, qx, qy, qz)                                                                    \
  STOCK_FLOAT(X, stateEstimate, qw)                                                                          \
  STOCK_RPY(X, stabilizer, roll, pitch, yaw)                                                                 \
  STOCK_FLOAT(X, stabilizer, thrust)                                                                         \
  STOCK_XYZ(X, ctrltarget)                                                                                   \
  STOCK_RPY(X, ctrltarget, vx, vy, vz)                                                                       \
  STOCK_RPY(X, ctrltarget, ax, ay, az)                                                                       \
  STOCK_RPY(X, ctrltarget, roll, pitch, yaw)                                                                 \
  STOCK_RPY(X, controller, cmd_roll, cmd_pitch, cmd_yaw)                                                     \
  STOCK_FLOAT(X, controller, cmd_thrust)                                                                     \
  STOCK_RPY(X, controller, r_roll, r_pitch, r_yaw)                                                           \
  STOCK_RPY(X, controller, roll, pitch, yaw)                                                                 \
  STOCK_RPY(X, controller, rollRate, pitchRate, yawRate)                                                     \
  STOCK_FLOAT(X, controller, accelz)                                                                         \
  STOCK_FLOAT(X, controller, actuatorThrust)                                                                 \
  X(controller, ctr_yaw, int16_t, LOG_INT16)                                                                 \
  STOCK_RPY(X, posCtl, targetX, targetY, targetZ)                                                            \
  STOCK_RPY(X, posCtl, targetVX, targetVY, targetVZ)                                                         \
  X(motor, m1, uint16_t, LOG_UINT16)                                                                         \
  X(motor, m2, uint16_t, LOG_UINT16)                                                                         \
  X(motor, m3, uint16_t, LOG_UINT16)                                                                         \
  X(motor, m4, uint16_t, LOG_UINT16)                                                                         \
  X(motor, m1req, int32_t, LOG_INT32)                                                                        \
  X(motor, m2req, int32_t, LOG_INT32)                                                                        \
  X(motor, m3req, int32_t, LOG_INT32)                                                                        \
  X(motor, m4req, int32_t, LOG_INT32)                                                                        \
  STOCK_FLOAT(X, pm, vbat)                                                                                   \
  X(pm, vbatMV, uint16_t, LOG_UINT16)                                                                        \
  STOCK_FLOAT(X, pm, chargeCurrent)                                                                          \
  X(pm, state, int8_t, LOG_INT8)                                                                             \
  X(pm, batteryLevel, uint8_t, LOG_UINT8)                                                                    \
  X(sys, canfly, uint8_t, LOG_UINT8)                                                                         \
  X(sys, isFlying, uint8_t, LOG_UINT8)                                                                       \
  X(sys, isTumbled, uint8_t, LOG_UINT8)                                                                      \
  X(supervisor, info, uint16_t, LOG_UINT16)                                                                  \
  STOCK_FLOAT(X, supervisor, accNorm)                                                                        \
  STOCK_RANGE(X, front)                                                                                      \
  STOCK_RANGE(X, back)                                                                                       \
  STOCK_RANGE(X, up)                                                                                         \
  STOCK_RANGE(X, left)                                                                                       \
  STOCK_RANGE(X, right)                                                                                      \
  STOCK_RANGE(X, zrange)                                                                                     \
  STOCK_XYZ(X, acc)                                                                                          \
  STOCK_XYZ(X, gyro)                                                                                         \
  STOCK_XYZ(X, mag)                                                                                          \
  STOCK_RPY(X, baro, asl, temp, pressure)                                                                    \
  STOCK_RPY(X, kalman, stateX, stateY, stateZ)                                                               \
  STOCK_RPY(X, kalman, statePX, statePY, statePZ)                                                            \
  STOCK_RPY(X, kalman, varX, varY, varZ)                                                                     \
  STOCK_RPY(X, kalman, varPX, varPY, varPZ)                                                                  \
  X(motion, deltaX, int16_t, LOG_INT16)                                                                      \
  X(motion, deltaY, int16_t, LOG_INT16)                                                                      \
  X(motion, squal, uint8_t, LOG_UINT8)                                                                       \
  X(radio, rssi, uint8_t, LOG_UINT8)                                                                         \
  X(radio, isConnected, uint8_t, LOG_UINT8)                                                                  \
  X(crtp, rxRate, uint16_t, LOG_UINT16)                                                                      \
  X(crtp, txRate, uint16_t, LOG_UINT16)

#define STOCK_PARAM_FIELD(group, name, c_type, ...) c_type group##_##name;
#define STOCK_LOG_FIELD(group, name, c_type, type)  c_type group##_##name;
typedef struct {
  STOCK_PARAMS(STOCK_PARAM_FIELD)
} stock_params_t;
typedef struct {
  STOCK_LOGS(STOCK_LOG_FIELD)
} stock_logs_t;
#undef STOCK_PARAM_FIELD
#undef STOCK_LOG_FIELD

typedef struct {
  const char *group, *name;
  int type; // param.h, log.h
  size_t offset;
} stock_row_t;

extern const stock_row_t stock_param_rows[], stock_log_rows[];
extern const int stock_param_count, stock_log_count;

stock_params_t stock_params_default(void);

// Copies the gains of the table to the stock PID.
void stock_params_take_gains(const stock_params_t *p, stock_pid_param_t *pid);

#endif
