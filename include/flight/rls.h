// rls.h - recursive least squares for y = a' theta, seven weights, one sample at a time.
//
//   K = P a / (a' P a + lambda)       thesis eq. 19
//   theta += K (y - a' theta)         eq. 20
//   P -= K a' P                       eq. 21
//
// Form 0 is the thesis's, as printed. There lambda is the variance of the measurement noise, not a forgetting
// factor: nothing is ever forgotten, and only lambda/p0 matters (src/README.md, reading rules). Form 1 adds a
// random walk of the weights, P_ii += q while P_ii < p0, so that the curve can follow a drift and P stays
// bounded. Dividing P by lambda, as the name forgetting factor suggests, makes P grow without bound in every
// direction that a hover does not excite; it is not offered.
//
// p0 is the largest variance of a weight, at the start and afterwards, in both forms: the walk stops there,
// even if q is as large as p0. Lowering p0 scales all of P by the same factor; raising it lets the walk go
// farther.
#ifndef FLIGHT_RLS_H
#define FLIGHT_RLS_H

#include "flight/rbf.h"
#include "flight/status.h"
#include <stdint.h>

typedef enum { RLS_THESIS = 0, RLS_RANDOM_WALK = 1 } rls_form_t;

typedef struct {
  int32_t form; // rls_form_t
  float lambda; // > 0         variance of the noise of y, relative to p0
  float p0;     // > 0         variance of the weights at the start
  float q;      // 0..p0       random walk of the weights per sample (form 1)
} rls_param_t;

typedef struct {
  rbf_weights_t theta;   // the estimate; each within +-RLS_WEIGHT_MAX
  float P[RBF_N][RBF_N]; // its covariance, symmetric to the bit
  float p0;              // the bound of P's diagonal
  unsigned count;        // samples taken in
} rls_t;

#define RLS_WEIGHT_MAX 5.0f

// Checks parameters and starting weights. ST_BAD_PARAM: a parameter out of range. ST_BAD_INPUT: a weight not
// within +-RLS_WEIGHT_MAX.
MUST_CHECK status_t rls_check(const rls_param_t *p, const rbf_weights_t *start);

// Starts at the weights `start` with P = p0 I.
// ST_BAD_PARAM, ST_BAD_INPUT: as rls_check; *s is kept.
MUST_CHECK status_t rls_init(rls_t *s, const rls_param_t *p, const rbf_weights_t *start);

// Takes one sample: y, measured at the regressor a (0..1 each, rbf_basis).
// ST_BAD_INPUT: a or y not finite, or the weights would leave their box; nothing has changed.
// ST_BAD_PARAM: a parameter out of range; nothing has changed.
// ST_SINGULAR: P was no longer a covariance, or a weight was out of its box (a flipped bit): P restarts from
// p0 I and such a weight from 0; the other weights are kept.
MUST_CHECK status_t rls_update(rls_t *s, const rls_param_t *p, const float a[RBF_N], float y);

#endif
