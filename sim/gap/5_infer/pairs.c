// pairs.c - two effects that hide each other.
#include "gap/5_infer/pairs.h"

#include <math.h>
#include <stdlib.h>

// Sets what each candidate takes beside the choice; NaN: it may not stand there.
static void take_alone(const round_t *r, const bool *out, double now, double *takes) {
  for (int i = 0; i < r->c->n; i++) {
    const bool may = !out[i] && !r->never[i] && !choice_has(&r->choice, i) && round_fits(r, &r->choice, i);
    const choice_t with = choice_with(&r->choice, i);
    takes[i] = may ? fmax(now - round_left(r, &with), 0.0) : (double)NAN;
  }
}

static hiding_t what_hides(const round_t *r, double now, const double *takes, int i, int k) {
  const choice_t one = choice_with(&r->choice, i), both = choice_with(&one, k);
  const bool may = !isnan(takes[i]) && !isnan(takes[k]) && round_fits(r, &one, k);
  return (hiding_t){{i, k}, may ? now - round_left(r, &both) - takes[i] - takes[k] : 0.0};
}

static int by_more(const void *a, const void *b) {
  const double x = ((const hiding_t *)a)->more, y = ((const hiding_t *)b)->more;
  return (x < y) - (x > y);
}

done_t pairs_find(pairs_t *p, const round_t *r, const bool *out, why_t *why) {
  const int n = r->c->n;
  const double now = round_left(r, &r->choice);
  double *const takes = calloc((size_t)n + 1, sizeof *takes);
  *p = (pairs_t){.pair = calloc((size_t)(n * n) + 1, sizeof(hiding_t))};
  if (!takes || !p->pair) {
    free(takes);
    return error_failed(why, "out of memory");
  }
  take_alone(r, out, now, takes);
#pragma omp parallel for schedule(dynamic, 4)
  for (int i = 0; i < n; i++)
    for (int k = i + 1; k < n; k++) p->pair[i * n + k] = what_hides(r, now, takes, i, k);
  free(takes);
  for (int i = 0; i < n * n; i++)
    if (p->pair[i].more > SELECT_GAIN * now) p->pair[p->n++] = p->pair[i];
  qsort(p->pair, (size_t)p->n, sizeof *p->pair, by_more);
  return DONE;
}

bool pairs_sure(const round_t *r, const hiding_t *pair) {
  const double pairs = 0.5 * r->c->n * (r->c->n - 1);
  for (int i = 0; i < 2; i++) {
    const choice_t other = choice_with(&r->choice, pair->of[!i]), both = choice_with(&other, pair->of[i]);
    if (!(score_last(&r->score, &both).p * pairs < SELECT_ALPHA)) return false;
  }
  return true;
}

void pairs_free(pairs_t *p) {
  free(p->pair);
  *p = (pairs_t){.n = 0};
}
