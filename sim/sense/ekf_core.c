// ekf_core.c - prediction and corrections of the extended Kalman filter.
#include "sense/ekf.h"

#include "base/constants.h"
#include "base/either.h"
#include "base/larger.h"
#include "base/few.h"
#include <math.h>
#include <string.h>

enum { POS = 0, VEL = 3, ATT = 6 }; // first index of each part of the state

#define VARIANCE_MAX     100.0
#define VARIANCE_MIN     1e-6
#define PIXELS_PER_RAD   (35.0 / 0.71674) // of the flow camera: pixels across over aperture
#define PIXELS_PER_COUNT 0.1
#define FLOW_NEAREST_M   0.1
#define RANGE_HALF_CONE  (7.5 * PI / 180.0) // rad, of the sensor's view
#define UP_LEAST         0.1                // cosine of the largest tilt at which a range is used
#define TURN_LEAST_RAD   1e-4               // smaller corrections of the attitude are lost

static double at_most(double p) {
  return where(p < VARIANCE_MAX, p, VARIANCE_MAX); // also if NaN
}

// Limits a diagonal element.
static double bounded(double p) {
  const double most = at_most(p);
  return where(most > VARIANCE_MIN, most, VARIANCE_MIN);
}

// Stores row i of the covariance from its diagonal on, a few numbers at a time and the rest in pairs; so one
// element left of the diagonal may change, too.
static inline void put_row(ekf_t *e, alike_t i, const double row[EKF_ROW]) {
  alike_t j = i & ~1;
  for (; j + FEW_N <= EKF_ROW; j += FEW_N)
    few_put(e->P[i] + j, few_min(few_of(row + j), few_all(VARIANCE_MAX)));
  for (; j < EKF_ROW; j += 2) pair_put(e->P[i] + j, pair_min(pair_of(row + j), pair_both(VARIANCE_MAX)));
  e->P[i][i] = bounded(e->P[i][i]);
}

// Fills the whole covariance from its upper triangle.
static inline void whole_of(const ekf_t *e, double P[EKF_N][EKF_ROW]) {
  for (int i = 0; i < EKF_N; i++) {
    for (int j = 0; j < i; j++) P[i][j] = e->P[j][i];
    for (int j = i; j < EKF_ROW; j++) P[i][j] = e->P[i][j];
  }
}

static d3_t part(const ekf_t *e, alike_t at) {
  return (d3_t){e->s[at], e->s[at + 1], e->s[at + 2]};
}

static void add(ekf_t *e, alike_t at, d3_t v) {
  e->s[at] += v.x;
  e->s[at + 1] += v.y;
  e->s[at + 2] += v.z;
}

// [v]: the matrix with [v] a = v x a.
static void cross_matrix(d3_t v, double m[3][3]) {
  const double rows[3][3] = {{0.0, -v.z, v.y}, {v.z, 0.0, -v.x}, {-v.y, v.x, 0.0}};
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) m[i][j] = rows[i][j];
}

void ekf_core_rotation(ekf_t *e) {
  const d3_t x = dq_to_world(e->q, (d3_t){1.0, 0.0, 0.0}), y = dq_to_world(e->q, (d3_t){0.0, 1.0, 0.0}),
             z = d3_cross(x, y);
  const double R[3][3] = {{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}};
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) e->R[i][j] = R[i][j];
}

void ekf_core_noise(ekf_t *e) {
  const double ms = 1e-3, n = e->noise_ms, xy = e->param.acc_xy_mps2, z = e->param.acc_z_mps2,
               turn = e->param.gyro_radps;
  const double sd[EKF_N] = {xy * ms * ms, xy * ms * ms, z * ms * ms, xy * ms,  xy * ms,
                            z * ms,       turn * ms,    turn * ms,   turn * ms};
  for (int i = 0; i < EKF_N; i++) e->P[i][i] = bounded(e->P[i][i] + n * sd[i] * sd[i]);
  e->noise_ms = 0;
}

// I - [h] + (h h' - |h|^2 I) / 2: turns the attitude error when the body turns by h.
static void turn_matrix(d3_t h, double m[3][3]) {
  const double v[3] = {h.x, h.y, h.z}, square = d3_dot(h, h);
  cross_matrix(h, m);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) m[i][j] = (i == j ? 1.0 - 0.5 * square : 0.0) - m[i][j] + 0.5 * v[i] * v[j];
}

// Linearised propagation of the state's error: A, and its transpose, across[k][j] = A[j][k]. A is 0 below its
// 3 x 3 diagonal blocks. The first of these, for the position, is the identity and is stored in neither.
typedef struct {
  double A[EKF_N][EKF_N];
  _Alignas(16) double across[EKF_N][EKF_ROW];
} slopes_t;

static inline void slope(slopes_t *s, alike_t i, alike_t k, double value) {
  s->A[i][k] = s->across[k][i] = value;
}

