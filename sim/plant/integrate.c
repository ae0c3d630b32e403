// integrate.c - SUNDIALS ERKStep, and a Runge-Kutta step by hand as its cross-check.
#include "plant/integrate.h"

#include "base/wide.h"
#include "base/error.h"
#include "plant/short_vector.h"
#include <arkode/arkode_erkstep.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sundials/sundials_context.h>

_Static_assert(ODE_MAX <= SHORT_VECTOR_MAX, "every state fits a vector");

struct integrate {
  integrate_kind_t kind;
  ode_t ode;
  double span_s, h; // by hand: the last span, and the step that it was cut into
  int steps;
  SUNContext sun;
  N_Vector y; // SUNDIALS's own copy of the state
  void *erk;
};

// --- by hand ------------------------------------------------------------------------------------------

// next may be y.
WIDE_COPIES static void rk4_step(const ode_t *ode, const double *y, double h, double *next) {
  const int n = ode->n;
  double k1[ODE_MAX], k2[ODE_MAX], k3[ODE_MAX], k4[ODE_MAX], at[ODE_MAX];
  ode->derivative(ode->context, y, k1);
  for (int i = 0; i < n; i++) at[i] = y[i] + 0.5 * h * k1[i];
  ode->derivative(ode->context, at, k2);
  for (int i = 0; i < n; i++) at[i] = y[i] + 0.5 * h * k2[i];
  ode->derivative(ode->context, at, k3);
  for (int i = 0; i < n; i++) at[i] = y[i] + h * k3[i];
  ode->derivative(ode->context, at, k4);
  for (int i = 0; i < n; i++) next[i] = y[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
}

// The margin fell to 0 within a step of h: the part of h until then, by bisection to 1e-12 of the step.
static double rk4_until_event(const ode_t *ode, const double *y, double h, double *next) {
  double lo = 0.0, hi = h;
  for (int i = 0; i < 40; i++) {
    const double mid = 0.5 * (lo + hi);
    rk4_step(ode, y, mid, next);
    if (ode->margin(ode->context, next) > 0.0)
      lo = mid;
    else
      hi = mid;
  }
  rk4_step(ode, y, hi, next);
  return hi;
}

// Spans are of few lengths.
static void rk4_cut(integrate_t *s, double span_s) {
  if (span_s == s->span_s) return;
  s->span_s = span_s;
  s->steps = (int)ceil(span_s / s->ode.step_s - 1e-9);
  s->h = span_s / s->steps;
}

static double rk4_to(integrate_t *s, double *y, double span_s, bool *event) {
  const ode_t *const ode = &s->ode;
  rk4_cut(s, span_s);
  const int steps = s->steps;
  const double h = s->h;
  if (!ode->margin) {
    for (int i = 0; i < steps; i++) rk4_step(ode, y, h, y);
    return span_s;
  }
  double next[ODE_MAX], passed_s = 0.0;
  for (int i = 0; i < steps && !*event; i++) {
    rk4_step(ode, y, h, next);
    *event = !(ode->margin(ode->context, next) > 0.0);
    passed_s += *event ? rk4_until_event(ode, y, h, next) : h;
    memcpy(y, next, (size_t)ode->n * sizeof *y);
  }
  return *event ? passed_s : span_s;
}

// --- SUNDIALS -----------------------------------------------------------------------------------------

static int erk_derivative(realtype t, N_Vector y, N_Vector dydt, void *self) {
  (void)t;
  const ode_t *ode = &((integrate_t *)self)->ode;
  ode->derivative(ode->context, N_VGetArrayPointer(y), N_VGetArrayPointer(dydt));
  return 0;
}

static int erk_margin(realtype t, N_Vector y, realtype *out, void *self) {
  (void)t;
  const ode_t *ode = &((integrate_t *)self)->ode;
  out[0] = ode->margin(ode->context, N_VGetArrayPointer(y));
  return 0;
}

// The classic four stages, and a fifth that is the result itself with no weight. SUNDIALS 6.4 takes the last
// stage's derivative for the next step's first wherever the last stage lies at the step's end; of the classic
// table that is not true and costs two digits, of this one it is, and no evaluation is added.
static bool erk_use_classic_table(void *erk, double step_s) {
  double c[5] = {0.0, 0.5, 0.5, 1.0, 1.0};
  double b[5] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0, 0.0};
  double A[25] = {[5] = 0.5, [11] = 0.5, [17] = 1.0, [20] = b[0], [21] = b[1], [22] = b[2], [23] = b[3]};
  ARKodeButcherTable table = ARKodeButcherTable_Create(5, 4, 0, c, A, b, NULL);
  const bool good =
      table && ERKStepSetTable(erk, table) == ARK_SUCCESS && ERKStepSetFixedStep(erk, step_s) == ARK_SUCCESS;
  ARKodeButcherTable_Free(table);
  return good;
}

