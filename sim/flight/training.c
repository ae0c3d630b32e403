// training.c - a flight's training data.
#include "flight/training.h"

#include "flight/learn.h"
#include "flight/sync.h"
#include <math.h>

int training_of(const record_t *record, const setup_t *setup, double far_m, training_t *training) {
  const flight_param_t *p = &setup->flight;
  learn_param_t rules = p->learn;
  rules.far_m = (float)far_m;
  sync_coef_t coef;
  learn_t learn;
  if (sync_tune(&coef, p->cutoff_Hz, p->motor_tau_s, (float)setup->plan.period_s) != ST_OK) return 0;
  if (learn_init(&learn, &rules, &setup->learn_from) != ST_OK) return 0;
  sync_t sync;
  int n = 0;
  for (int i = 0; i < record->n; i++) {
    const sample_t *s = &record->sample[i];
    const sync_in_t in = {.acc_b_mps2 = {.z = (float)s->sense.acc_mps2 + GRAVITY_MPS2},
                          .q_wb = {.w = 1.0f},
                          .thrust_N = (float)s->sense.applied_N};
    if (i == 0) sync_start(&sync, &in);
    sync_out_t x;
    sync_step(&sync, &coef, &in, &x);
    learn_sample_t sample = learn_sample(&sync, &x, p->pos.mass_kg);
    sample.known = !isnan(s->thoughts.zc_m);
    sample.zc_m = sync_distance_m(&sync, &coef, sample.known, sample.known ? (float)s->thoughts.zc_m : 0.0f);
    if (learn_update(&learn, &rules, &sample, 0.0f) != ST_OK) continue;
    training[n++] = (training_t){.t_s = s->t_s, .zc_m = (double)sample.zc_m, .y = (double)learn.y};
  }
  return n;
}

misfit_t training_misfit(const rbf_weights_t *w, const model_t *model, double near_m, double far_m) {
  misfit_t m = {0};
  double sum2 = 0.0, peak = -HUGE_VAL;
  int n = 0;
  for (int mm = 0; mm <= 100; mm++) {
    const double zc_m = 1e-3 * mm, ratio = (double)rbf_at(w, (float)zc_m).ratio;
    const fx_place_t place = {zc_m, model->ceiling_m - zc_m, model->rotor_radius_m};
    const double error = ratio - model_thrust_ratio(model, &place);
    if (mm == 10) m.at_1cm = error;
    if (ratio > peak) {
      peak = ratio;
      m.peak_m = zc_m;
    }
    if (zc_m < near_m - 1e-9 || zc_m > far_m + 1e-9) continue;
    sum2 += error * error;
    m.max = fmax(m.max, fabs(error));
    n++;
  }
  m.rms = n > 0 ? sqrt(sum2 / n) : 0.0;
  return m;
}
