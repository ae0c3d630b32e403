// 7_verify_names.c - names that held-out flights contradict.
#include "gap/7_verify.h"

#include "gap/lines.h"
#include <math.h>

static double rms_of(const double *v, int n) {
  double squares = 0.0;
  for (int i = 0; i < n; i++) squares += v[i] * v[i];
  return n ? sqrt(squares / n) : 0.0;
}

// What the model with the names that are marked leaves of every channel; 0 where the rows are too few.
static status_t measure(diagnosis_t *d, const model_t *base, double rms[CHANNELS], why_t *why) {
  model_t m;
  lines_t l = {.r = {NULL}};
  TRY(candidates_model(&d->candidates, base, &m, why));
  status_t status = lines_make(&l, &d->held, why);
  if (status == ST_OK) status = residual_of(&d->held, &m, l.r, why);
  for (int ch = 0; ch < CHANNELS && status == ST_OK; ch++) {
    const rows_t *const rows = set_rows(&d->held, ch);
    const bool used = residual_has(&d->held, ch) && color_fit(rows, l.r[ch]).used;
    rms[ch] = used ? rms_of(l.r[ch], rows->n) : 0.0;
  }
  lines_free(&l);
  return status;
}

// Sum over the channels of the logarithm of what the rms is multiplied by.
static double balance(const double with[CHANNELS], const double without[CHANNELS]) {
  double sum = 0.0;
  for (int ch = 0; ch < CHANNELS; ch++)
    if (with[ch] > 0.0 && without[ch] > 0.0) sum += log(with[ch] / without[ch]);
  return sum;
}

// The name that grows some channel most, if it is by more than it may and the others do not gain twice as
// much; -1: none.
static status_t find_worst(diagnosis_t *d, const model_t *base, int *worst, withdrawn_t *why_so, why_t *why) {
  double with[CHANNELS], without[CHANNELS], most = VERIFY_GROWS;
  *worst = -1;
  TRY(measure(d, base, with, why));
  for (int i = 0; i < d->found.n; i++) {
    candidate_t *const c = &d->candidates.candidate[d->found.named[i].candidate];
    c->named = false;
    const status_t status = measure(d, base, without, why);
    c->named = true;
    if (status != ST_OK) return status;
    const double total = balance(with, without);
    for (int ch = 0; ch < CHANNELS; ch++) {
      if (!(without[ch] > 0.0) || !(with[ch] > most * without[ch])) continue;
      if (total < -log(with[ch] / without[ch])) continue;
      most = with[ch] / without[ch];
      *worst = i;
      *why_so = (withdrawn_t){c->use.fx, ch, without[ch], with[ch]};
    }
  }
  return ST_OK;
}

static void withdraw(diagnosis_t *d, int worst) {
  candidate_t *const c = &d->candidates.candidate[d->found.named[worst].candidate];
  c->named = false;
  for (int k = 0; k < c->n; k++) *candidate_value(c, k) = 0.0;
  for (int i = worst + 1; i < d->found.n; i++) d->found.named[i - 1] = d->found.named[i];
  d->found.n--;
}

status_t verify_names(diagnosis_t *d, const model_t *base, why_t *why) {
  int worst = 0;
  while (d->found.n > 0) {
    TRY(find_worst(d, base, &worst, &d->withdrawn[d->n_withdrawn], why));
    if (worst < 0) return ST_OK;
    d->n_withdrawn++;
    withdraw(d, worst);
  }
  return ST_OK;
}
