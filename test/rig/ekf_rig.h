// ekf_rig.h - the estimator behind its sensors, on vehicles that follow a prescribed path.
#ifndef TEST_RIG_EKF_RIG_H
#define TEST_RIG_EKF_RIG_H

#include "rig/kinematic.h"
#include "sense/ekf.h"
#include "sense/noise.h"

#define DEG (3.14159265358979323846 / 180.0)

typedef struct {
  imu_t imu;
  range_t range;
  ekf_t ekf;
  random_t *random;
  noise_t noise;
} ekf_rig_t;

// With the noise of that name; the caller closes `random`.
ekf_rig_t ekf_rig(const char *level, uint64_t seed);

// Sets the estimator to the truth.
void ekf_rig_place(ekf_rig_t *r, const truth_t *t);

// One millisecond of sensors and estimator.
ekf_out_t ekf_rig_tick(ekf_rig_t *r, const truth_t *truth);
// The same `ms` times, at the same truth.
ekf_out_t ekf_rig_stay(ekf_rig_t *r, const truth_t *truth, int ms);

// Errors of one flight: root mean squares, largest, last and mean.
typedef struct {
  double z_m, climb_mps, side_mps, tilt_rad, yaw_rad, z_max_m, xy_end_m, z_mean_m, climb_mean_mps;
} ekf_errors_t;

// Adds one sample's squares and sums.
void ekf_rig_compare(ekf_errors_t *e, const ekf_out_t *out, const truth_t *truth);

// Follows a path from its start; compares from from_s to to_s.
ekf_errors_t ekf_rig_follow(ekf_rig_t *r, const kinematic_t *path, double from_s, double to_s);

// At rest, up by 0.5 m, sideways by 0.7 m, a turn by 2 rad.
extern const kinematic_t ekf_rig_hover, ekf_rig_climb, ekf_rig_step, ekf_rig_turn;

// A level vehicle that nothing accelerates, motors on.
truth_t ekf_rig_level(double z_m, d3_t vel_w_mps, d3_t rate_b_radps);

#endif
