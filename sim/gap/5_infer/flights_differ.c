// flights_differ.c - constants by which each flight differs from the others.
#include "gap/5_infer/flights_differ.h"

#include "gap/5_infer/unknown.h"
#include <math.h>
#include <stdlib.h>

// --- the constants ----------------------------------------------------------------------------------------

static done_t find_means(flights_differ_t *d, const set_t *s, const model_t *base,
                         double *const residual[CHANNELS], why_t *why) {
  const rows_t *const r = set_rows(s, d->cell.channel);
  color_t color[CHANNELS];
  TRY(unknown_colors(s, base, residual, color, why));
  const color_t *const own = &color[d->cell.channel];
  double *const white = malloc(((size_t)r->n + 1) * sizeof(double));
  if (!white) return error_failed(why, "out of memory");
  color_whiten(own, r, residual[d->cell.channel], white);
  double mean = 0.0; // over flights, equally weighted: they differ by more than their errors
  int n = 0;
  for (int from = 0; from < r->n;) {
    const color_constant_t k = color_constant(own, r, from, white);
    if (k.holds > 0.0) {
      d->mean[r->flight[from]] = k.mean;
      d->error[r->flight[from]] = 1.0 / sqrt(k.holds);
      mean += k.mean, n++;
    }
    from = k.end;
  }
  for (int f = 0; f < d->n; f++)
    if (d->error[f] > 0.0) d->mean[f] -= mean / n;
  free(white);
  return DONE;
}

// --- effects that would do --------------------------------------------------------------------------------

// Sums of products of each flight and, last, of all: `of` one group of channels, and `whole`, because an
// effect that would do in one group acts in the others, too.
typedef struct {
  int size;
  double *of, *whole;
} sums_t;

static double *sums_in(const sums_t *t, double *of, int flight) {
  return of + (size_t)flight * (size_t)(t->size * t->size);
}

static done_t sums_make(sums_t *t, const remains_t *left, int flights, int group, why_t *why) {
  const size_t n = (size_t)(left->g.size * left->g.size), all = ((size_t)flights + 1) * n;
  *t = (sums_t){left->g.size, calloc(2 * all, sizeof(double)), NULL};
  if (!t->of) return error_failed(why, "out of memory");
  t->whole = t->of + all;
  for (int f = 0; f < flights; f++)
    for (int which = 0; which < 2; which++) {
      double *const begin = which ? t->whole : t->of, *const to = sums_in(t, begin, f);
      for (int k = 0; k < GROUPS; k++)
        for (size_t half = 2 * (size_t)f; half < 2 * (size_t)f + 2 && (which || k == group); half++)
          for (size_t i = 0; i < n; i++) to[i] += left->g.by_group[k][half * n + i];
      remains_put_back(left, to);
      for (size_t i = 0; i < n; i++) sums_in(t, begin, flights)[i] += to[i];
    }
  return DONE;
}

// Returns the squares that a constant per flight takes in a group beyond one for all, by spread alone.
static double by_constants(const set_t *s, const color_t color[CHANNELS], double *const residual[CHANNELS],
                           int group) {
  double sum = 0.0;
  for (int ch = 0; ch < CHANNELS; ch++) {
    const rows_t *const r = set_rows(s, ch);
    if (group_of(ch) != group || !color[ch].used) continue;
    const color_t spread = {.sd = 1.0, .used = true};
    sum += color_differ(&spread, r, residual[ch]).q / (color[ch].sd * color[ch].sd);
  }
  return sum;
}

// Sets a candidate's sizes in each flight; returns what they take more than one size for all. largest: the
// flight's sizes that are largest over typical.
static double takes_more(const flights_differ_t *d, const sums_t *t, const candidate_t *c,
                         const fx_use_t *chosen, fx_use_t *use, fx_use_t *largest) {
  fx_use_t same;
  double taken = -acts_takes(c, chosen, sums_in(t, t->whole, d->n), sums_in(t, t->of, d->n), t->size, &same);
  double most = -1.0;
  for (int f = 0; f < d->n; f++) {
    double size = 0.0;
    taken += acts_takes(c, chosen, sums_in(t, t->whole, f), sums_in(t, t->of, f), t->size, &use[f]);
    for (int k = 0; k < c->n; k++) size = fmax(size, fabs(fx_use_size(&use[f], k)) / c->typical[k]);
    if (size > most) *largest = use[f];
    most = fmax(most, size);
  }
  return taken;
}

static void judge(flights_differ_t *d, const sums_t *t, const candidates_t *c, const chosen_t *chosen,
                  double beyond) {
  fx_use_t largest;
  for (int i = 0; i < c->n; i++) {
    const double taken = takes_more(d, t, &c->candidate[i], chosen_use(chosen, i), d->use, &largest);
    acts_add(&d->as, c, i, &largest, taken, beyond);
  }
  acts_keep_best(&d->as);
  for (int i = 0; i < d->as.n; i++) {
    const int one = d->as.would[i].candidate;
    takes_more(d, t, &c->candidate[one], chosen_use(chosen, one), d->use + i * d->n, &largest);
  }
}

static done_t find_what_would(flights_differ_t *d, set_t *s, double *const residual[CHANNELS],
                              const model_t *base, const candidates_t *c, const chosen_t *chosen,
                              why_t *why) {
  const int group = group_of(d->cell.channel);
  remains_t left;
  sums_t sums = {.of = NULL};
  done_t status = remains_make(&left, s, base, c, chosen, why);
  if (status == DONE) status = sums_make(&sums, &left, d->n, group, why);
  if (status == DONE) judge(d, &sums, c, chosen, by_constants(s, left.g.color, residual, group));
  free(sums.of);
  remains_free(&left);
  return status;
}

done_t flights_differ_make(flights_differ_t *d, set_t *s, double *const residual[CHANNELS],
                           const model_t *base, const candidates_t *c, const chosen_t *chosen,
                           const cell_t *cell, why_t *why) {
  const size_t n = (size_t)s->n_grid;
  *d = (flights_differ_t){.n = s->n_grid,
                          .cell = *cell,
                          .mean = calloc(n, sizeof(double)),
                          .error = calloc(n, sizeof(double)),
                          .use = calloc(ACTS_AS_MAX * n, sizeof(fx_use_t))};
  if (!d->mean || !d->error || !d->use) return error_failed(why, "out of memory");
  TRY(find_means(d, s, base, residual, why));
  return find_what_would(d, s, residual, base, c, chosen, why);
}

void flights_differ_free(flights_differ_t *d) {
  free(d->mean);
  free(d->error);
  free(d->use);
  *d = (flights_differ_t){.n = 0};
}
