// kalman_z.c - height and climb by a steady-state Kalman filter.
#include "sense/kalman_z.h"

void kalman_z_init(kalman_z_t *k, double acc_sd_mps2, double range_sd_m, double period_s, int ticks,
                   double z_m) {
  const double dt = period_s, q = acc_sd_mps2 * acc_sd_mps2, r = range_sd_m * range_sd_m;
  double p11 = r, p12 = 0.0, p22 = 1.0, kz = 0.0, kv = 0.0;
  // The Riccati recursion, until it has converged: 10,000 samples are minutes of flight.
  for (int sample = 0; sample < 10000; sample++) {
    for (int i = 0; i < ticks; i++) {
      p11 += 2.0 * dt * p12 + dt * dt * p22 + q * dt * dt * dt * dt / 4.0;
      p12 += dt * p22 + q * dt * dt * dt / 2.0;
      p22 += q * dt * dt;
    }
    kz = p11 / (p11 + r);
    kv = p12 / (p11 + r);
    p22 -= kv * p12;
    p12 -= kz * p12;
    p11 -= kz * p11;
  }
  *k = (kalman_z_t){.k_z = kz, .k_v = kv, .z_m = z_m};
}

void kalman_z_predict(kalman_z_t *k, double acc_mps2, double period_s) {
  k->z_m += period_s * (k->climb_mps + 0.5 * period_s * acc_mps2);
  k->climb_mps += period_s * acc_mps2;
}

void kalman_z_correct(kalman_z_t *k, double range_m) {
  const double error_m = range_m - k->z_m;
  k->z_m += k->k_z * error_m;
  k->climb_mps += k->k_v * error_m;
}
