// firmware.h - the firmware around the app, as a client meets it: commander, planner and supervisor, the
// choice of the controller, the app's own task, and all parameters and logs by number.
//
//   link -> commander, planner -> supervisor -> app (6), stock PID (1), stock INDI (3) -> power distribution
//
// in the order of the firmware's stabilizer task, every millisecond. Source: bitcraze/crazyflie-firmware
// 2a18fc29, stabilizer.c. Controllers that the host does not have (2, 4, 5) are refused, with a word on the
// console.
#ifndef SIM_CRAZYFLIE_FIRMWARE_H
#define SIM_CRAZYFLIE_FIRMWARE_H

#include "commanded.h"
#include "crazyflie.h"
#include "stock_indi.h"
#include "stock_table.h"
#include "task_switch.h"

enum { CONTROLLER_AUTO = 0, CONTROLLER_PID = 1, CONTROLLER_INDI = 3, CONTROLLER_APP = 6 };

typedef struct {
  const stock_row_t *param, *log;
  int n_param, n_log;
  void *(*params)(void *context); // base address of the rows' offsets
  void *(*logs)(void *context);
  const double *param_default;               // n_param numbers
  void (*written)(void *context, int param); // after a client wrote this row of `param`; may change the value
} firmware_more_t;

typedef struct firmware {
  crazyflie_t vehicle;
  commanded_t commanded;
  stock_indi_t indi;
  stock_params_t params;
  stock_logs_t logs;
  bool emergency; // requested over the link; lasts until power-off
  // Set by whoever simulates it, beside pilot_in_t.
  float variance[6]; // of the estimator: position x, y, z, velocity x, y, z
  // Parameters and logs of the simulation, not of the firmware; null: none.
  const firmware_more_t *more;
  void *more_context;
  // Called with the number of a parameter that was changed on board, to tell the client; null: nobody
  // listens.
  void (*changed)(void *context, int param);
  void *changed_context;
  // Called when the app calls vTaskDelay() outside its own task, in a parameter's callback; may call
  // firmware_ms() ms times. Null: the delay returns at once.
  void (*rest)(void *context, uint32_t ms);
  void *rest_context;
  // Not for callers.
  task_switch_t *task;
  uint8_t runs;     // CONTROLLER_*
  uint32_t good_ms; // when the battery was last at pm.lowVoltage or above
  stock_params_t params_default;
  glue_t app_default;
} firmware_t;

// Makes *f a vehicle that is switched on. model: as in crazyflie_init. *f must stay where it is. FAILED: no
// memory.
MUST_CHECK done_t firmware_open(firmware_t *f, const model_t *model, why_t *why);
// Starts the vehicle: to be called before its first millisecond, once stored parameters are in place.
void firmware_start(firmware_t *f);
void firmware_close(firmware_t *f);

// Runs one millisecond, as crazyflie_ms does, with the commander's set point: in->set is not used.
void firmware_ms(firmware_t *f, const pilot_in_t *in, double motor_N[PILOT_MOTORS]);

// Passes a high-level command to planner_command and returns its result.
int firmware_high_level(firmware_t *f, const uint8_t *data, int size);

uint32_t firmware_now_ms(const firmware_t *f);

// The log supervisor.info.
uint16_t firmware_info(const firmware_t *f);

// Takes at most size - 1 characters of what was printed and not yet taken; returns how many.
int firmware_console(firmware_t *f, char *text, int size);

// --- parameters and logs by number, 0 and on ---------------------------------------------------------------

typedef struct {
  const char *group, *name;
  int type; // param.h, log.h
} firmware_row_t;

int firmware_params(const firmware_t *f);
int firmware_logs(const firmware_t *f);
firmware_row_t firmware_param_row(const firmware_t *f, int i);
firmware_row_t firmware_log_row(const firmware_t *f, int i);
int firmware_param_find(const firmware_t *f, const char *full_name); // -1: none
int firmware_log_find(const firmware_t *f, const char *full_name);

double firmware_param(const firmware_t *f, int i);
double firmware_param_default(const firmware_t *f, int i);
// Writes the value as the stored memory does at power-on: no callback is called.
void firmware_param_put(firmware_t *f, int i, double value);
// Writes the value as a client does: the callback of the app or of `more` is called.
void firmware_param_set(firmware_t *f, int i, double value);

// Brings the stock firmware's logs up to date. firmware_log() then returns values of one instant.
void firmware_look(firmware_t *f);
double firmware_log(const firmware_t *f, int i);

#endif
