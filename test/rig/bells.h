// bells.h - the curve of seven weights, written a second time, in double.
#ifndef TEST_RIG_BELLS_H
#define TEST_RIG_BELLS_H

#include "flight/rbf.h"

// Least-squares fit of 1 + 0.44 exp(-80 z) on 21 points.
extern const double bells_golden[RBF_N];
rbf_weights_t bells_golden_weights(void);

// The basis functions: thesis eq. 22 and section 5.2.
void bells_at(double z_m, double basis[RBF_N]);

double bells_ratio(const rbf_weights_t *w, double z_m);
double bells_slope(const rbf_weights_t *w, double z_m); // by a central difference

double bells_theory(double ca, double cb_per_m, double z_m); // 1 + ca exp(-cb z)

#endif
