// trajectory.h - trajectories of the high-level commander: pieces of polynomials of degree 7 in x, y, z and
// yaw, one after the other.
//
// Source: Mellinger and Kumar 2011; the format of pieces in the vehicle's memory, and how they are stretched,
// shifted, turned and flown backwards: bitcraze/crazyflie-firmware 2a18fc29, pptraj.c, pptraj_compressed.c.
// Own code.
#ifndef SIM_CRAZYFLIE_TRAJECTORY_H
#define SIM_CRAZYFLIE_TRAJECTORY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define TRAJECTORY_COEFFICIENTS 8

typedef enum { TRAJECTORY_X, TRAJECTORY_Y, TRAJECTORY_Z, TRAJECTORY_YAW, TRAJECTORY_AXES } trajectory_axis_t;

// Where to be at one time: m, m/s, m/s2 in world axes; yaw in rad, rad/s, rad/s2.
typedef struct {
  float at[TRAJECTORY_AXES], speed[TRAJECTORY_AXES], acc[TRAJECTORY_AXES];
} goal_t;

// As a client uploads it: 132 bytes of little-endian floats. c: of ascending powers of the s since its start.
typedef struct {
  float c[TRAJECTORY_AXES][TRAJECTORY_COEFFICIENTS];
  float duration_s;
} piece_t;

#define TRAJECTORY_PIECE_BYTES 132

// Returns the piece from one goal to another, with no jerk at either end (yaw with no acceleration either).
// duration_s <= 0: there at once.
piece_t piece_between(const goal_t *from, const goal_t *to, float duration_s);

// Returns the goal t_s after the start; t_s is not limited to the piece's duration.
goal_t piece_at(const piece_t *piece, float t_s);

typedef struct {
  const uint8_t *memory; // of size bytes: n_piece pieces, or a compressed trajectory
  size_t size;
  int n_piece;
  bool compressed;
  float timescale;  // 2: takes twice as long; 1 if compressed
  bool reversed;    // false if compressed
  float shift_m[3]; // added after the turn
  float turn_rad;   // turns the whole about the origin; not if reversed or compressed
} trajectory_t;

// Gives the goal t_s after the start; beyond the end, the end at rest. False: the memory does not hold
// such a trajectory, or a number is not finite.
bool trajectory_at(const trajectory_t *trajectory, float t_s, goal_t *goal);

float trajectory_duration_s(const trajectory_t *trajectory);

#endif
