// rig3.h - a vehicle for tests of the outer loop, and the loop that flies it: a point mass with thrust along
// its body axis, thrust and tilt with a lag, below a ceiling with the thesis's curve.
#ifndef TEST_RIG_RIG3_H
#define TEST_RIG_RIG3_H

#include "flight/outer.h"

#define RIG3_PERIOD_S   0.01f
#define RIG3_NO_CEILING 1e3

typedef struct {
  double pos[3], vel[3], up[3]; // world
  double thrust_N, applied_N;
  double yaw, ceiling_m;
  int tick;
} rig3_t;

// In a hover at that place; 32 g.
rig3_t rig3_at(double x, double y, double z, double ceiling_m);

// Thrust ratio 1 + 0.44 exp(-80 zc).
double rig3_ratio(double zc_m);

// Moves it for one tick under the command.
void rig3_move(rig3_t *v, const outer_out_t *command);

// Attitude: the yaw first, then the turn from level to `up`.
quat_t rig3_attitude(const double up[3], double yaw);

// Perfect measurements; a range sample on every tenth tick.
outer_in_t rig3_sense(const rig3_t *v, v3_t goal_m);

// Default parameters but for mass and lag; a loop that has never flown.
flight_param_t rig3_param(void);
outer_t rig3_outer(const flight_param_t *p);

// One step of the loop and of its learning.
outer_out_t rig3_step(outer_t *f, const flight_param_t *p, const outer_in_t *in);

// Runs loop and vehicle for so many ticks; returns the last command.
outer_out_t rig3_fly(outer_t *f, const flight_param_t *p, rig3_t *v, v3_t goal_m, int ticks);

// A flight under way, 6 cm below the ceiling, that learns.
outer_t rig3_in_flight(flight_param_t *p, rig3_t *v);

// True if equal to the bit. The state is compared without the fault counters.
bool rig3_same_out(const outer_out_t *a, const outer_out_t *b);
bool rig3_same_state(const outer_t *a, const outer_t *b);

unsigned rig3_faults(const outer_t *f); // the sum of all counters

// True if within all limits of a command.
bool rig3_is_command(const outer_out_t *out, const flight_param_t *p);

#endif
