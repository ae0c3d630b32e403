// imu.c - accelerometer and gyro.
#include "plant/imu.h"

#include <math.h>

#define RATE_HZ 1000.0
#define PI      3.14159265358979323846

static double filter(const imu_filter_t *f, imu_memory_t *m, double x) {
  const double y = f->b0 * (x + 2.0 * m->x1 + m->x2) - f->a1 * m->y1 - f->a2 * m->y2;
  *m = (imu_memory_t){.x1 = x, .x2 = m->x1, .y1 = y, .y2 = m->y1};
  return y;
}

static imu_filter_t butterworth(double cutoff_Hz) {
  const double w = tan(PI * cutoff_Hz / RATE_HZ), k = 1.0 / (1.0 + sqrt(2.0) * w + w * w);
  imu_filter_t f = {.b0 = w * w * k, .a1 = 2.0 * (w * w - 1.0) * k, .a2 = (1.0 - sqrt(2.0) * w + w * w) * k};
  // White noise grows by the energy of the impulse response.
  imu_memory_t m = {0};
  double energy = 0.0;
  for (int i = 0; i < 1000; i++) {
    const double h = filter(&f, &m, i == 0 ? 1.0 : 0.0);
    energy += h * h;
  }
  f.gain = sqrt(energy);
  return f;
}

void imu_init(imu_t *s) {
  *s = (imu_t){.acc = butterworth(IMU_ACC_CUTOFF_HZ), .gyro = butterworth(IMU_GYRO_CUTOFF_HZ)};
}

static double noise(random_t *r, double sd) {
  return sd > 0.0 ? sd * random_normal(r) : 0.0;
}

static d3_t read(d3_t v, d3_t mount_rad, double scale, d3_t bias) {
  // A chip turned by m sees v turned by -m: v - m x v.
  return d3_add(d3_scale(1.0 + scale, d3_sub(v, d3_cross(mount_rad, v))), bias);
}

static d3_t shake(random_t *r, d3_t v, double xy, double z) {
  v.x += noise(r, xy);
  v.y += noise(r, xy);
  v.z += noise(r, z);
  return v;
}

static double clip(double x, double max) {
  return fmin(fmax(x, -max), max);
}

static d3_t settle(const imu_filter_t *f, imu_memory_t m[3], bool started, d3_t v, double max) {
  const d3_t x = {clip(v.x, max), clip(v.y, max), clip(v.z, max)};
  if (!started) {
    m[0] = (imu_memory_t){x.x, x.x, x.x, x.x};
    m[1] = (imu_memory_t){x.y, x.y, x.y, x.y};
    m[2] = (imu_memory_t){x.z, x.z, x.z, x.z};
  }
  return (d3_t){filter(f, &m[0], x.x), filter(f, &m[1], x.y), filter(f, &m[2], x.z)};
}

imu_sample_t imu_step(imu_t *s, const imu_param_t *p, random_t *r, const truth_t *truth) {
  const bool on = truth->motors;
  d3_t acc = read(truth->force_b_mps2, p->mount_rad, p->acc_scale, p->acc_bias_b_mps2);
  d3_t gyro = read(truth->rate_b_radps, p->mount_rad, p->gyro_scale, p->gyro_bias_b_radps);
  acc = shake(r, acc, (on ? p->acc_xy_mps2 : p->acc_rest_mps2) / s->acc.gain,
              (on ? p->acc_z_mps2 : p->acc_rest_mps2) / s->acc.gain);
  gyro = shake(r, gyro, (on ? p->gyro_xy_radps : p->gyro_rest_radps) / s->gyro.gain,
               (on ? p->gyro_z_radps : p->gyro_rest_radps) / s->gyro.gain);
  const imu_sample_t sample = {settle(&s->acc, s->memory, s->started, acc, IMU_ACC_MAX_MPS2),
                               settle(&s->gyro, s->memory + 3, s->started, gyro, IMU_GYRO_MAX_RADPS)};
  s->started = true;
  return sample;
}
