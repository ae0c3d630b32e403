// ekf_core.h - the steps of the extended Kalman filter of ekf.h; for ekf.c alone. Formulas there.
#ifndef SIM_SENSE_EKF_CORE_H
#define SIM_SENSE_EKF_CORE_H

#include "sense/ekf.h"

#define EKF_G_MPS2 9.81

// Brings e->R up to date with e->q.
void ekf_core_rotation(ekf_t *e);

// Adds the process noise of the e->noise_ms that are due.
void ekf_core_noise(ekf_t *e);

// State and variance dt_s later; acc and gyro: means over that time.
void ekf_core_predict(ekf_t *e, d3_t acc_b_mps2, d3_t gyro_b_radps, double dt_s, bool flying);

void ekf_core_range(ekf_t *e, double range_m);
void ekf_core_flow(ekf_t *e, double counts_x, double counts_y, double span_s);
void ekf_core_pose(ekf_t *e, d3_t pos_w_m, dq_t q_wb);

// Shifts the attitude error into the attitude, if anything has changed.
void ekf_core_finish(ekf_t *e);

#endif
