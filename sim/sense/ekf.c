// ekf.c - the estimator's schedule and output.
#include "sense/ekf.h"

#include "base/either.h"
#include "base/pair.h"
#include <math.h>

#define PREDICT_MS   10
#define FLIGHT_MS    2000 // a flight goes on for this long after the motors stop
#define POS_MAX_M    100.0
#define VEL_MAX_MPS  10.0
#define RANGE_MAX_M  5.0
#define COUNTS_MAX   100.0
#define FIRST_POS_XY 10.0 // m; the firmware's 100 m, cut to the largest variance
#define FIRST_POS_Z  1.0  // m
#define FIRST_VEL    0.01 // m/s
#define FIRST_ANGLE  0.01 // rad

const ekf_param_t ekf_firmware = {.acc_xy_mps2 = 0.5,
                                  .acc_z_mps2 = 1.0,
                                  .gyro_radps = 0.1,
                                  .range_m = 0.0025,
                                  .flow_counts = 2.0,
                                  .pose_m = 0.01,
                                  .pose_rad = 0.06,
                                  .reversion = 0.001};

static void expect(ekf_t *e, double xy_m, double z_m) {
  const double sd[EKF_N] = {xy_m,      xy_m,        z_m,         FIRST_VEL,  FIRST_VEL,
                            FIRST_VEL, FIRST_ANGLE, FIRST_ANGLE, FIRST_ANGLE};
  for (int i = 0; i < EKF_N; i++)
    for (int j = 0; j < EKF_N; j++) e->P[i][j] = i == j ? sd[i] * sd[i] : 0.0;
}

static void hand_out(ekf_t *e) {
  e->out.pos_w_m = d3_of(e->s);
  e->out.vel_w_mps = dq_to_world(e->q, d3_of(e->s + 3));
  e->out.q_wb = e->q;
}

void ekf_init(ekf_t *e, const ekf_param_t *p, double yaw_rad) {
  *e = (ekf_t){.param = *p, .q_start = {cos(0.5 * yaw_rad), 0.0, 0.0, sin(0.5 * yaw_rad)}};
  e->q = e->q_start;
  e->imu.acc_b_mps2.z = G_MPS2;
  ekf_core_rotation(e);
  expect(e, FIRST_POS_XY, FIRST_POS_Z);
  hand_out(e);
}

void ekf_place(ekf_t *e, d3_t pos_w_m, d3_t vel_w_mps, dq_t q_wb) {
  const d3_t v = dq_to_body(q_wb, vel_w_mps);
  const double s[EKF_N] = {pos_w_m.x, pos_w_m.y, pos_w_m.z, v.x, v.y, v.z, 0.0, 0.0, 0.0};
  for (int i = 0; i < EKF_N; i++) e->s[i] = s[i];
  e->q = q_wb;
  e->imu.acc_b_mps2 = dq_to_body(q_wb, (d3_t){0.0, 0.0, G_MPS2});
  e->flying_ms = FLIGHT_MS;
  ekf_core_rotation(e);
  expect(e, 1e-3, 1e-3);
  hand_out(e);
  e->updated = true; // so that bounds are checked
}

// As the firmware, with the mean of the samples since the last prediction. Without new ones, the firmware
// would use the last mean.
static void predict_if_due(ekf_t *e) {
  if (e->countdown_ms-- > 0) return;
  e->countdown_ms = PREDICT_MS - 1;
  if (e->samples == 0) return;
  const double share = 1.0 / e->samples;
  ekf_core_noise(e);
  ekf_core_predict(e, d3_scale(share, e->sum.acc_b_mps2), d3_scale(share, e->sum.gyro_b_radps),
                   1e-3 * e->samples, e->flying_ms > 0);
  e->sum = (imu_sample_t){{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  e->samples = 0;
}

static void take(ekf_t *e, const ekf_in_t *in) {
  e->imu = in->imu;
  e->sum.acc_b_mps2 = d3_add(e->sum.acc_b_mps2, in->imu.acc_b_mps2);
  e->sum.gyro_b_radps = d3_add(e->sum.gyro_b_radps, in->imu.gyro_b_radps);
  e->samples++;
  if (in->range_new && in->range_m < RANGE_MAX_M) ekf_core_range(e, in->range_m);
  if (in->flow_new && fabs(in->flow_x) < COUNTS_MAX && fabs(in->flow_y) < COUNTS_MAX)
    ekf_core_flow(e, in->flow_x, in->flow_y, in->flow_span_s);
  if (in->pose_new) ekf_core_pose(e, in->pose_m, in->pose_q);
}

static bool within_bounds(const ekf_t *e) {
  for (int i = 0; i < 3; i++)
    if (!(fabs(e->s[i]) <= POS_MAX_M && fabs(e->s[3 + i]) <= VEL_MAX_MPS)) return false;
  return true;
}

static void start_anew(ekf_t *e) {
  const ekf_t before = *e;
  ekf_init(e, &before.param, 0.0);
  e->q = e->q_start = before.q_start;
  ekf_core_rotation(e);
  e->flying_ms = before.flying_ms;
  e->resets = before.resets + 1;
}

PAIR_COPIES void ekf_update(ekf_t *e, const ekf_in_t *in) {
  e->flying_ms = EITHER(in->motors, FLIGHT_MS, EITHER(e->flying_ms > 0, e->flying_ms - 1, e->flying_ms));
  predict_if_due(e);
  e->noise_ms++;
  take(e, in);
  if (!e->updated) return; // in seven of eight milliseconds the output stays
  ekf_core_finish(e);
  if (!within_bounds(e)) start_anew(e);
  hand_out(e);
}

ekf_out_t ekf_step(ekf_t *e, const ekf_in_t *in) {
  const ekf_out_t finished = e->out;
  ekf_update(e, in);
  return finished;
}
