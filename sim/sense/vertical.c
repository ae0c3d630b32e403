// vertical.c - sensors of a vehicle on the vertical axis.
#include "sense/vertical.h"

#include "base/constants.h"
#include "base/larger.h"
#include <math.h>

#define DOWN_PERIOD_S   0.02
#define UP_PERIOD_S     0.1
#define KALMAN_ACC_MPS2 0.5 // what the estimator expects of the accelerometer

const vertical_noise_t vertical_noise_levels[] = {
    {.name = "none"},
    {.name = "n1", .acc_mps2 = 0.1, .down_m = 0.001, .up_m = 0.003},
    {.name = "n2", .acc_mps2 = 0.2, .down_m = 0.0025, .up_m = 0.003, .gust_mps2 = 0.05, .gust_tau_s = 0.3},
    {.name = "n3", .acc_mps2 = 0.4, .down_m = 0.004, .up_m = 0.003, .gust_mps2 = 0.15, .gust_tau_s = 0.3},
};
const int vertical_noise_count = (int)(sizeof vertical_noise_levels / sizeof *vertical_noise_levels);

// The number of ticks between two events of that period, at least 1.
static int ticks_of(double period_s, double tick_s) {
  return (int)lround(larger(1.0, period_s / tick_s));
}

void vertical_init(vertical_t *s, const vertical_noise_t *noise, double period_s, double z_m) {
  *s = (vertical_t){.period_s = period_s};
  kalman_z_init(&s->kalman, KALMAN_ACC_MPS2, larger(noise->down_m, 1e-4), period_s,
                ticks_of(DOWN_PERIOD_S, period_s), z_m);
}

vertical_sample_t vertical_step(vertical_t *s, const vertical_noise_t *noise, random_t *r,
                                const truth_t *truth) {
  vertical_sample_t out = {
      .z_m = truth->pos_w_m.z, .climb_mps = truth->vel_w_mps.z, .acc_mps2 = truth->force_b_mps2.z - G_MPS2};
  if (noise->acc_mps2 > 0.0) out.acc_mps2 += noise->acc_mps2 * random_normal(r);
  if (noise->down_m > 0.0) {
    if (s->tick > 0) kalman_z_predict(&s->kalman, out.acc_mps2, s->period_s);
    if (s->tick % ticks_of(DOWN_PERIOD_S, s->period_s) == 0)
      kalman_z_correct(&s->kalman, out.z_m + noise->down_m * random_normal(r));
    out.z_m = s->kalman.z_m;
    out.climb_mps = s->kalman.climb_mps;
  }
  out.range_new = s->tick % ticks_of(UP_PERIOD_S, s->period_s) == 0;
  if (out.range_new) out.range_m = vertical_up_m(noise, r, truth->up_m);
  s->tick++;
  return out;
}

double vertical_gust_mps2(vertical_t *s, const vertical_noise_t *noise, random_t *r) {
  if (!(noise->gust_mps2 > 0.0)) return 0.0;
  const double keep = exp(-s->period_s / noise->gust_tau_s);
  s->gust_mps2 = keep * s->gust_mps2 + noise->gust_mps2 * sqrt(1.0 - keep * keep) * random_normal(r);
  return s->gust_mps2;
}

double vertical_up_m(const vertical_noise_t *noise, random_t *r, double gap_m) {
  if (!(gap_m <= UP_MAX_M)) return UP_NOTHING_M;
  const double range_m = noise->up_m > 0.0 ? gap_m + noise->up_m * random_normal(r) : gap_m;
  return larger(range_m, UP_FLOOR_M);
}
