// faults_motion.c - faults of the inertial sensors and of the estimate.
#include "faults/faults.h"

static double *field_of(pilot_in_t *in, unsigned pick) {
  double *const field[] = {&in->gyro_b_radps.x, &in->gyro_b_radps.z, &in->acc_b_mps2.x, &in->acc_b_mps2.z,
                           &in->pos_w_m.x,      &in->pos_w_m.z,      &in->vel_w_mps.y,  &in->vel_w_mps.z,
                           &in->q_wb.w,         &in->q_wb.z,         &in->range_m};
  return field[pick % (sizeof field / sizeof *field)];
}
static void nan_field(case_t *c, pilot_in_t *in, double since_s) {
  (void)since_s;
  c->frozen_weights = true;
  *field_of(in, c->pick) = (double)NAN;
}
static void nan_inertial(case_t *c, pilot_in_t *in, double since_s) {
  (void)since_s;
  c->frozen_weights = true;
  *field_of(in, c->pick % 10) = (double)NAN;
}
static void odd_field(case_t *c, pilot_in_t *in, double since_s) {
  (void)since_s;
  static const double odd[] = {HUGE_VAL, -HUGE_VAL, 1e38, -1e38, 1e-42};
  *field_of(in, c->pick) = odd[(c->pick >> 8) % 5];
}
static void acc_bias(case_t *c, pilot_in_t *in, double since_s) {
  (void)since_s;
  in->acc_b_mps2.z += c->pick % 2 ? c->size : -c->size;
}
// Before the flight, because a flight copies its sensors at the beginning: a later change would have no
// effect.
static void sensor_bias(case_t *c) {
  c->plan.noise.imu.acc_bias_b_mps2.z = c->pick % 2 ? c->size : -c->size;
}
static void acc_stuck(case_t *c, pilot_in_t *in, double since_s) {
  if (since_s < 5e-4) c->kept3 = in->acc_b_mps2;
  in->acc_b_mps2 = c->kept3;
}
static void acc_clipped(case_t *c, pilot_in_t *in, double since_s) {
  (void)since_s;
  in->acc_b_mps2.z = c->pick % 2 ? 235.4 : -235.4;
}
static void worn_propeller(case_t *c) {
  c->plan.noise.imu.acc_xy_mps2 *= 5.0;
  c->plan.noise.imu.acc_z_mps2 *= 5.0;
}
static void gyro_zero(case_t *c, pilot_in_t *in, double since_s) {
  (void)c, (void)since_s;
  in->gyro_b_radps = (d3_t){0.0, 0.0, 0.0};
}
static void gyro_full(case_t *c, pilot_in_t *in, double since_s) {
  (void)since_s;
  *field_of(in, c->pick % 2) = c->pick & 4 ? 34.9 : -34.9;
}
static void attitude_wild(case_t *c, pilot_in_t *in, double since_s) {
  (void)since_s;
  const double half = 0.5 * (c->pick % 2 ? 1.4 : 1.75);
  in->q_wb = (dq_t){cos(half), c->pick & 4 ? sin(half) : 0.0, c->pick & 4 ? 0.0 : sin(half), 0.0};
}
static void height_jump(case_t *c, pilot_in_t *in, double since_s) {
  (void)since_s;
  in->pos_w_m.z += c->pick % 2 ? c->size : -c->size;
}
static void height_drift(case_t *c, pilot_in_t *in, double since_s) {
  in->pos_w_m.z -= c->size * since_s;
}
static void attitude_scale(case_t *c, pilot_in_t *in, double since_s) {
  (void)since_s;
  in->q_wb = (dq_t){c->size * in->q_wb.w, c->size * in->q_wb.x, c->size * in->q_wb.y, c->size * in->q_wb.z};
}
static void velocity_noise(case_t *c, pilot_in_t *in, double since_s) {
  (void)since_s;
  in->vel_w_mps.x += 5.0 * random_normal(c->r);
  in->vel_w_mps.y += 5.0 * random_normal(c->r);
  in->vel_w_mps.z += 5.0 * random_normal(c->r);
}

// --- criteria of their own --------------------------------------------------------------------------------

