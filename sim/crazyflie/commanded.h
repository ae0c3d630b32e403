// commanded.h - the firmware's commander: set points as they come over the link, how old the last one is, and
// which of several sources may set it.
//
// Source: bitcraze/crazyflie-firmware 2a18fc29, commander.c, crtp_commander*.c. Own code.
#ifndef SIM_CRAZYFLIE_COMMANDED_H
#define SIM_CRAZYFLIE_COMMANDED_H

#include "planner.h"

typedef enum { COMMANDED_NOBODY, COMMANDED_PLANNER, COMMANDED_CLIENT } commanded_priority_t;

// Parameters of group `flightmode`: the meaning of a game pad's roll, pitch, yaw and thrust.
typedef struct {
  uint8_t alt_hold, pos_hold, pos_set;        // 1: thrust is climb rate; roll, pitch: velocity; all: position
  uint8_t angle_roll, angle_pitch, angle_yaw; // 1: an angle, 0: a rate
} pad_param_t;

extern const pad_param_t pad_default;

typedef struct {
  planner_t planner;
  pad_param_t pad;
  bool pad_locked; // thrust is ignored until one of 0 was sent
  setpoint_t set;  // timestamp: time of arrival, ms
  state_t state;   // newest estimate
  commanded_priority_t priority;
} commanded_t;

void commanded_init(commanded_t *c);

// Take a packet's data, without its header: commanded_take of port 7 channel 0, commanded_take_pad of port 3.
// False: too short, of no known type, or not finite; then nothing has changed.
bool commanded_take(commanded_t *c, const uint8_t *data, int size, uint32_t now_ms);
bool commanded_take_pad(commanded_t *c, const uint8_t *data, int size, uint32_t now_ms);

// Lets the planner set points again.
void commanded_relax(commanded_t *c);

// Drops the priority of who set points last: whoever comes next may.
void commanded_let_go(commanded_t *c);

// Returns the set point to fly; called every millisecond by the stabilizer. can_fly: from the supervisor.
setpoint_t commanded_now(commanded_t *c, const state_t *state, bool can_fly, uint32_t step, uint32_t now_ms);

#endif
