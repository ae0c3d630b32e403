// ols_sweep.c - the thesis's figures B.3 to B.10: the measured ratio goes through a moving average, and the
// newest value of each of 21 bins is fitted by least squares. On a fast way down the slow averages still hold
// the ratio of 2 cm, so that the way up and the way down give two lines.
#include "flight/scenario/sweep.h"

#include "base/lsq.h"
#include <math.h>

#define BINS   21
#define BIN_M  0.005
#define BACK_S 10.0 // from the turn to the end

typedef struct {
  double share;            // weight of a new sample, the thesis's v_t
  double newest[BINS];     // NaN: not visited
  double up_sum, down_sum; // filtered ratio between 4 and 8 cm on the way to the ceiling and back
  int up_n, down_n;
  double y;
} average_t;

static void take(average_t *a, const training_t *x, double turn_s, bool first) {
  a->y = first ? x->y : (1.0 - a->share) * a->y + a->share * x->y;
  const int bin = (int)lround(x->zc_m / BIN_M);
  if (bin >= 0 && bin < BINS) a->newest[bin] = a->y;
  if (x->zc_m < 0.04 || x->zc_m > 0.08) return;
  const bool up = x->t_s < turn_s;
  *(up ? &a->up_sum : &a->down_sum) += a->y;
  *(up ? &a->up_n : &a->down_n) += 1;
}

static rbf_weights_t fit(const average_t *a) {
  double A[BINS * RBF_N], b[BINS], w[RBF_N];
  int rows = 0;
  for (int bin = 0; bin < BINS; bin++) {
    if (isnan(a->newest[bin])) continue;
    float basis[RBF_N];
    rbf_basis((float)(BIN_M * bin), basis);
    for (int i = 0; i < RBF_N; i++) A[rows * RBF_N + i] = (double)basis[i];
    b[rows++] = a->newest[bin];
  }
  lsq_solve(rows, RBF_N, A, b, w);
  rbf_weights_t out;
  for (int i = 0; i < RBF_N; i++) out.w[i] = (float)w[i];
  return out;
}

static void tell(const average_t *a, const setup_t *setup, result_t *result) {
  const rbf_weights_t w = fit(a);
  const misfit_t m = training_misfit(&w, &setup->model, 0.02, 0.10);
  cJSON *row = result_add_row(result, "fits");
  cJSON_AddNumberToObject(row, "share", a->share);
  cJSON_AddNumberToObject(row, "time_constant_s", -setup->plan.period_s / log(1.0 - a->share));
  cJSON_AddNumberToObject(row, "rms", m.rms);
  cJSON_AddNumberToObject(row, "max", m.max);
  cJSON_AddNumberToObject(row, "up_4_8cm", a->up_sum / a->up_n);
  cJSON_AddNumberToObject(row, "down_4_8cm", a->down_sum / a->down_n);
  sweep_add_weights(row, &w);
}

static done_t learn_all(const setup_t *setup, const training_t *x, int n, result_t *result, why_t *why) {
  static const double shares[] = {0.5, 0.25, 0.1, 0.01};
  (void)why;
  for (unsigned k = 0; k < sizeof shares / sizeof *shares; k++) {
    average_t a = {.share = shares[k]};
    for (int bin = 0; bin < BINS; bin++) a.newest[bin] = (double)NAN;
    for (int i = 0; i < n; i++) take(&a, &x[i], setup->plan.end_s - BACK_S, i == 0);
    tell(&a, setup, result);
  }
  return DONE;
}

// From 2 cm back to 20 cm at 0.3 m/s.
static void add_way_back(plan_t *plan, double ceiling_m) {
  for (int i = 0; i < 6; i++) {
    const double gap_m = 0.02 + 0.03 * (i + 1);
    plan->way[plan->n_way++] = (waypoint_t){plan->end_s + 0.1 * i, ceiling_m - gap_m};
  }
  plan->end_s += BACK_S;
}

static done_t run(const request_t *request, result_t *result, why_t *why) {
  setup_t setup;
  TRY(sweep_setup(&setup, request, why));
  add_way_back(&setup.plan, setup.model.ceiling_m);
  return sweep_fly(&setup, 0.25, learn_all, result, why);
}

const scenario_t scenario_ols_sweep = {
    .name = "ols-sweep",
    .brief = "moving averages of the measured ratio, fitted by least squares in 21 bins (thesis B.3-B.10)",
    .run = run,
};