static const char *weights_kept(const case_t *c, const flown_fault_t *usual) {
  (void)usual;
  const bool range = c->row->edit == nan_field && c->pick % 11 == 10; // a NaN range need not stop it
  return c->seen.weights_moved && !range ? "weights" : NULL;
}
static const char *steady_offset(const case_t *c, const flown_fault_t *usual) {
  const double offset_m = faults_mean_m(c, &c->seen) - faults_mean_m(c, usual);
  return fabs(offset_m) > 0.01 ? "offset" : NULL;
}
static const char *weights_stay(const case_t *c, const flown_fault_t *usual) {
  return c->seen.weight_change > fmax(0.01, 1.5 * usual->weight_change) ? "weights" : NULL;
}
static const char *upright_at_cut(const case_t *c, const flown_fault_t *usual) {
  (void)usual;
  return c->seen.tilt_cut_deg > 60.0 ? "tilt" : NULL;
}
static const char *bounded_step(const case_t *c, const flown_fault_t *usual) {
  (void)usual;
  return c->seen.ahead_N > (double)c->param.step_max_N * 1.001 ? "step" : NULL;
}
static const char *distance_2_cm(const case_t *c, const flown_fault_t *usual) {
  (void)usual;
  return c->seen.zc_error_m > 0.02 ? "distance" : NULL;
}

#define EVER FAULTS_EVER
static const row_t rows[] = {
    {"0 nothing", 'A', 0.06, 0.1, 0.2, 0, 0, NULL, 0, 0, 100, NULL, NULL, 0, false, false},
    {"1 NaN, 1 to 10 ms", 'A', 0.06, 0.001, 0.01, 0, 0, nan_field, 0, 0, 100, NULL, weights_kept, 0, false,
     false},
    {"2 NaN beyond 60 ms", 'C', 0.06, 0.06, 0.5, 0, 0, nan_inertial, GUARD_NOT_A_NUMBER, 0.03, 100, NULL,
     weights_kept, 0, false, false},
    {"3 Inf, 1e38, denormal, 1 to 10 ms", 'A', 0.06, 0.001, 0.01, 0, 0, odd_field, 0, 0, 99.9, NULL, NULL, 0,
     false, false},
    {"6 accelerometer +- 0.6 to 1 m/s2", 'A', 0.06, EVER, EVER, 0.6, 1.0, acc_bias, GUARD_ACC_BIAS, 0.5, 100,
     NULL, steady_offset, 4, false, false},
    {"6 accelerometer +- 0 to 0.6 m/s2", 'A', 0.06, EVER, EVER, 0.0, 0.6, acc_bias, 0, 0, 100, NULL,
     steady_offset, 4, false, false},
    {"6 likewise, the estimator sees it too", 'A', 0.10, EVER, EVER, 0.0, 1.0, NULL, 0, 0, 82, sensor_bias,
     steady_offset, 4, false, true},
    {"7 accelerometer stuck 2 s", 'B', 0.06, 2, 2, 0, 0, acc_stuck, GUARD_ACC_FROZEN, 0.05, 100, NULL, NULL,
     0, false, false},
    {"8 accelerometer clipped 100 ms", 'A', 0.06, 0.1, 0.1, 0, 0, acc_clipped, GUARD_ACC_CLIPPED, 0.03, 100,
     NULL, weights_stay, 0, false, false},
    {"9 accelerometer noise x 5", 'A', 0.06, EVER, EVER, 0, 0, NULL, 0, 0, 97.5, worn_propeller, NULL, 0,
     false, false},
    {"10 gyro zero 20 ms", 'A', 0.06, 0.02, 0.02, 0, 0, gyro_zero, 0, 0, 100, NULL, NULL, 0, false, false},
    {"10 gyro zero 200 ms", 'C', 0.06, 0.2, 0.2, 0, 0, gyro_zero, GUARD_GYRO_FROZEN, 0.03, 100, NULL,
     upright_at_cut, 0, false, false},
    {"11 gyro saturated 10 to 30 ms", 'A', 0.06, 0.01, 0.03, 0, 0, gyro_full, GUARD_NOT_A_NUMBER, 0.03, 99.9,
     NULL, NULL, 1.0, false, false},
    {"38 attitude 80 to 100 deg", 'C', 0.06, EVER, EVER, 0, 0, attitude_wild, GUARD_TILT, 0.03, 100, NULL,
     bounded_step, 0, false, false},
    {"45 height jumps", 'A', 0.06, EVER, EVER, 0.05, 0.3, height_jump, GUARD_HEIGHT_JUMP, 0.03, 100, NULL,
     distance_2_cm, 0, false, false},
    {"46 height drifts 2 cm/s", 'B', 0.06, EVER, EVER, 0.02, 0.02, height_drift, GUARD_TOO_NEAR | GUARD_BLIND,
     4.5, 100, NULL, NULL, 0, false, false},
    {"47 quaternion x 0 to 2", 'A', 0.06, 0.02, 0.02, 0, 2, attitude_scale, 0, 0, 100, NULL, NULL, 0, false,
     false},
    {"48 velocity garbage", 'B', 0.06, 1, 1, 0, 0, velocity_noise, GUARD_VELOCITY, 0.03, 100, NULL, NULL, 0,
     false, false},
};

rows_t faults_of_motion(void) {
  return (rows_t){rows, (int)(sizeof rows / sizeof *rows)};
}
