// stand_in.h - one vehicle's surroundings: the state behind the stand-ins for the firmware's headers in this
// folder.
//
// The stand-ins beside this header have the names of the firmware's headers. Their text is our own: what
// src/firmware uses, as bitcraze/crazyflie-firmware 2a18fc29 documents it. They stand in the include path of
// src/firmware and its tests, of this folder, and of sim/link, sim/drone and sim/desk.
#ifndef CRAZYFLIE_STAND_IN_H
#define CRAZYFLIE_STAND_IN_H

#include <stdbool.h>
#include <stdint.h>

#define STAND_IN_RANGES  6
#define STAND_IN_CONSOLE 2048
#define STAND_IN_MOTORS  4
#define STAND_IN_VOLT_N  4

struct section_param;
struct control_s;
struct setpoint_s;
struct sensorData_s;
struct state_s;

typedef struct stand_in {
  void *app;                            // the app's glue_t
  float thrust_max_N;                   // of one motor at a command of 1
  uint16_t range_mm[STAND_IN_RANGES];   // indexed by rangeDirection_t
  bool can_fly, flying, motors_allowed; // from the supervisor
  float volt_N[STAND_IN_VOLT_N];        // the firmware's cubic from a motor's voltage to its thrust
  float battery_V;                      // as last measured
  uint16_t duty[STAND_IN_MOTORS];       // of the motors in the last millisecond
  bool has_flow, has_multiranger, has_usd;
  bool no_usd_driver; // the firmware was built without a driver for the uSD deck
  // Called when the firmware tells the client of a parameter; null: nobody listens.
  void (*told)(void *context, const struct section_param *param, double value);
  void *told_context;
  // The stock controller (number 1); null: it commands nothing.
  void (*stock)(void *context, struct control_s *control, const struct setpoint_s *setpoint,
                const struct sensorData_s *sensors, const struct state_s *state, uint32_t step);
  void *stock_context;
  int stock_starts; // calls of controllerPidInit()
  // Called with each event for the uSD deck; null: there is no deck, or it does not write.
  void (*event)(void *context, const char *name);
  void *event_context;
  uint32_t fed_ms, clock_ms; // when the watchdog was last fed; now
  bool no_landing;           // without `land`: the high-level commander refuses to land
  int landings, relaxed;     // calls for a landing at an absolute height; of the priority given back
  float landing_mps, landing_m;
  // The firmware's commander and planner; null: the call is counted, and has no other effect.
  void (*relax)(void *context);
  int (*land)(void *context, float height_m, float speed_mps, bool relative);
  void *commander_context;
  bool clocked;                                 // the vehicle advances the clock; else vTaskDelay does
  void (*delay)(void *context, uint32_t ticks); // vTaskDelay; null: returns at once
  void *delay_context;
  char console[STAND_IN_CONSOLE]; // what was printed; its end if it was too long
} stand_in_t;

// The vehicle that this thread flies now.
extern _Thread_local stand_in_t *stand_in;

// Returns the place in this vehicle's copy of the app's state that has this address in glue_static.
void *stand_in_own(const stand_in_t *around, const void *address);

void stand_in_print(const char *format, ...) __attribute__((format(printf, 1, 2)));

#endif