// A step that is fixed needs no error weights, but SUNDIALS computes them at every step: these cost nothing.
static int erk_no_weights(N_Vector y, N_Vector weight, void *self) {
  (void)y;
  (void)self;
  N_VConst(1.0, weight);
  return 0;
}

// The caller tells of it: a flight that a solver gives up is not finite.
static void erk_silent(int code, const char *module, const char *function, char *message, void *self) {
  (void)code;
  (void)module;
  (void)function;
  (void)message;
  (void)self;
}

static bool erk_tune(integrate_t *s) {
  if (s->kind == INTEGRATE_SUNDIALS)
    return erk_use_classic_table(s->erk, s->ode.step_s) &&
           ERKStepWFtolerances(s->erk, erk_no_weights) == ARK_SUCCESS;
  return ERKStepSetOrder(s->erk, 5) == ARK_SUCCESS && ERKStepSStolerances(s->erk, 1e-9, 1e-11) == ARK_SUCCESS;
}

static bool erk_open(integrate_t *s) {
  if (SUNContext_Create(NULL, &s->sun) != 0) return false;
  s->y = short_vector_new(s->ode.n, s->sun);
  if (!s->y) return false;
  s->erk = ERKStepCreate(erk_derivative, 0.0, s->y, s->sun);
  if (!s->erk) return false;
  return erk_tune(s) && ERKStepSetUserData(s->erk, s) == ARK_SUCCESS &&
         (!s->ode.margin || ERKStepRootInit(s->erk, 1, erk_margin) == ARK_SUCCESS) &&
         ERKStepSetMaxNumSteps(s->erk, 100000) == ARK_SUCCESS &&
         ERKStepSetErrHandlerFn(s->erk, erk_silent, NULL) == ARK_SUCCESS;
}

static double erk_to(integrate_t *s, double *y, double span_s, bool *event) {
  const size_t bytes = (size_t)s->ode.n * sizeof *y;
  memcpy(N_VGetArrayPointer(s->y), y, bytes);
  double t = 0.0;
  // Both are needed at every change of an input: without the reset the old derivative is used once more,
  // without the stop time the step runs past the end and is interpolated back.
  int said = ERKStepReset(s->erk, 0.0, s->y);
  if (said == ARK_SUCCESS) said = ERKStepSetStopTime(s->erk, span_s);
  if (said == ARK_SUCCESS) said = ERKStepEvolve(s->erk, span_s, s->y, &t, ARK_NORMAL);
  if (said < 0) return (double)NAN;
  *event = said == ARK_ROOT_RETURN;
  memcpy(y, N_VGetArrayPointer(s->y), bytes);
  return *event ? t : span_s;
}

// --- both ---------------------------------------------------------------------------------------------

done_t integrate_open(integrate_t **i, integrate_kind_t kind, const ode_t *ode) {
  if (ode->n < 1 || ode->n > ODE_MAX || !(ode->step_s > 0.0)) return BAD_INPUT;
  integrate_t *s = calloc(1, sizeof *s);
  if (!s) return FAILED;
  s->kind = kind;
  s->ode = *ode;
  if (kind != INTEGRATE_RK4 && !erk_open(s)) {
    integrate_close(s);
    return FAILED;
  }
  *i = s;
  return DONE;
}

double integrate_to(integrate_t *s, double *y, double span_s, bool *event) {
  *event = s->ode.margin && !(s->ode.margin(s->ode.context, y) > 0.0);
  if (*event || !(span_s > 0.0)) return 0.0;
  return s->kind == INTEGRATE_RK4 ? rk4_to(s, y, span_s, event) : erk_to(s, y, span_s, event);
}

void integrate_close(integrate_t *s) {
  if (!s) return;
  if (s->erk) ERKStepFree(&s->erk);
  if (s->y) N_VDestroy(s->y);
  if (s->sun) SUNContext_Free(&s->sun);
  free(s);
}
