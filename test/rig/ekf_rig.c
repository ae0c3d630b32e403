// ekf_rig.c - the estimator behind its sensors, on vehicles that follow a prescribed path.
#include "rig/ekf_rig.h"

#include <math.h>

ekf_rig_t ekf_rig(const char *level, uint64_t seed) {
  ekf_rig_t r = {.noise = *noise_find(level), .random = random_open(seed)};
  imu_init(&r.imu);
  range_init(&r.range);
  ekf_init(&r.ekf, &ekf_firmware, 0.0);
  return r;
}

static ekf_in_t sense(ekf_rig_t *r, const truth_t *truth) {
  const imu_sample_t imu = imu_step(&r->imu, &r->noise.imu, r->random, truth);
  const range_sample_t range = range_step(&r->range, &r->noise.range, r->random, truth);
  return (ekf_in_t){.imu = imu,
                    .motors = truth->motors,
                    .range_new = range.down_new,
                    .range_m = range.down_m,
                    .flow_new = range.flow_new,
                    .flow_x = range.flow_x,
                    .flow_y = range.flow_y,
                    .flow_span_s = range.flow_span_s};
}

ekf_out_t ekf_rig_tick(ekf_rig_t *r, const truth_t *truth) {
  const ekf_in_t in = sense(r, truth);
  return ekf_step(&r->ekf, &in);
}

ekf_out_t ekf_rig_stay(ekf_rig_t *r, const truth_t *truth, int ms) {
  ekf_out_t out = r->ekf.out;
  for (int i = 0; i < ms; i++) out = ekf_rig_tick(r, truth);
  return out;
}

void ekf_rig_place(ekf_rig_t *r, const truth_t *t) {
  ekf_place(&r->ekf, t->pos_w_m, t->vel_w_mps, t->q_wb);
}

void ekf_rig_compare(ekf_errors_t *e, const ekf_out_t *out, const truth_t *truth) {
  const d3_t dp = d3_sub(out->pos_w_m, truth->pos_w_m), dv = d3_sub(out->vel_w_mps, truth->vel_w_mps);
  const dq_t q = truth->q_wb, dq = dq_mul(out->q_wb, (dq_t){q.w, -q.x, -q.y, -q.z});
  e->z_m += dp.z * dp.z;
  e->climb_mps += dv.z * dv.z;
  e->side_mps += dv.x * dv.x + dv.y * dv.y;
  e->tilt_rad += 4.0 * (dq.x * dq.x + dq.y * dq.y);
  e->yaw_rad += 4.0 * dq.z * dq.z;
  e->z_mean_m += dp.z;
  e->climb_mean_mps += dv.z;
  e->z_max_m = fmax(e->z_max_m, fabs(dp.z));
  e->xy_end_m = hypot(dp.x, dp.y);
}

ekf_errors_t ekf_rig_follow(ekf_rig_t *r, const kinematic_t *path, double from_s, double to_s) {
  ekf_errors_t e = {0};
  const truth_t start = kinematic_at(path, 0.0);
  ekf_rig_place(r, &start);
  int n = 0;
  for (int ms = 0; ms < 1000.0 * to_s; ms++) {
    const truth_t truth = kinematic_at(path, 1e-3 * ms);
    const ekf_out_t out = ekf_rig_tick(r, &truth);
    if (ms < 1000.0 * from_s) continue;
    ekf_rig_compare(&e, &out, &truth);
    n++;
  }
  double *const mean_square[] = {&e.z_m, &e.climb_mps, &e.side_mps, &e.tilt_rad, &e.yaw_rad};
  for (unsigned i = 0; i < sizeof mean_square / sizeof *mean_square; i++)
    *mean_square[i] = sqrt(*mean_square[i] / n);
  e.z_mean_m /= n;
  e.climb_mean_mps /= n;
  return e;
}

const kinematic_t ekf_rig_hover = {
    .span_s = 1.0, .from_m = {0, 0, 0.3}, .to_m = {0, 0, 0.3}, .ceiling_m = 0.5};
const kinematic_t ekf_rig_climb = {
    .start_s = 1.0, .span_s = 2.0, .from_m = {0, 0, 0.1}, .to_m = {0, 0, 0.6}, .ceiling_m = 0.8};
const kinematic_t ekf_rig_step = {
    .start_s = 1.0, .span_s = 1.5, .from_m = {0, 0, 0.4}, .to_m = {0.6, 0.3, 0.4}, .ceiling_m = 0.8};
const kinematic_t ekf_rig_turn = {.start_s = 1.0,
                                  .span_s = 3.0,
                                  .from_m = {0, 0, 0.4},
                                  .to_m = {0, 0, 0.4},
                                  .yaw_to_rad = 2.0,
                                  .ceiling_m = 0.8};

truth_t ekf_rig_level(double z_m, d3_t vel, d3_t rate) {
  return (truth_t){.pos_w_m = {0.0, 0.0, z_m},
                   .vel_w_mps = vel,
                   .q_wb = {1.0, 0.0, 0.0, 0.0},
                   .rate_b_radps = rate,
                   .force_b_mps2 = {0.0, 0.0, 9.81},
                   .up_m = HUGE_VAL,
                   .down_m = z_m,
                   .motors = true};
}
