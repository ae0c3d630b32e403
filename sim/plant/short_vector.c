// short_vector.c - vectors of a few numbers for SUNDIALS.
#include "plant/short_vector.h"

#include "plant/one_state.h"
#include <math.h>
#include <nvector/nvector_serial.h>
#include <string.h>

// All vectors of one integrator have the same length. Arguments may be the same vector, because these
// functions work element by element.
static void put_const(realtype c, N_Vector z) {
  const sunindextype n = NV_LENGTH_S(z);
  realtype *out = NV_DATA_S(z);
  for (sunindextype i = 0; i < n; i++) out[i] = c;
}

PAIR_COPIES static void copy_one(const realtype *in, realtype *out) {
  one_state_put(out, one_state_of(in));
}

// c is nearly always 1: a copy.
static void scale(realtype c, N_Vector x, N_Vector z) {
  const sunindextype n = NV_LENGTH_S(z);
  const realtype *in = NV_DATA_S(x);
  realtype *out = NV_DATA_S(z);
  if (c == 1.0) {
    if (n == ONE_STATE)
      copy_one(in, out);
    else
      memmove(out, in, (size_t)n * sizeof *out);
    return;
  }
  for (sunindextype i = 0; i < n; i++) out[i] = c * in[i];
}

static void linear_sum(realtype a, N_Vector x, realtype b, N_Vector y, N_Vector z) {
  const sunindextype n = NV_LENGTH_S(z);
  const realtype *p = NV_DATA_S(x), *q = NV_DATA_S(y);
  realtype *out = NV_DATA_S(z);
  for (sunindextype i = 0; i < n; i++) out[i] = a * p[i] + b * q[i];
}

// c1 x1 + c2 x2 + ..., from left to right. Terms with factor 0 are left out: half of a table's factors are 0.
WIDE_COPIES static void combine(int terms, const realtype *c, N_Vector *x, N_Vector z) {
  realtype sum[SHORT_VECTOR_MAX];
  const sunindextype n = NV_LENGTH_S(z);
  for (sunindextype i = 0; i < n; i++) sum[i] = 0.0;
  for (int k = 0; k < terms; k++) {
    if (c[k] == 0.0) continue;
    const realtype *const in = NV_DATA_S(x[k]);
    for (sunindextype i = 0; i < n; i++) sum[i] += c[k] * in[i];
  }
  memcpy(NV_DATA_S(z), sum, (size_t)n * sizeof *sum);
}

PAIR_COPIES static void combine_one(int terms, const realtype *c, N_Vector *x, N_Vector z) {
  const few_t zero = few_all(0.0);
  one_state_t sum = {{zero, zero, zero}, zero, 0.0};
  for (int k = 0; k < terms; k++)
    if (c[k] != 0.0) sum = one_state_plus(sum, c[k], one_state_of(NV_DATA_S(x[k])));
  one_state_put(NV_DATA_S(z), sum);
}

static int linear_combination(int terms, realtype *c, N_Vector *x, N_Vector z) {
  NV_LENGTH_S(z) == ONE_STATE ? combine_one(terms, c, x, z) : combine(terms, c, x, z);
  return 0;
}

static realtype wrms_norm(N_Vector x, N_Vector weight) {
  const sunindextype n = NV_LENGTH_S(x);
  const realtype *p = NV_DATA_S(x), *w = NV_DATA_S(weight);
  realtype sum = 0.0;
  for (sunindextype i = 0; i < n; i++) sum += p[i] * w[i] * (p[i] * w[i]);
  return sqrt(sum / (realtype)n);
}

N_Vector short_vector_new(int n, SUNContext context) {
  N_Vector v = n <= SHORT_VECTOR_MAX ? N_VNew_Serial(n, context) : NULL;
  if (!v) return NULL;
  v->ops->nvconst = put_const;
  v->ops->nvscale = scale;
  v->ops->nvlinearsum = linear_sum;
  v->ops->nvlinearcombination = linear_combination;
  v->ops->nvwrmsnorm = wrms_norm;
  N_VConst(0.0, v);
  return v;
}
