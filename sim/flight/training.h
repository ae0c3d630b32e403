// training.h - a flight's training data: distance and measured thrust ratio, as the learner on board sees
// them.
#ifndef SIM_FLIGHT_TRAINING_H
#define SIM_FLIGHT_TRAINING_H

#include "base/error.h"
#include "flight/setup.h"

typedef struct {
  double t_s, zc_m, y; // zc_m: distance to the ceiling; y: thrust ratio
} training_t;

// Selects the record's samples that the rules of setup->flight let the learner use, up to far_m. *training
// has room for record->n; returns how many.
int training_of(const record_t *record, const setup_t *setup, double far_m, training_t *training);

// How a curve differs from the plant's over near_m..far_m in 1 mm steps.
typedef struct {
  double rms, max; // of the difference, no unit
  double at_1cm;   // difference at 1 cm
  double peak_m;   // where the curve is highest, 0 to 10 cm
} misfit_t;

misfit_t training_misfit(const rbf_weights_t *w, const model_t *model, double near_m, double far_m);

#endif
