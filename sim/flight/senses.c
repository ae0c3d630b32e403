// senses.c - one millisecond of sensors and estimator.
#include "flight/senses.h"

#include "base/either.h"
#include <math.h>

static void see(ekf_in_t *seen, const imu_sample_t *imu, const range_sample_t *range,
                const senses_drawn_t *drawn, bool motors) {
  seen->imu = *imu;
  seen->motors = motors;
  seen->range_new = range->down_new;
  seen->range_m = range->down_m;
  seen->flow_new = range->flow_new;
  seen->flow_x = range->flow_x;
  seen->flow_y = range->flow_y;
  seen->flow_span_s = range->flow_span_s;
  if (!drawn->by_mocap) return;
  seen->range_new = seen->flow_new = false;
  seen->pose_new = drawn->mocap.is_new;
  seen->pose_m = drawn->mocap.pos_w_m;
  seen->pose_q = drawn->mocap.q_wb;
}

void senses_take(senses_t *s, const imu_param_t *imu_param, const range_param_t *range_param,
                 const senses_drawn_t *drawn, const truth_t *truth, pilot_in_t *in) {
  const imu_sample_t imu = imu_take(&s->imu, imu_param, drawn->imu, truth);
  const range_sample_t range = range_take(&s->range, range_param, &drawn->range, truth);
  see(&s->seen, &imu, &range, drawn, truth->motors);
  // Taken before the update: it is what the update before this one finished.
  s->estimate = s->ekf.out;
  in->pos_w_m = s->ekf.out.pos_w_m;
  in->vel_w_mps = s->ekf.out.vel_w_mps;
  in->q_wb = s->ekf.out.q_wb;
  ekf_update(&s->ekf, &s->seen);
  in->gyro_b_radps = imu.gyro_b_radps;
  in->acc_b_mps2 = imu.acc_b_mps2;
  in->range_new = range.up_new;
  in->down_new = range.down_new;
  in->down_m = range.down_m;
  in->range_m = EITHER(range.up_mm >= RANGE_UP_NOTHING_MM, (double)NAN, 1e-3 * range.up_mm);
}
