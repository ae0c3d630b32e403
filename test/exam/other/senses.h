// senses.h - the second plant's sensors and its simple estimator.
//
// A gyro and an accelerometer, each behind two poles, every 2 ms; position and attitude from outside every 10
// ms. The estimate integrates gyro and accelerometer, and is corrected from outside with fixed gains.
#ifndef TEST_EXAM_OTHER_SENSES_H
#define TEST_EXAM_OTHER_SENSES_H

#include "exam/other/hide.h"
#include "exam/other/pilot.h"

typedef struct {
  double acc_mps2, gyro_radps, place_m, angle_rad, volt, range_m; // standard deviations
  double acc_pole_Hz, gyro_pole_Hz;                               // of the two poles
  dishonest_t wrong;
} senses_t;

typedef struct {
  vec_t first, second;
} poles_t;

typedef struct {
  const senses_t *senses;
  pilot_view_t view;
  vec_t acc_mps2, gyro_radps; // as they are logged
  poles_t acc_poles, gyro_poles;
  double volt, range_up_m;
  int ticks;
} senses_state_t;

// The delay of a signal behind the two poles: sqrt(2) / (2 pi f).
double senses_late_s(double pole_Hz);

void senses_start(senses_state_t *s, const senses_t *senses, const nature_flight_t *f);
// One tick of 2 ms.
void senses_see(senses_state_t *s, const nature_flight_t *f, dice_t *d);

#endif
