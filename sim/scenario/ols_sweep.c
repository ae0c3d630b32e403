// ols_sweep.c - the thesis's figures B.3 to B.10: the measured ratio through a moving average, the newest
// value of each of 21 bins fitted by least squares. On a fast way down the slow averages still carry the
// ratio of 2 cm: two lines.
#include "scenario/scenario.h"

#include "lsq.h"
#include "taught.h"
#include <math.h>
#include <stdlib.h>

#define BINS  21
#define BIN_M 0.005

typedef struct {
  double share;            // of a new sample, the thesis's v_t
  double newest[BINS];     // NaN: not visited
  double up_sum, down_sum; // filtered ratio between 4 and 8 cm on the way to the ceiling and back
  int up_n, down_n;
  double y;
} average_t;

static void take(average_t *a, const taught_t *x, double turn_s, bool first) {
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
  const misfit_t m = taught_misfit(&w, &setup->model, 0.02, 0.10);
  cJSON *row = result_add_row(result, "fits");
  cJSON_AddNumberToObject(row, "share", a->share);
  cJSON_AddNumberToObject(row, "time_constant_s", -setup->period_s / log(1.0 - a->share));
  cJSON_AddNumberToObject(row, "rms", m.rms);
  cJSON_AddNumberToObject(row, "max", m.max);
  cJSON_AddNumberToObject(row, "up_4_8cm", a->up_sum / a->up_n);
  cJSON_AddNumberToObject(row, "down_4_8cm", a->down_sum / a->down_n);
  for (int i = 0; i < RBF_N; i++) {
    char name[24];
    snprintf(name, sizeof name, "w%d", i + 1);
    cJSON_AddNumberToObject(row, name, (double)w.w[i]);
  }
}

static status_t sweep(const setup_t *setup, const record_t *record, double turn_s, result_t *result,
                      why_t *why) {
  static const double shares[] = {0.5, 0.25, 0.1, 0.01};
  taught_t *x = calloc((size_t)record->n, sizeof *x);
  if (!x) return error_failed(why, "out of memory");
  const int n = taught_of(record, setup, 0.25, x);
  for (unsigned k = 0; k < sizeof shares / sizeof *shares; k++) {
    average_t a = {.share = shares[k]};
    for (int bin = 0; bin < BINS; bin++) a.newest[bin] = (double)NAN;
    for (int i = 0; i < n; i++) take(&a, &x[i], turn_s, i == 0);
    tell(&a, setup, result);
  }
  free(x);
  return ST_OK;
}

// The learning ladder, and back from 2 cm to 20 cm at 0.3 m/s.
static double ladder_and_back(plan_t *plan, double ceiling_m) {
  setup_learning_ladder(plan, ceiling_m);
  const double turn_s = plan->end_s;
  for (int i = 0; i < 6; i++) {
    const double gap_m = 0.02 + 0.03 * (i + 1);
    plan->way[plan->n_way++] = (waypoint_t){turn_s + 0.1 * i, ceiling_m - gap_m};
  }
  plan->end_s += 10.0;
  return turn_s;
}

static status_t run(const request_t *request, result_t *result, why_t *why) {
  setup_t setup;
  TRY(scenario_appendix_a_setup(&setup, FLY_INDI_LIVE, why));
  setup.plan.noise = noise_levels[1];
  TRY(setup_apply(&setup, request, why));
  TRY(scenario_check_ladder(&setup.model, why));
  if (setup.kind == FLY_PID || setup.kind == FLY_PID_FF)
    return error_set(why, "--controller %s: knows no ceiling distance to learn from", fly_name[setup.kind]);
  const double turn_s = ladder_and_back(&setup.plan, setup.model.ceiling_m);
  flown_t flown;
  TRY(setup_fly(&setup, &flown, why));
  const status_t status = sweep(&setup, &flown.record, turn_s, result, why);
  result_add_flight(result, &flown);
  flown_free(&flown);
  return status;
}

const scenario_t scenario_ols_sweep = {
    .name = "ols-sweep",
    .brief = "moving averages of the measured ratio, fitted by least squares in 21 bins (thesis B.3-B.10)",
    .run = run,
};
