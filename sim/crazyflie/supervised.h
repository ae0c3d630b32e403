// supervised.h - the firmware's supervisor: may the motors run, does it fly, has it crashed.
//
// A state machine that is updated at 25 Hz and that the stabilizer asks every millisecond. A vehicle with
// brushed motors arms itself. Source: bitcraze/crazyflie-firmware 2a18fc29, supervisor.c,
// supervisor_state_machine.c, for the Crazyflie 2.1: motor speeds are not measured, no deck reports a fault,
// crashes are not detected by acceleration.
#ifndef SIM_CRAZYFLIE_SUPERVISED_H
#define SIM_CRAZYFLIE_SUPERVISED_H

#include <stdbool.h>
#include <stdint.h>

#define SUPERVISED_PERIOD_MS 40

// X(name, words): in the firmware's order.
#define SUPERVISED_STATES(X)                                                                                 \
  X(BEGIN, "Not initialized")                                                                                \
  X(NOT_PASSED, "Pre-flight checks not passed")                                                              \
  X(PASSED, "Pre-flight checks passed")                                                                      \
  X(ARMING, "Arming")                                                                                        \
  X(READY, "Ready to fly")                                                                                   \
  X(FLYING, "Flying")                                                                                        \
  X(LANDED, "Landed")                                                                                        \
  X(RESET, "Reset")                                                                                          \
  X(LEVEL_OUT, "Warning, level out")                                                                         \
  X(FREE_FALL, "Exception, free fall")                                                                       \
  X(LOCKED, "Locked")                                                                                        \
  X(CRASHED, "Crashed")

#define SUPERVISED_NAME(name, words) SUPERVISED_##name,
typedef enum { SUPERVISED_STATES(SUPERVISED_NAME) SUPERVISED_COUNT } supervised_state_t;
#undef SUPERVISED_NAME

// What a client tunes: the firmware's parameters of group `supervisor`.
typedef struct {
  uint16_t preflight_ms; // armed for this long without flying: it is disarmed
  uint16_t landed_ms;    // landed for this long: it is disarmed, and armed anew
  uint8_t tumble_check;  // 0: a vehicle that lies tilted or upside down is not noticed
} supervised_param_t;

extern const supervised_param_t supervised_default;

typedef struct {
  uint32_t now_ms;
  bool motors;          // at least one is driven
  float acc_g[3];       // as measured, body
  uint32_t setpoint_ms; // time of arrival of the set point
  uint32_t fed_ms;      // when the emergency-stop watchdog was last fed; 0: it is not used
  bool stop;            // a client requests the emergency stop
} supervised_in_t;

typedef struct {
  supervised_state_t state;
  bool armed, crashed, tumbled;
  uint32_t tilted_ms, thrust_ms, armed_ms, landed_ms; // since when, thrust: when last; 0: never
} supervised_t;

// All zeros are the state after power-on.

// Returns the state of a vehicle that was switched on long before: armed on the ground, or in flight.
supervised_t supervised_begun(bool flies, uint32_t now_ms);

// Updates the state; to be called at 25 Hz. Returns true if the state has changed.
bool supervised_update(supervised_t *s, const supervised_param_t *p, const supervised_in_t *in);

// Flying, or levelling out.
static inline bool supervised_flies(const supervised_t *s) {
  return s->state == SUPERVISED_FLYING || s->state == SUPERVISED_LEVEL_OUT;
}
// Ready, flying, or landed.
static inline bool supervised_can_fly(const supervised_t *s) {
  return supervised_flies(s) || s->state == SUPERVISED_READY || s->state == SUPERVISED_LANDED;
}
// The motors are allowed to run. The vehicle stays armed while they are.
static inline bool supervised_motors_run(const supervised_t *s) {
  return supervised_can_fly(s) || s->state == SUPERVISED_ARMING;
}

// Requests of a client. False: refused.
bool supervised_arm(supervised_t *s, bool arm);
bool supervised_recover(supervised_t *s); // after a crash, standing upright

// Bits 0 to 7 of the log supervisor.info.
unsigned supervised_info(const supervised_t *s);

const char *supervised_words(supervised_state_t state);

#endif
