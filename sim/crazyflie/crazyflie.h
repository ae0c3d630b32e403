// crazyflie.h - a Crazyflie on the host: the app as it is compiled for the vehicle, between stand-ins for the
// firmware, and the firmware's path from a command to the motors' duty.
//
// Several can fly at once, in one thread or in many; each has its own copy of the app's state.
#ifndef CRAZYFLIE_CRAZYFLIE_H
#define CRAZYFLIE_CRAZYFLIE_H

#include "crazyflie/stabilizer_types.h"
#include "crazyflie/stand_in.h"
#include "crazyflie/stock_pid.h"
#include "crazyflie/supervised.h"
#include "firmware/glue.h"
#include "vehicle/model.h"

typedef struct crazyflie {
  glue_t app; // the app's state: may be read, and given faults by tests
  stand_in_t around;
  // Called in place of controllerOutOfTree(), to watch the calls or to have another controller answer them;
  // null: controllerOutOfTree() itself.
  void (*fly)(void *context, control_t *control, const setpoint_t *setpoint, const sensorData_t *sensors,
              const state_t *state, uint32_t step);
  void *fly_context;
  // Set points of the firmware's commander; null: that of pilot_in_t, as if it were new every millisecond.
  setpoint_t (*command)(void *context, const state_t *state, uint32_t step);
  void *command_context;
  supervised_t supervised;
  supervised_param_t supervised_by;
  bool stop;           // a client requests the emergency stop
  setpoint_t setpoint; // of the last millisecond
  sensorData_t sensors;
  state_t state;
  // Not for callers.
  stock_power_param_t firmware;
  bool compensates; // the firmware knows the propellers, so that a command is thrust; else it is duty
  thrust_map_t map; // of the vehicle
  stock_power_t power;
  control_t control;
  stock_pid_t stock;
  dq_t q_wb;              // attitude from which the angles in `state` were computed
  bool ordered;           // `setpoint` is `asked`, converted
  pilot_setpoint_t asked; // the pilot's set point that was converted last
  const pilot_in_t *now;  // input of the running call
  bool called;
  void (*bring_home)(void *context); // brings the state back here; null: it is here
  void *home_context;
  bool touched; // crazyflie_home() was called since the pilot last checked
} crazyflie_t;

// Makes *c a vehicle that is switched off, with the app's parameters at their defaults. The firmware is the
// build for the model's thrust map; model null: the build for legacy propellers. *c must stay where it is.
void crazyflie_init(crazyflie_t *c, const model_t *model);

// Switches the vehicle on, or restarts its controller: as on the vehicle, only parameters and their commits
// are kept. Where set points come from pilot_in_t, the vehicle is armed on the ground or already in flight,
// whichever applied_N of the first crazyflie_ms() shows.
void crazyflie_start(crazyflie_t *c);

// Brings the vehicle's state into *c. While the vehicle flies together with others (flight/together.h), its
// state lies with theirs. Code between sensors and pilot (plan_t.edit) therefore calls this before it reads
// or changes the state, or calls the pilot other than once. The pilot's step() is then called for this
// vehicle alone. crazyflie_start() and crazyflie_set() call it themselves.
void crazyflie_home(crazyflie_t *c);

// Runs one millisecond: converts sensors, estimate and set point to the firmware's units, then runs
// supervisor, app, power distribution and battery compensation. motor_N: thrust of each motor in free air, N,
// by the model's map at in->vbat_V. in->applied_N, the output of the controller before, is used in the first
// call only.
void crazyflie_ms(crazyflie_t *c, const pilot_in_t *in, double motor_N[PILOT_MOTORS]);

// Write or read a parameter, or read a log, of the app by its name "group.name"; the value is a whole number
// unless the type is float. False: there is none of that name.
bool crazyflie_set(crazyflie_t *c, const char *name, double value);
bool crazyflie_param(const crazyflie_t *c, const char *name, double *value);
// Copies all of the app's logs into value[sections_logs()], in the order of sections_log_at().
void crazyflie_logs(const crazyflie_t *c, float *value);
bool crazyflie_log(const crazyflie_t *c, const char *name, double *value);

// Returns the place of a parameter or log in this vehicle; address: from sections.h.
const void *crazyflie_at(const crazyflie_t *c, const void *address);

#endif
