// log_motors.h - what a log says of its motors, as newton of each in free air.
#ifndef SIM_LOGS_LOG_MOTORS_H
#define SIM_LOGS_LOG_MOTORS_H

#include "base/error.h"
#include "logs/columns.h"
#include "vehicle/model.h"

typedef enum {
  LOG_MOTORS_NONE,      // nothing, or nothing that the vehicle can convert to newton
  LOG_MOTORS_TOTAL,     // thrust of all in newton
  LOG_MOTORS_TOTAL_PWM, // the mean command
  LOG_MOTORS_EACH,      // m1..m4 in newton
  LOG_MOTORS_MAP,       // m1..m4 through the vehicle's map
  LOG_MOTORS_MIX,       // thrust and torques in newton and Nm
  LOG_MOTORS_MIX_PWM,   // thrust and torques in pwm
} log_motors_kind_t;

typedef struct {
  log_motors_kind_t kind;
  bool total_logged;       // v[SIG_THRUST] is the log's own, whatever else there is
  double unmix[ROTORS][4]; // newton of each rotor per newton and Nm
} log_motors_t;

// `has`: signals that the rows have; those that the motors add are set in it. lacks: why the log's motor
// commands cannot be converted to newton; empty: they can.
#define LOG_MOTORS_LACKS 200
void log_motors_init(log_motors_t *m, const columns_t *columns, const model_t *vehicle, signals_t *has,
                     char lacks[LOG_MOTORS_LACKS]);

// Fills v[SIG_THRUST], v[SIG_F*] and, from a mix in pwm, v[SIG_M*]. True if a motor is at its limit.
bool log_motors_fill(const log_motors_t *m, const columns_t *columns, const model_t *vehicle,
                     double v[SIG_COUNT]);

#endif
