// stand_in.h - what lies behind the stand-ins of the firmware's headers in this folder: one vehicle's
// surroundings.
//
// The headers beside this one have the firmware's names and hold our own text: what src/firmware uses of
// them, as bitcraze/crazyflie-firmware 2a18fc29 documents it. They stand in the include path of src/firmware
// and of this folder alone.
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
  float thrust_max_N;                   // of one motor: what a command of 1 stands for
  uint16_t range_mm[STAND_IN_RANGES];   // by rangeDirection_t
  bool can_fly, flying, motors_allowed; // as the supervisor says
  float volt_N[STAND_IN_VOLT_N];        // thrust of a motor by its voltage: the firmware's cubic
  float battery_V;                      // as last measured
  uint16_t duty[STAND_IN_MOTORS];       // of the motors in the last millisecond
  bool has_flow, has_multiranger, has_usd;
  bool no_usd_driver; // the image does not know that deck
  // What the firmware tells the client of a parameter; null: nobody listens.
  void (*told)(void *context, const struct section_param *param, double value);
  void *told_context;
  // The stock controller (number 1); null: it commands nothing.
  void (*stock)(void *context, struct control_s *control, const struct setpoint_s *setpoint,
                const struct sensorData_s *sensors, const struct state_s *state, uint32_t step);
  void *stock_context;
  int stock_starts; // how often it was told to begin
  // The uSD deck takes an event; null: there is no deck, or it does not write.
  void (*event)(void *context, const char *name);
  void *event_context;
  uint32_t fed_ms, clock_ms; // of the watchdog, last; now
  bool no_landing;           // the high-level commander refuses
  int landings, relaxed;     // how often it was asked for one, and the priority given back
  float landing_mps, landing_m;
  // The firmware's commander and planner, where they are there; null: asked for, and counted, in vain.
  void (*relax)(void *context);
  int (*land)(void *context, float height_m, float speed_mps, bool relative);
  void *commander_context;
  bool clocked;                                 // the vehicle moves its clock; else vTaskDelay does
  void (*delay)(void *context, uint32_t ticks); // vTaskDelay; null: returns at once
  void *delay_context;
  char console[STAND_IN_CONSOLE]; // what was printed, its end if it was more
} stand_in_t;

// The vehicle that this thread flies now.
extern _Thread_local stand_in_t *stand_in;

// The app's static state is this vehicle's copy of it.
void *stand_in_own(const stand_in_t *around, const void *address);

void stand_in_print(const char *format, ...) __attribute__((format(printf, 1, 2)));

#endif
