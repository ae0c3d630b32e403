// curve.h - which thrust ratio the controller believes at a ceiling distance.
#ifndef FLIGHT_CURVE_H
#define FLIGHT_CURVE_H

#include "flight/rbf.h"
#include <stdbool.h>
#include <stdint.h>

typedef enum {
  CURVE_OFF = 0,    // 1 everywhere: the standard INDI
  CURVE_FIXED = 1,  // the weights of `fixed`
  CURVE_LIVE = 2,   // the weights that are being learned
  CURVE_THEORY = 3, // 1 + ca exp(-cb zc) (thesis eq. 2)
} curve_mode_t;

typedef struct {
  int32_t mode;    // curve_mode_t
  float ca;        // 0..5        excess at zero distance
  float cb_per_m;  // > 0         decay
  float on_m;      // >= 0        the curve acts nearer than this
  int32_t clip;    // 0 or 1      slope <= 0 and ratio >= 1, as every ceiling has it; the fitted bells
                   //             have a rising tail (+4.1 /m at 10 cm), which takes damping away
  float ratio_min; // > 0         bounds of the ratio, whatever the weights say
  float ratio_max; // > ratio_min
  rbf_weights_t fixed;
} curve_param_t;

// Ratio and slope at zc_m. Beyond on_m, in mode CURVE_OFF or where !known: ratio 1, slope 0.
// A bound that acts on the ratio makes the slope 0. Always finite for finite zc_m.
rbf_point_t curve_at(const curve_param_t *p, const rbf_weights_t *live, bool known, float zc_m);

#endif
