// trajectory.h - trajectories of the high-level commander: pieces of polynomials of degree 7 in x, y, z and
// yaw, one after the other.
//
// Source: Mellinger and Kumar 2011; what the pieces look like in the vehicle's memory, how they are
// stretched, shifted, turned and flown backwards: bitcraze/crazyflie-firmware 2a18fc29, pptraj.c,
// pptraj_compressed.c. Own code.
#ifndef SIM_CRAZYFLIE_TRAJECTORY_H
#define SIM_CRAZYFLIE_TRAJECTORY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define TRAJECTORY_COEFFICIENTS 8

typedef enum { TRAJECTORY_X, TRAJECTORY_Y, TRAJECTORY_Z, TRAJECTORY_YAW, TRAJECTORY_AXES } trajectory_axis_t;

// Where to be at a time: m, m/s, m/s2 in the world; rad, rad/s.
typedef struct {
  float at[TRAJECTORY_AXES], speed[TRAJECTORY_AXES], acc[TRAJECTORY_AXES];
} goal_t;

// As a client uploads it: little-endian floats, 132 bytes. Ascending powers of the seconds since its start.
typedef struct {
  float c[TRAJECTORY_AXES][TRAJECTORY_COEFFICIENTS];
  float duration_s;
} piece_t;

#define TRAJECTORY_PIECE_BYTES 132

// From one goal to another, without a jerk at both ends (yaw without acceleration either). duration_s <= 0:
// there at once.
piece_t piece_between(const goal_t *from, const goal_t *to, float duration_s);

// After t_s, not cut at its ends.
goal_t piece_at(const piece_t *piece, float t_s);

typedef struct {
  const uint8_t *memory; // of size bytes: n_piece pieces, or a compressed trajectory
  size_t size;
  int n_piece;
  bool compressed;
  float timescale;  // 2: takes twice as long; 1 if compressed
  bool reversed;    // not if compressed
  float shift_m[3]; // after the turn
  float turn_rad;   // of the whole, about the origin; not if reversed or compressed
} trajectory_t;

// t_s after its start; beyond its end it stands there. False: the memory does not hold such a trajectory.
bool trajectory_at(const trajectory_t *trajectory, float t_s, goal_t *goal);

float trajectory_duration_s(const trajectory_t *trajectory);

#endif