static void linearise(const ekf_t *e, d3_t gyro, double dt, slopes_t *s) {
  double v[3][3], w[3][3], u[3][3], turn[3][3];
  cross_matrix(part(e, VEL), v);
  cross_matrix(gyro, w);
  cross_matrix((d3_t){e->R[2][0], e->R[2][1], e->R[2][2]}, u);
  turn_matrix(d3_scale(0.5 * dt, gyro), turn); // half the angle, as in the firmware
  memset(s->across, 0, sizeof s->across);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      slope(s, POS + i, VEL + j, dt * e->R[i][j]);
      slope(s, POS + i, ATT + j, -dt * (e->R[i][0] * v[0][j] + e->R[i][1] * v[1][j] + e->R[i][2] * v[2][j]));
      slope(s, VEL + i, VEL + j, (i == j ? 1.0 : 0.0) - dt * w[i][j]);
      slope(s, VEL + i, ATT + j, -dt * G_MPS2 * u[i][j]);
      slope(s, ATT + i, ATT + j, turn[i][j]);
    }
}

// own + a M for a row a of the part POS, VEL or ATT: the columns from that part on, skipping a's zero blocks.
// Most of the estimator's time is spent here.
static inline void row_times(alike_t part, const double *own, const double *a, double M[EKF_N][EKF_ROW],
                             double *out) {
  const alike_t from = part == ATT ? ATT : VEL;
  alike_t j = part & ~1;
  for (; j + FEW_N <= EKF_ROW; j += FEW_N) {
    few_t sum = part == POS ? few_of(own + j) : few_all(0.0);
    for (int k = from; k < EKF_N; k++) sum += a[k] * few_of(M[k] + j);
    few_put(out + j, sum);
  }
  for (; j < EKF_ROW; j += 2) {
    pair_t sum = part == POS ? pair_of(own + j) : pair_both(0.0);
    for (int k = from; k < EKF_N; k++) sum += a[k] * pair_of(M[k] + j);
    pair_put(out + j, sum);
  }
}

static inline void spread_part(ekf_t *e, alike_t part, slopes_t *s, double P[EKF_N][EKF_ROW]) {
  for (int i = part; i < part + 3; i++) {
    _Alignas(16) double half[EKF_ROW], own[EKF_ROW] = {0.0}, row[EKF_ROW];
    row_times(part, P[i], s->A[i], P, half);
    if (part == POS) memcpy(own, half, 3 * sizeof *own);
    row_times(part, own, half, s->across, row);
    put_row(e, i, row);
  }
}

// Replaces the covariance by A P A'.
static void spread(ekf_t *e, slopes_t *s, double P[EKF_N][EKF_ROW]) {
  spread_part(e, POS, s, P);
  spread_part(e, VEL, s, P);
  spread_part(e, ATT, s, P);
}

static d3_t to_world(const ekf_t *e, d3_t v) {
  return (d3_t){e->R[0][0] * v.x + e->R[0][1] * v.y + e->R[0][2] * v.z,
                e->R[1][0] * v.x + e->R[1][1] * v.y + e->R[1][2] * v.z,
                e->R[2][0] * v.x + e->R[2][1] * v.y + e->R[2][2] * v.z};
}

PAIR_COPIES void ekf_core_predict(ekf_t *e, d3_t acc, d3_t gyro, double dt, bool flying) {
  _Alignas(16) double P[EKF_N][EKF_ROW];
  slopes_t slopes;
  whole_of(e, P);
  linearise(e, gyro, dt, &slopes);
  spread(e, &slopes, P);
  // In flight the accelerometer tells nothing of the tilt, and thrust is along the body's z axis.
  if (flying) acc.x = acc.y = 0.0;
  const d3_t v = part(e, VEL), u = {e->R[2][0], e->R[2][1], e->R[2][2]};
  const d3_t way_b = d3_add(d3_scale(dt, v), d3_scale(0.5 * dt * dt, acc));
  add(e, POS, d3_sub(to_world(e, way_b), (d3_t){0.0, 0.0, 0.5 * dt * dt * G_MPS2}));
  add(e, VEL, d3_scale(dt, d3_sub(d3_sub(acc, d3_cross(gyro, v)), d3_scale(G_MPS2, u))));
  dq_t q = dq_mul(e->q, dq_turn(d3_scale(dt, gyro)));
  if (!flying) q = dq_towards(q, e->q_start, e->param.reversion);
  e->q = dq_unit(q);
  e->updated = true;
}

static double variance(const ekf_t *e, alike_t i, alike_t j) {
  return i < j ? e->P[i][j] : e->P[j][i];
}

// Corrects by one measured number: error = measured - h, where h has slope a in state i and b in state j.
static void correct(ekf_t *e, alike_t i, double a, alike_t j, double b, double error, double sd) {
  _Alignas(16) double Ph[EKF_ROW] = {0.0}, row[EKF_ROW];
  for (int k = 0; k < EKF_N; k++) Ph[k] = variance(e, k, i) * a + variance(e, k, j) * b;
  const double inverse = 1.0 / (a * Ph[i] + b * Ph[j] + sd * sd);
  for (int k = 0; k < EKF_N; k++) {
    const double gain = Ph[k] * inverse;
    e->s[k] += gain * error;
    alike_t l = k & ~1;
    for (; l + FEW_N <= EKF_ROW; l += FEW_N) few_put(row + l, few_of(e->P[k] + l) - gain * few_of(Ph + l));
    for (; l < EKF_ROW; l += 2) pair_put(row + l, pair_of(e->P[k] + l) - gain * pair_of(Ph + l));
    put_row(e, k, row);
  }
  e->updated = true;
}

