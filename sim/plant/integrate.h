// integrate.h - integrates an ordinary differential equation from one instant to the next. It does not depend
// on what the equation describes.
#ifndef SIM_PLANT_INTEGRATE_H
#define SIM_PLANT_INTEGRATE_H

#include "base/error.h"
#include <stdbool.h>

#define ODE_MAX 136 // largest number of states: eight vehicles

typedef enum {
  INTEGRATE_SUNDIALS,  // ERKStep, fixed step, classic four-stage table: the default for flights
  INTEGRATE_RK4,       // the same method by hand: the cross-check, and faster
  INTEGRATE_REFERENCE, // ERKStep, order 5, adaptive, rtol 1e-9, atol 1e-11: the reference for the others
} integrate_kind_t;

typedef struct {
  int n; // states, 1..ODE_MAX
  void (*derivative)(void *context, const double *y, double *dydt);
  void *context;
  double step_s; // > 0, of the fixed-step kinds
} ode_t;

typedef struct integrate integrate_t;

// BAD_INPUT: n or step_s is out of range. FAILED: no memory. Call integrate_close at the end.
MUST_CHECK done_t integrate_open(integrate_t **i, integrate_kind_t kind, const ode_t *ode);

// Integrates y over span_s. False if the solver gave up; y must then not be used. Nothing is carried over
// from call to call, so that inputs in `context` may change in between: a solver that is not restarted would
// reuse the derivative of the old input.
bool integrate_to(integrate_t *i, double *y, double span_s);

void integrate_close(integrate_t *i);

#endif
