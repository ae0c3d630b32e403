// sensors.c - what the sensors make of the vertical axis.
#include "sense/sensors.h"

#include <math.h>

const noise_t noise_levels[] = {
    {.name = "none"},
    {.name = "n1", .acc_mps2 = 0.1, .down_m = 0.001, .up_m = 0.003},
    {.name = "n2", .acc_mps2 = 0.2, .down_m = 0.0025, .up_m = 0.003, .gust_mps2 = 0.05, .gust_tau_s = 0.3},
    {.name = "n3", .acc_mps2 = 0.4, .down_m = 0.004, .up_m = 0.003, .gust_mps2 = 0.15, .gust_tau_s = 0.3},
};
const int noise_count = (int)(sizeof noise_levels / sizeof *noise_levels);

double sensors_gust(const noise_t *noise, random_t *r, double gust_mps2, double period_s) {
  if (!(noise->gust_mps2 > 0.0)) return 0.0;
  const double keep = exp(-period_s / noise->gust_tau_s);
  return keep * gust_mps2 + noise->gust_mps2 * sqrt(1.0 - keep * keep) * random_normal(r);
}

double sensors_up_m(const noise_t *noise, random_t *r, double gap_m) {
  if (!(gap_m <= UP_MAX_M)) return UP_NOTHING_M;
  const double range_m = noise->up_m > 0.0 ? gap_m + noise->up_m * random_normal(r) : gap_m;
  return fmax(range_m, UP_FLOOR_M);
}
