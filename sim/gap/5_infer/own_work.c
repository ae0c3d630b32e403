// own_work.c - what a name takes in the log, and in flights of the model without it.
#include "gap/5_infer/own_work.h"

#include "gap/5_infer/loop_fit.h"
#include "gap/5_infer/score.h"
#include <math.h>

// The chosen candidates alone, each with own columns. Those in question may be own work.
typedef struct {
  candidates_t names;
  chosen_t without;    // all but those in question
  choice_t rest, with; // the same; and with those in question behind them
  score_t score;
} asked_t;

static bool is_in(int n, const int *candidate, int which) {
  for (int k = 0; k < n; k++)
    if (candidate[k] == which) return true;
  return false;
}

static done_t ask(asked_t *a, const own_work_job_t *job, const chosen_t *chosen, int n, const int *candidate,
                  why_t *why) {
  *a = (asked_t){.rest = {.n = 0}};
  TRY(candidates_chosen(&a->names, &a->without, job->c, chosen, why));
  for (int i = 0; i < chosen->n; i++)
    if (!is_in(n, candidate, chosen->of[i])) a->rest = choice_with(&a->rest, i);
  a->with = a->rest;
  for (int i = 0; i < chosen->n; i++) {
    if (!is_in(n, candidate, chosen->of[i])) continue;
    a->with = choice_with(&a->with, i);
    chosen_drop(&a->without, i);
  }
  return score_make(&a->score, &a->names, NULL, NULL, why);
}

static void ask_no_more(asked_t *a) {
  score_free(&a->score);
  candidates_free(&a->names);
}

// Returns sqrt(before / after - 1) of the sums of squares without and with those in question; a single
// number gives it its sign.
static double takes(const asked_t *a, const double *total) {
  const int size = a->names.columns + 1;
  int column[COLUMN_MAX];
  double b[COLUMN_MAX];
  const int rest = choice_columns(&a->names, &a->rest, column);
  const double before = lsq_solve_products(total, size, column, rest, a->score.ridge, b, NULL);
  const int all = choice_columns(&a->names, &a->with, column);
  const double after = lsq_solve_products(total, size, column, all, a->score.ridge, b, NULL);
  if (!(after > 0.0)) return 0.0;
  return copysign(sqrt(fmax(before / after - 1.0, 0.0)), all - rest == 1 ? b[rest] : 1.0);
}

// takes() of the log, whitened as nominal flights are.
static done_t takes_in_log(const asked_t *a, const own_work_job_t *job, double *takes_of_it, why_t *why) {
  design_t t;
  gram_t g;
  model_t m;
  double between[CHANNELS];
  TRY(chosen_model(&a->without, job->base, &m, why));
  TRY(whiten_between(job->set, &m, between, why));
  TRY(design_make(&t, job->set, job->base, &a->names, &a->without, why));
  design_add_chosen(&t, job->set, &a->names, &a->without, -1.0);
  const done_t status = gram_make_total(&g, job->set, &t, a->score.ridge, between, why);
  if (status == DONE) *takes_of_it = takes(a, g.total);
  if (status == DONE) gram_free(&g);
  design_free(&t);
  return status;
}

static done_t fly_without(const asked_t *a, const own_work_job_t *job, nominal_t *n, why_t *why) {
  closed_loop_t loop;
  model_t m;
  TRY(chosen_model(&a->without, job->base, &m, why));
  TRY(loop_fit(&loop, job->set, &m, job->flown_by, job->trial_seed, why));
  const nominal_job_t nominal = {job->set,    job->base, m,         &a->names,
                                 &a->without, &loop,     job->seed, a->score.ridge};
  return nominal_make(n, &nominal, why);
}

// Returns by how much takes() of the log exceeds the nominal flights' mean, over the bound of chance: their
// scatter and, because the pilot may be no cascade, NOMINAL_VARIED of their mean. HUGE_VAL: none flew.
static double beyond(const asked_t *a, const nominal_t *n, double log) {
  double mean = 0.0, squares = 0.0;
  for (int i = 0; i < n->n; i++) {
    const double here = takes(a, n->total + (size_t)i * (size_t)(n->size * n->size));
    mean += here / n->n;
    squares += here * here / n->n;
  }
  const double scatter = sqrt(fmax(squares - mean * mean, 0.0) * n->n / fmax(n->n - 1, 1));
  const double bound = limits_nominal(n->n) * hypot(scatter, NOMINAL_VARIED * mean);
  return n->n && bound > 0.0 ? copysign(1.0, log) * (log - mean) / bound : HUGE_VAL;
}

static done_t find_beyond(const own_work_job_t *job, const chosen_t *chosen, int n, const int *candidate,
                          double *more, why_t *why) {
  asked_t a;
  nominal_t flown = {.n = 0};
  double log = 0.0;
  done_t status = ask(&a, job, chosen, n, candidate, why);
  if (status == DONE) status = takes_in_log(&a, job, &log, why);
  if (status == DONE) status = fly_without(&a, job, &flown, why);
  if (status == DONE) *more = beyond(&a, &flown, log);
  nominal_free(&flown);
  ask_no_more(&a);
  return status;
}

// If all together exceed what control makes, one of them must: the one that exceeds it most stays.
done_t own_work(const own_work_job_t *job, const chosen_t *chosen, int n, const int *candidate, bool *own,
                why_t *why) {
  double all = 0.0, each[CHOSEN_MAX];
  int most = 0;
  if (n > 0) TRY(find_beyond(job, chosen, n, candidate, &all, why));
  for (int k = 0; k < n; k++) {
    each[k] = all;
    if (all >= 1.0 && n > 1) TRY(find_beyond(job, chosen, 1, &candidate[k], &each[k], why));
    if (each[k] > each[most]) most = k;
  }
  for (int k = 0; k < n; k++) own[k] = each[k] < 1.0 && !(all >= 1.0 && k == most);
  return DONE;
}
