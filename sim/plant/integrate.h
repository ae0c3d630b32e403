// integrate.h - an ordinary differential equation, moved from one instant to the next. Knows nothing of what
// it integrates.
#ifndef SIM_PLANT_INTEGRATE_H
#define SIM_PLANT_INTEGRATE_H

#include "base/error.h"
#include <stdbool.h>

#define ODE_MAX 136 // largest number of states: eight vehicles

typedef enum {
  INTEGRATE_SUNDIALS,  // ERKStep, fixed step, classic four-stage table: the one to fly with
  INTEGRATE_RK4,       // the same method by hand: the cross-check, and faster
  INTEGRATE_REFERENCE, // ERKStep, order 5, adaptive, rtol 1e-9, atol 1e-11: what the others are judged by
} integrate_kind_t;

typedef struct {
  int n; // states, 1..ODE_MAX
  void (*derivative)(void *context, const double *y, double *dydt);
  void *context;
  double step_s; // > 0, of the fixed-step kinds
} ode_t;

typedef struct integrate integrate_t;

// BAD_INPUT: n or step_s out of range. FAILED: no memory. Close what was opened.
MUST_CHECK done_t integrate_open(integrate_t **i, integrate_kind_t kind, const ode_t *ode);

// Moves y by span_s; false if the solver gave up (y is then not to be used). Nothing is carried over from
// call to call, so that inputs in `context` may change in between: a solver that is not restarted reuses the
// derivative of the old input.
bool integrate_to(integrate_t *i, double *y, double span_s);

void integrate_close(integrate_t *i);

#endif
