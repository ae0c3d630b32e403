// short_vector.c - vectors of a few numbers for SUNDIALS.
#include "plant/short_vector.h"

#include "base/pair.h"
#include <math.h>
#include <nvector/nvector_serial.h>

#define TERMS_MAX 16 // the state and the stages of the longest table, 13
#define PAIRS     4  // at a time

// All vectors of one integrator are of one length. Arguments may be one and the same vector: element by
// element that does no harm.
static void put_const(realtype c, N_Vector z) {
  const sunindextype n = NV_LENGTH_S(z);
  realtype *out = NV_DATA_S(z);
  for (sunindextype i = 0; i < n; i++) out[i] = c;
}

static void scale(realtype c, N_Vector x, N_Vector z) {
  const sunindextype n = NV_LENGTH_S(z);
  const realtype *in = NV_DATA_S(x);
  realtype *out = NV_DATA_S(z);
  for (sunindextype i = 0; i < n; i++) out[i] = c * in[i];
}

static void linear_sum(realtype a, N_Vector x, realtype b, N_Vector y, N_Vector z) {
  const sunindextype n = NV_LENGTH_S(z);
  const realtype *p = NV_DATA_S(x), *q = NV_DATA_S(y);
  realtype *out = NV_DATA_S(z);
  for (sunindextype i = 0; i < n; i++) out[i] = a * p[i] + b * q[i];
}

// Of so many pairs of elements from i on: all of them in registers, whatever the terms are.
static inline void sum_pairs(int pairs, int terms, const realtype *factor, const realtype *const *in,
                             sunindextype i, realtype *out) {
  pair_t sum[PAIRS];
  for (int p = 0; p < pairs; p++) sum[p] = pair_both(0.0);
  for (int k = 0; k < terms; k++)
    for (int p = 0; p < pairs; p++) sum[p] += factor[k] * pair_of(in[k] + i + 2 * p);
  for (int p = 0; p < pairs; p++) pair_put(out + i + 2 * p, sum[p]);
}

static inline realtype sum_one(int terms, const realtype *factor, const realtype *const *in, sunindextype i) {
  realtype sum = 0.0;
  for (int k = 0; k < terms; k++) sum += factor[k] * in[k][i];
  return sum;
}

// c1 x1 + c2 x2 + ..., from left to right. A term with factor 0 is left out: of a table's stages, half are.
static int linear_combination(int terms, realtype *c, N_Vector *x, N_Vector z) {
  const sunindextype n = NV_LENGTH_S(z);
  const realtype *in[TERMS_MAX];
  realtype factor[TERMS_MAX], *const out = NV_DATA_S(z);
  int used = 0;
  if (terms > TERMS_MAX) return -1;
  for (int k = 0; k < terms; k++) {
    if (c[k] == 0.0) continue;
    factor[used] = c[k];
    in[used++] = NV_DATA_S(x[k]);
  }
  sunindextype i = 0;
  for (; i + 2 * PAIRS <= n; i += 2 * PAIRS) sum_pairs(PAIRS, used, factor, in, i, out);
  for (; i + 1 < n; i += 2) sum_pairs(1, used, factor, in, i, out);
  if (i < n) out[i] = sum_one(used, factor, in, i);
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
