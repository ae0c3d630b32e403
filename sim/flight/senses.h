// senses.h - one millisecond of sensors and estimator, from what is true to what the pilot gets.
//
// Random numbers are drawn beforehand, so that from there on one vehicle and eight at a time do the same.
#ifndef SIM_FLIGHT_SENSES_H
#define SIM_FLIGHT_SENSES_H

#include "crazyflie/pilot.h"
#include "sense/ekf.h"
#include "sense/mocap.h"
#include "sense/noise.h"
#include "sense/range.h"

typedef struct {
  imu_t imu;
  range_t range;
  ekf_in_t seen; // the pose is only there with motion capture
  ekf_t ekf;
  ekf_out_t estimate; // that was finished in the millisecond before
} senses_t;

typedef struct {
  double imu[IMU_DRAWN];
  range_drawn_t range;
  bool by_mocap; // in place of the downward sensors
  mocap_sample_t mocap;
} senses_drawn_t;

// Runs the millisecond. *in gets measurements, estimate, and which samples are new.
void senses_take(senses_t *s, const imu_param_t *imu, const range_param_t *range, const senses_drawn_t *drawn,
                 const truth_t *truth, pilot_in_t *in);

#endif
