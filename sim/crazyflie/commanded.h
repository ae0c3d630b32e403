// commanded.h - the firmware's commander: set points as they come over the link, how old the last one is, and
// who of several may set it.
//
// Source: bitcraze/crazyflie-firmware 2a18fc29, commander.c, crtp_commander*.c. Own code.
#ifndef SIM_CRAZYFLIE_COMMANDED_H
#define SIM_CRAZYFLIE_COMMANDED_H

#include "planner.h"

typedef enum { COMMANDED_NOBODY, COMMANDED_PLANNER, COMMANDED_CLIENT } commanded_priority_t;

// Of group `flightmode`: how a game pad's roll, pitch, yaw and thrust are taken.
typedef struct {
  uint8_t alt_hold, pos_hold, pos_set;        // thrust is a climb; roll and pitch are speeds; all are places
  uint8_t angle_roll, angle_pitch, angle_yaw; // 1: an angle, 0: a rate
} pad_param_t;

extern const pad_param_t pad_default;

typedef struct {
  planner_t planner;
  pad_param_t pad;
  bool pad_locked; // until a thrust of 0 was sent
  setpoint_t set;  // timestamp: when it came, ms
  state_t state;   // newest estimate
  commanded_priority_t priority;
} commanded_t;

void commanded_init(commanded_t *c);

// A packet's data, without its header: of port 7 channel 0, of port 3. False: too short, or of no known type;
// then nothing has changed.
bool commanded_take(commanded_t *c, const uint8_t *data, int size, uint32_t now_ms);
bool commanded_take_pad(commanded_t *c, const uint8_t *data, int size, uint32_t now_ms);

// From now on the planner may set points again.
void commanded_relax(commanded_t *c);

// Nobody sets points any more: the next who does may.
void commanded_let_go(commanded_t *c);

// Every millisecond, in the stabilizer: what is to be flown. can_fly: the supervisor's.
setpoint_t commanded_now(commanded_t *c, const state_t *state, bool can_fly, uint32_t step, uint32_t now_ms);

#endif
