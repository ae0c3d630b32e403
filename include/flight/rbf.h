// rbf.h - the thrust ratio as a curve over the ceiling distance: a constant and six bells (thesis eq. 22).
//
//   rho(z) = w1 + sum_{i=2..7} w_i exp(-a_i (z - c_i)^2),   z the distance propeller plane to ceiling in m
//
// rho is thrust near the surface over thrust in free air at the same motor command. Widths a_i (1/m^2)
// and centres c_i (m) are those of thesis section 5.2 (those of B.1 are misprinted: src/README.md, reading
// rules).
#ifndef FLIGHT_RBF_H
#define FLIGHT_RBF_H

#include "flight/status.h"

#define RBF_N 7

typedef struct {
  float w[RBF_N]; // no unit; w[0] is the thesis's w1
} rbf_weights_t;

typedef struct {
  float ratio;       // rho
  float slope_per_m; // d rho / d z
} rbf_point_t;

// The regressor [1, bell_2, ..., bell_7] at distance zc_m; bells 0..1. zc_m: any finite number.
void rbf_basis(float zc_m, float basis[RBF_N]);

// Value and slope at distance zc_m.
rbf_point_t rbf_at(const rbf_weights_t *w, float zc_m);

#endif