PAIR_COPIES void ekf_core_range(ekf_t *e, double range_m) {
  const double up = e->R[2][2];
  if (!(up > UP_LEAST)) return;
  ekf_core_noise(e);
  // The sensor sees the nearest ground within its cone.
  const double slant = 1.0 / cos(larger(acos(smaller(up, 1.0)) - RANGE_HALF_CONE, 0.0));
  const double sd = e->param.range_m * (1.0 + exp(log(80.0) / 1.5 * (range_m - 2.5)));
  correct(e, POS + 2, slant, POS, 0.0, range_m - slant * e->s[POS + 2], sd);
}

PAIR_COPIES void ekf_core_flow(ekf_t *e, double counts_x, double counts_y, double span_s) {
  ekf_core_noise(e);
  const double k = span_s * PIXELS_PER_RAD, z = larger(e->s[POS + 2], FLOW_NEAREST_M), up = e->R[2][2];
  const double sd = e->param.flow_counts * PIXELS_PER_COUNT;
  const double vx = e->s[VEL], vy = e->s[VEL + 1]; // before either correction
  const double seen_x = k * (vx * up / z - e->imu.gyro_b_radps.y),
               seen_y = k * (vy * up / z + e->imu.gyro_b_radps.x);
  correct(e, POS + 2, -k * up * vx / (z * z), VEL, k * up / z, PIXELS_PER_COUNT * counts_x - seen_x, sd);
  correct(e, POS + 2, -k * up * vy / (z * z), VEL + 1, k * up / z, PIXELS_PER_COUNT * counts_y - seen_y, sd);
}

PAIR_COPIES void ekf_core_pose(ekf_t *e, d3_t pos_w_m, dq_t q_wb) {
  ekf_core_noise(e);
  const double pos[3] = {pos_w_m.x, pos_w_m.y, pos_w_m.z};
  for (int i = 0; i < 3; i++) correct(e, POS + i, 1.0, POS, 0.0, pos[i] - e->s[POS + i], e->param.pose_m);
  const dq_t back = {e->q.w, -e->q.x, -e->q.y, -e->q.z};
  const dq_t apart = dq_mul(back, q_wb);
  const double twice = apart.w < 0.0 ? -2.0 : 2.0; // the nearer one of q and -q
  const double turn[3] = {twice * apart.x, twice * apart.y, twice * apart.z};
  for (int i = 0; i < 3; i++) correct(e, ATT + i, 1.0, ATT, 0.0, turn[i] - e->s[ATT + i], e->param.pose_rad);
}

// Updates the attitude's covariance, and that with the other states, after the body was turned by v.
static void turn_variance(ekf_t *e, d3_t v, bool turns) {
  double turn[3][3], with_rest[EKF_N][3];
  turn_matrix(d3_scale(0.5, v), turn);
  for (int i = 0; i < EKF_N; i++)
    for (int j = 0; j < 3; j++)
      with_rest[i][j] = variance(e, i, ATT) * turn[j][0] + variance(e, i, ATT + 1) * turn[j][1] +
                        variance(e, i, ATT + 2) * turn[j][2];
  for (int i = 0; i < ATT; i++)
    for (int j = 0; j < 3; j++) e->P[i][ATT + j] = EITHER(turns, with_rest[i][j], e->P[i][ATT + j]);
  for (int i = 0; i < 3; i++)
    for (int j = i; j < 3; j++) {
      const double p = turn[i][0] * with_rest[ATT][j] + turn[i][1] * with_rest[ATT + 1][j] +
                       turn[i][2] * with_rest[ATT + 2][j];
      e->P[ATT + i][ATT + j] = EITHER(turns, i == j ? bounded(p) : at_most(p), e->P[ATT + i][ATT + j]);
    }
}

// Turns the attitude of those for which `turns` holds.
static void turn_attitude(ekf_t *e, d3_t v, bool turns) {
  const dq_t was = e->q, q = dq_unit(dq_mul(was, dq_turn(v)));
  e->q = (dq_t){EITHER(turns, q.w, was.w), EITHER(turns, q.x, was.x), EITHER(turns, q.y, was.y),
                EITHER(turns, q.z, was.z)};
  turn_variance(e, v, turns);
}

PAIR_COPIES void ekf_core_finish(ekf_t *e) {
  const d3_t d = part(e, ATT);
  const bool turns = fabs(d.x) > TURN_LEAST_RAD || fabs(d.y) > TURN_LEAST_RAD || fabs(d.z) > TURN_LEAST_RAD;
  if (ANY(turns)) turn_attitude(e, d, turns);
  e->s[ATT] = e->s[ATT + 1] = e->s[ATT + 2] = 0.0;
  ekf_core_rotation(e);
  e->updated = false;
}
