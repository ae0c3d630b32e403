// crazyflie.h - a Crazyflie on the host: the app as it is compiled for the vehicle, between stand-ins of the
// firmware, and the firmware's way from a command to the motors' duty.
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
  glue_t app; // the app's state: to be looked at, and for faults to be put in
  stand_in_t around;
  // Plays controllerOutOfTree(); null: it itself. To look at the calls, or to have them answered elsewhere.
  void (*fly)(void *context, control_t *control, const setpoint_t *setpoint, const sensorData_t *sensors,
              const state_t *state, uint32_t step);
  void *fly_context;
  // Set points by the firmware's commander; null: those of pilot_in_t, new in every millisecond.
  setpoint_t (*command)(void *context, const state_t *state, uint32_t step);
  void *command_context;
  supervised_t supervised;
  supervised_param_t supervised_by;
  bool stop;           // a client asks for the emergency stop
  setpoint_t setpoint; // of the last millisecond
  sensorData_t sensors;
  state_t state;
  // Not for callers.
  stock_power_param_t firmware;
  bool compensates; // the firmware knows the propellers: a command is thrust, not duty
  thrust_map_t map; // of the vehicle
  stock_power_t power;
  control_t control;
  stock_pid_t stock;
  dq_t q_wb;              // that the angles in `state` are of
  bool ordered;           // `setpoint` is that of
  pilot_setpoint_t asked; // this one
  const pilot_in_t *now;  // during a call
  bool called;
  void (*bring_home)(void *context); // null: its state is here
  void *home_context;
  bool touched; // crazyflie_home() was called since its pilot looked
} crazyflie_t;

// A vehicle that is off: its app's parameters are at their defaults. The firmware is the one that was built
// for the model's thrust map; null: legacy propellers. It must stay where it is.
void crazyflie_init(crazyflie_t *c, const model_t *model);

// Switches it on, or the controller anew: as on the vehicle, all but parameters and their commits is fresh.
// Who flies it by pilot_in_t has waited until it was armed, or took over in flight: the first call tells.
void crazyflie_start(crazyflie_t *c);

// Whoever stands between sensors and pilot (plan_t.edit) and looks at the vehicle's state, changes it, or has
// the pilot called otherwise than once, says so first: it may fly with others (flight/together.h), and its
// state be with theirs. The pilot's step() is then called for it alone. The calls below say so themselves.
void crazyflie_home(crazyflie_t *c);

// One millisecond: sensors, estimate and set point through the firmware's units, the supervisor, the app,
// power distribution and battery compensation. Newton of each motor in free air, by the model's map at
// in->vbat_V. in->applied_N is what another controller did before, and counts in the first call alone.
void crazyflie_ms(crazyflie_t *c, const pilot_in_t *in, double motor_N[PILOT_MOTORS]);

// A parameter or log of the app, "group.name"; the whole number for those that are no floats.
// false: there is none of that name.
bool crazyflie_set(crazyflie_t *c, const char *name, double value);
bool crazyflie_param(const crazyflie_t *c, const char *name, double *value);
// All of the app's logs, in the order of sections_log_at(), into value[sections_logs()].
void crazyflie_logs(const crazyflie_t *c, float *value);
bool crazyflie_log(const crazyflie_t *c, const char *name, double *value);

// Where this vehicle has what a parameter's or log's address (sections.h) is of.
const void *crazyflie_at(const crazyflie_t *c, const void *address);

#endif
