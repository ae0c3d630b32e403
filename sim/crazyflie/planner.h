// planner.h - the firmware's high-level commander: take off, land, go to, spiral, trajectories; at 100 Hz a
// set point on the way.
//
// Source: bitcraze/crazyflie-firmware 2a18fc29, crtp_commander_high_level.c, planner.c. Own code. Time is
// counted in milliseconds, not in a float, whose resolution falls as it grows.
#ifndef SIM_CRAZYFLIE_PLANNER_H
#define SIM_CRAZYFLIE_PLANNER_H

#include "stabilizer_types.h"
#include "trajectory.h"

#define PLANNER_PERIOD_MS    10
#define PLANNER_MEMORY       4096 // bytes of uploaded trajectories
#define PLANNER_TRAJECTORIES 10

typedef enum { PLANNER_IDLE, PLANNER_FLYING, PLANNER_LANDING, PLANNER_DISABLED } planner_state_t;

typedef struct {
  float takeoff_mps, landing_mps; // used where a command names no speed
  uint8_t groups;                 // that this vehicle is in, as bits
} planner_param_t;

extern const planner_param_t planner_default;

typedef struct {
  bool is_there;
  uint8_t type; // 0 pieces, 1 compressed
  uint32_t offset;
  uint8_t n_piece;
} planner_entry_t;

typedef struct {
  planner_param_t param;
  planner_state_t state;
  goal_t last;       // in flight the last set point, else the estimate
  trajectory_t path; // what is flown: in `memory`, or `own` (on_own)
  bool on_own;
  piece_t own;
  uint32_t begin_ms;
  bool blocked; // by the supervisor
  uint8_t memory[PLANNER_MEMORY];
  planner_entry_t entry[PLANNER_TRAJECTORIES];
} planner_t;

void planner_init(planner_t *p);

// Takes a command as it comes over the link, its number first; size bytes. Returns 0, or the error that the
// firmware answers: 16 blocked, 8 not known, too short or not valid, 1 not possible now.
int planner_command(planner_t *p, const uint8_t *command, int size, uint32_t now_ms);

// Lands at this speed, at height_m above the start or (relative) below the present height. Returns as
// planner_command.
int planner_land(planner_t *p, float height_m, float speed_mps, bool relative, uint32_t now_ms);

void planner_block(planner_t *p, bool block); // true: stops the flight, refuses new ones
void planner_disable(planner_t *p);           // no set points until a stop or a new flight
void planner_stop(planner_t *p);
void planner_tell(planner_t *p, const state_t *state); // the next command starts here

// To be called at 100 Hz. True: *set is a set point, all off while idle. False: disabled.
bool planner_setpoint(planner_t *p, const state_t *state, uint32_t now_ms, setpoint_t *set);

bool planner_active(const planner_t *p);
bool planner_finished(const planner_t *p, uint32_t now_ms);

#endif
