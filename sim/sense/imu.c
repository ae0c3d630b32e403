// imu.c - accelerometer and gyro.
#include "sense/imu.h"

#include "base/clip.h"
#include "base/either.h"
#include "base/lowpass.h"
#include "base/pair.h"
#include <stddef.h>

#define RATE_HZ 1000.0

// The filter of lowpass.h with half its memory, because six of these run every millisecond.
static double filter(const imu_filter_t *f, imu_memory_t *m, double x) {
  const double in = f->b0 * x, y = in + m->next;
  m->next = 2.0 * in - f->a1 * y + m->after;
  m->after = in - f->a2 * y;
  return y;
}

static imu_filter_t butterworth(double cutoff_Hz) {
  lowpass_t l;
  lowpass_init(&l, cutoff_Hz, RATE_HZ, 0.0);
  imu_filter_t f = {.b0 = l.b, .a1 = l.a1, .a2 = l.a2};
  // The filter multiplies the variance of white noise by the energy of its impulse response.
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

static d3_t read(d3_t v, d3_t mount_rad, double scale, d3_t bias) {
  // A chip turned by m sees v turned by -m: v - m x v.
  return d3_add(d3_scale(1.0 + scale, d3_sub(v, d3_cross(mount_rad, v))), bias);
}

static d3_t shake(d3_t v, const double n[3], double xy, double z) {
  return (d3_t){v.x + xy * n[0], v.y + xy * n[1], v.z + z * n[2]};
}

static d3_t clip_axes(d3_t v, double max) {
  return (d3_t){clip(v.x, -max, max), clip(v.y, -max, max), clip(v.z, -max, max)};
}

static d3_t filter_axes(const imu_filter_t *f, imu_memory_t m[3], d3_t v) {
  return (d3_t){filter(f, &m[0], v.x), filter(f, &m[1], v.y), filter(f, &m[2], v.z)};
}

// Settles the filter on a constant input, so that the output equals it.
static void settle(const imu_filter_t *f, imu_memory_t m[3], d3_t v) {
  const double x[3] = {v.x, v.y, v.z};
  for (int i = 0; i < 3; i++)
    m[i] = (imu_memory_t){.next = x[i] - f->b0 * x[i], .after = f->b0 * x[i] - f->a2 * x[i]};
}

PAIR_COPIES imu_sample_t imu_take(imu_t *s, const imu_param_t *p, const double *n, const truth_t *truth) {
  d3_t acc = read(truth->force_b_mps2, p->mount_rad, p->acc_scale, p->acc_bias_b_mps2);
  d3_t gyro = read(truth->rate_b_radps, p->mount_rad, p->gyro_scale, p->gyro_bias_b_radps);
  if (n) {
    const bool on = truth->motors;
    const double raw_acc = 1.0 / s->acc.gain, raw_gyro = 1.0 / s->gyro.gain;
    acc = shake(acc, n, raw_acc * EITHER(on, p->acc_xy_mps2, p->acc_rest_mps2),
                raw_acc * EITHER(on, p->acc_z_mps2, p->acc_rest_mps2));
    gyro = shake(gyro, n + 3, raw_gyro * EITHER(on, p->gyro_xy_radps, p->gyro_rest_radps),
                 raw_gyro * EITHER(on, p->gyro_z_radps, p->gyro_rest_radps));
  }
  acc = clip_axes(acc, IMU_ACC_MAX_MPS2);
  gyro = clip_axes(gyro, IMU_GYRO_MAX_RADPS);
  if (!s->started) {
    settle(&s->acc, s->memory, acc);
    settle(&s->gyro, s->memory + 3, gyro);
    s->started = true;
  }
  return (imu_sample_t){filter_axes(&s->acc, s->memory, acc), filter_axes(&s->gyro, s->memory + 3, gyro)};
}

imu_sample_t imu_step(imu_t *s, const imu_param_t *p, random_t *r, const truth_t *truth) {
  double drawn[IMU_DRAWN];
  if (r) random_triangles(r, IMU_DRAWN, drawn);
  return imu_take(s, p, r ? drawn : NULL, truth);
}
