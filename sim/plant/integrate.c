// integrate.c - SUNDIALS ERKStep, and a hand-written Runge-Kutta step as its cross-check.
#include "plant/integrate.h"

#include "base/error.h"
#include "plant/one_state.h"
#include "plant/short_vector.h"
#include <arkode/arkode_erkstep.h>
#include <float.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <stdlib.h>
#include <string.h>
#include <sundials/sundials_context.h>

_Static_assert(ODE_MAX <= SHORT_VECTOR_MAX, "every state fits a vector");

#define ERK_ROUNDING 1e-14 // share of a span that rounding alone may leave

struct integrate {
  integrate_kind_t kind;
  ode_t ode;
  double span_s; // by hand: the last span, and into how many steps it was cut
  int steps;
  double h; // of the last step
  SUNContext sun;
  N_Vector y; // SUNDIALS's own copy of the state
  void *erk;
};

// --- by hand ------------------------------------------------------------------------------------------

// `next` may be `y`.
WIDE_COPIES static void rk4_many(const ode_t *ode, const double *y, double h, double *next) {
  // Aligned so that lanes can use them in place, as one register or as two.
  _Alignas(WIDE * sizeof(double)) double k1[ODE_MAX], k2[ODE_MAX], k3[ODE_MAX], k4[ODE_MAX], at[ODE_MAX];
  const int n = ode->n;
  ode->derivative(ode->context, y, k1);
  for (int i = 0; i < n; i++) at[i] = y[i] + 0.5 * h * k1[i];
  ode->derivative(ode->context, at, k2);
  for (int i = 0; i < n; i++) at[i] = y[i] + 0.5 * h * k2[i];
  ode->derivative(ode->context, at, k3);
  for (int i = 0; i < n; i++) at[i] = y[i] + h * k3[i];
  ode->derivative(ode->context, at, k4);
  for (int i = 0; i < n; i++) next[i] = y[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
}

FEW_INLINE void ahead(const double *y, double h, one_state_t k, double *to) {
  one_state_put(to, one_state_plus(one_state_of(y), h, k));
}

// The same for one vehicle.
PAIR_COPIES static void rk4_one(const ode_t *ode, const double *y, double h, double *next) {
  double k1[ONE_STATE], k2[ONE_STATE], k3[ONE_STATE], k4[ONE_STATE], at[ONE_STATE];
  ode->derivative(ode->context, y, k1);
  ahead(y, 0.5 * h, one_state_of(k1), at);
  ode->derivative(ode->context, at, k2);
  ahead(y, 0.5 * h, one_state_of(k2), at);
  ode->derivative(ode->context, at, k3);
  ahead(y, h, one_state_of(k3), at);
  ode->derivative(ode->context, at, k4);
  const one_state_t first = one_state_plus(one_state_of(k1), 2.0, one_state_of(k2)),
                    all = one_state_plus(one_state_plus(first, 2.0, one_state_of(k3)), 1.0, one_state_of(k4));
  ahead(y, h / 6.0, all, next);
}

// Cuts a span into steps; only when its length has changed, which is rare.
static void rk4_cut(integrate_t *s, double span_s) {
  if (span_s == s->span_s) return;
  s->span_s = span_s;
  s->steps = (int)ceil(span_s / s->ode.step_s - 1e-9);
  s->h = span_s / s->steps;
}

static void rk4_to(integrate_t *s, double *y, double span_s) {
  rk4_cut(s, span_s);
  const int steps = s->steps;
  const double h = s->h;
  const bool one = s->ode.n == ONE_STATE;
  for (int i = 0; i < steps; i++) one ? rk4_one(&s->ode, y, h, y) : rk4_many(&s->ode, y, h, y);
}

// --- SUNDIALS -----------------------------------------------------------------------------------------

static int erk_derivative(realtype t, N_Vector y, N_Vector dydt, void *self) {
  (void)t;
  const ode_t *ode = &((integrate_t *)self)->ode;
  ode->derivative(ode->context, NV_DATA_S(y), NV_DATA_S(dydt));
  return 0;
}

// The classic four-stage table. SUNDIALS 6.4 reuses the last stage's derivative as the next step's first
// wherever the last stage lies at the end of the step. That is wrong for this table and would cost two
// digits, so each step is started anew.
static bool erk_use_classic_table(void *erk) {
  double c[4] = {0.0, 0.5, 0.5, 1.0};
  double b[4] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
  double A[16] = {[4] = 0.5, [9] = 0.5, [14] = 1.0};
  ARKodeButcherTable table = ARKodeButcherTable_Create(4, 4, 0, c, A, b, NULL);
  const bool good = table && ERKStepSetTable(erk, table) == ARK_SUCCESS;
  ARKodeButcherTable_Free(table);
  return good;
}

// A fixed step needs no error weights, but SUNDIALS computes them at every step: these cost nothing.
static int erk_no_weights(N_Vector y, N_Vector weight, void *self) {
  (void)y;
  (void)self;
  N_VConst(1.0, weight);
  return 0;
}

// Prints nothing: the caller reports that a solver gave up.
static void erk_silent(int code, const char *module, const char *function, char *message, void *self) {
  (void)code;
  (void)module;
  (void)function;
  (void)message;
  (void)self;
}

static bool erk_tune(integrate_t *s) {
  if (s->kind == INTEGRATE_SUNDIALS)
    return erk_use_classic_table(s->erk) && ERKStepWFtolerances(s->erk, erk_no_weights) == ARK_SUCCESS;
  return ERKStepSetOrder(s->erk, 5) == ARK_SUCCESS && ERKStepSStolerances(s->erk, 1e-9, 1e-11) == ARK_SUCCESS;
}

static bool erk_open(integrate_t *s) {
  if (SUNContext_Create(NULL, &s->sun) != 0) return false;
  s->y = short_vector_new(s->ode.n, s->sun);
  if (!s->y) return false;
  s->erk = ERKStepCreate(erk_derivative, 0.0, s->y, s->sun);
  if (!s->erk) return false;
  return erk_tune(s) && ERKStepSetUserData(s->erk, s) == ARK_SUCCESS &&
         ERKStepSetMaxNumSteps(s->erk, 100000) == ARK_SUCCESS &&
         ERKStepSetErrHandlerFn(s->erk, erk_silent, NULL) == ARK_SUCCESS;
}

// One step of h, without the preparations for interpolating within it.
static bool erk_step(integrate_t *s, double h) {
  double t = 0.0;
  if (h != s->h && ERKStepSetFixedStep(s->erk, h) != ARK_SUCCESS) return false;
  s->h = h;
  return ERKStepReset(s->erk, 0.0, s->y) == ARK_SUCCESS &&
         ERKStepEvolve(s->erk, h, s->y, &t, ARK_ONE_STEP) >= 0;
}

// The last step ends as SUNDIALS has it at a stop time: not even a rounding error too late.
static bool erk_steps(integrate_t *s, double span_s) {
  const double step_s = s->ode.step_s;
  double h;
  for (double t_s = 0.0; span_s - t_s > ERK_ROUNDING * span_s; t_s += h) {
    h = t_s + step_s > span_s ? (span_s - t_s) * (1.0 - 4.0 * DBL_EPSILON) : step_s;
    if (!erk_step(s, h)) return false;
  }
  return true;
}

// Both calls are needed whenever an input changes: without the reset the old derivative is used once more,
// and without the stop time the step runs past the end and is interpolated back.
static bool erk_adaptive(integrate_t *s, double span_s) {
  double t = 0.0;
  return ERKStepReset(s->erk, 0.0, s->y) == ARK_SUCCESS &&
         ERKStepSetStopTime(s->erk, span_s) == ARK_SUCCESS &&
         ERKStepEvolve(s->erk, span_s, s->y, &t, ARK_NORMAL) >= 0;
}

static bool erk_to(integrate_t *s, double *y, double span_s) {
  const size_t bytes = (size_t)s->ode.n * sizeof *y;
  memcpy(NV_DATA_S(s->y), y, bytes);
  const bool good = s->kind == INTEGRATE_SUNDIALS ? erk_steps(s, span_s) : erk_adaptive(s, span_s);
  if (good) memcpy(y, NV_DATA_S(s->y), bytes);
  return good;
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

bool integrate_to(integrate_t *s, double *y, double span_s) {
  if (!(span_s > 0.0)) return true;
  if (s->kind != INTEGRATE_RK4) return erk_to(s, y, span_s);
  rk4_to(s, y, span_s);
  return true;
}

void integrate_close(integrate_t *s) {
  if (!s) return;
  if (s->erk) ERKStepFree(&s->erk);
  if (s->y) N_VDestroy(s->y);
  if (s->sun) SUNContext_Free(&s->sun);
  free(s);
}
