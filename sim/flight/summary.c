// summary.c - statistics of many flights of one command: adding, joining, quantiles.
#include "flight/summary.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#define LOWEST (-10) // octave: numbers nearer to zero than 2^-10 count as zero

// --- bins -------------------------------------------------------------------------------------------------

// Returns the bin of x > 0, counted from zero: 0 is about zero, 1 begins at 2^-10, SUMMARY_FINE to an octave.
static int bin_above(double x) {
  int octave; // x = share 2^octave, share from 0.5 to 1
  const double share = frexp(x, &octave);
  const int bin = (octave - 1 - LOWEST) * SUMMARY_FINE + (int)((2.0 * share - 1.0) * SUMMARY_FINE) + 1;
  return bin < 0 ? 0 : bin > SUMMARY_SIDE ? SUMMARY_SIDE : bin;
}

static int bin_of(double x) {
  const double size = fabs(x);
  const int bin = size < ldexp(1.0, LOWEST) ? 0 : bin_above(size);
  return SUMMARY_SIDE + (x < 0.0 ? -bin : bin);
}

static double middle_of(int bin) {
  const int off = abs(bin - SUMMARY_SIDE) - 1;
  if (off < 0) return 0.0;
  const double middle = ldexp(1.0 + (off % SUMMARY_FINE + 0.5) / SUMMARY_FINE, off / SUMMARY_FINE + LOWEST);
  return bin < SUMMARY_SIDE ? -middle : middle;
}

double summary_quantile(const measure_t *m, double share) {
  if (m->flights < 1) return (double)NAN;
  const double wanted = share * (double)m->flights;
  int64_t below = 0;
  int bin = 0;
  for (; bin < SUMMARY_BINS - 1; bin++) {
    below += m->in[bin];
    if (below > 0 && (double)below >= wanted) break;
  }
  return fmin(fmax(middle_of(bin), m->least), m->most);
}

double summary_mean(const measure_t *m) {
  return m->flights > 0 ? (double)m->sum * SUMMARY_STEP / (double)m->flights : (double)NAN;
}

// --- seeds ------------------------------------------------------------------------------------------------

// Returns where these seeds go among those that are there; -1: some are there already.
static int place_of(const summary_t *s, seeds_t new) {
  int at = 0;
  while (at < s->n_seeds && s->seeds[at].to < new.from) at++;
  return at < s->n_seeds && s->seeds[at].from <= new.to ? -1 : at;
}

static done_t seeds_add(summary_t *s, seeds_t new, why_t *why) {
  const int at = place_of(s, new);
  if (at < 0)
    return error_set(why, "seeds %llu to %llu: some are in it already; allowed: each flight counts once",
                     (unsigned long long)new.from, (unsigned long long)new.to);
  const bool to_left = at > 0 && s->seeds[at - 1].to + 1 == new.from;
  const bool to_right = at < s->n_seeds && new.to + 1 == s->seeds[at].from;
  if (to_left) s->seeds[at - 1].to = new.to;
  if (to_right) s->seeds[at].from = to_left ? s->seeds[at - 1].from : new.from;
  if (to_left && to_right) {
    s->n_seeds--;
    memmove(&s->seeds[at - 1], &s->seeds[at], (size_t)(s->n_seeds - at + 1) * sizeof *s->seeds);
  }
  if (to_left || to_right) return DONE;
  seeds_t *const more = realloc(s->seeds, ((size_t)s->n_seeds + 1) * sizeof *more);
  if (!more) return error_failed(why, "out of memory");
  s->seeds = more;
  memmove(&more[at + 1], &more[at], (size_t)(s->n_seeds - at) * sizeof *more);
  more[at] = new;
  s->n_seeds++;
  return DONE;
}

// --- measures ---------------------------------------------------------------------------------------------

// Returns the measure of this name, which is made if it is new. A null pointer: no memory.
static measure_t *measure_of(summary_t *s, const char *name) {
  int at = 0;
  while (at < s->n_measure && strcmp(s->measure[at].name, name) < 0) at++;
  if (at < s->n_measure && strcmp(s->measure[at].name, name) == 0) return &s->measure[at];
  measure_t *const more = realloc(s->measure, ((size_t)s->n_measure + 1) * sizeof *more);
  if (!more) return NULL;
  s->measure = more;
  memmove(&more[at + 1], &more[at], (size_t)(s->n_measure - at) * sizeof *more);
  more[at] = (measure_t){.least = HUGE_VAL, .most = -HUGE_VAL};
  snprintf(more[at].name, sizeof more[at].name, "%s", name);
  s->n_measure++;
  return &more[at];
}

static done_t add_number(summary_t *s, const char *name, double x, why_t *why) {
  measure_t *const m = measure_of(s, name);
  if (!m) return error_failed(why, "out of memory");
  if (isnan(x)) return DONE;
  const double within = fmin(fmax(x, -SUMMARY_LIMIT), SUMMARY_LIMIT);
  m->flights++;
  m->sum += llround(within / SUMMARY_STEP);
  m->least = fmin(m->least, within);
  m->most = fmax(m->most, within);
  m->in[bin_of(within)]++;
  return DONE;
}

static double number(const cJSON *item) {
  return cJSON_IsNumber(item) ? item->valuedouble : (double)NAN;
}

static done_t add_segments(summary_t *s, const cJSON *segments, why_t *why) {
  const cJSON *row, *cell;
  int segment = 0;
  cJSON_ArrayForEach(row, segments) {
    segment++;
    cJSON_ArrayForEach(cell, row) {
      if (!cJSON_IsNumber(cell) && !cJSON_IsNull(cell)) continue; // its label
      char name[sizeof s->measure->name];
      if (snprintf(name, sizeof name, "%02d.%s", segment, cell->string) >= (int)sizeof name)
        return error_failed(why, "a number's name is too long for a summary");
      TRY(add_number(s, name, number(cell), why));
    }
  }
  return DONE;
}

done_t summary_make(summary_t *s, const char *cell, const char *by, why_t *why) {
  const size_t of_cell = strlen(cell) + 1, of_by = strlen(by) + 1;
  *s = (summary_t){.cell = malloc(of_cell), .by = malloc(of_by)};
  if (!s->cell || !s->by) return error_failed(why, "out of memory");
  memcpy(s->cell, cell, of_cell);
  memcpy(s->by, by, of_by);
  return DONE;
}

void summary_free(summary_t *s) {
  free(s->cell);
  free(s->by);
  free(s->seeds);
  free(s->measure);
  *s = (summary_t){0};
}

done_t summary_add(summary_t *s, uint64_t seed, const cJSON *result, why_t *why) {
  const double contacts = number(cJSON_GetObjectItem(result, "contacts"));
  TRY(seeds_add(s, (seeds_t){seed, seed}, why));
  s->flights++;
  s->touched += contacts > 0.0;
  s->not_finite += cJSON_IsFalse(cJSON_GetObjectItem(result, "finite"));
  TRY(add_number(s, "all.contacts", contacts, why));
  TRY(add_number(s, "all.min_gap_mm", number(cJSON_GetObjectItem(result, "min_gap_mm")), why));
  TRY(add_number(s, "all.tilt_max_deg", number(cJSON_GetObjectItem(result, "tilt_max_deg")), why));
  return add_segments(s, cJSON_GetObjectItem(result, "segments"), why);
}

static bool sums_fit(const summary_t *s, const summary_t *more) {
  int64_t sum;
  for (int i = 0; i < more->n_measure; i++)
    for (int k = 0; k < s->n_measure; k++)
      if (strcmp(s->measure[k].name, more->measure[i].name) == 0 &&
          __builtin_add_overflow(s->measure[k].sum, more->measure[i].sum, &sum))
        return false;
  return true;
}

done_t summary_join(summary_t *s, const summary_t *more, why_t *why) {
  if (strcmp(s->by, more->by) != 0)
    return error_set(why, "%s: flown by %s, and by %s elsewhere; allowed: the same version", s->cell,
                     more->by, s->by);
  for (int i = 0; i < more->n_seeds; i++)
    if (place_of(s, more->seeds[i]) < 0)
      return error_set(why, "%s: of the seeds %llu to %llu some are there twice; allowed: each flight once",
                       s->cell, (unsigned long long)more->seeds[i].from,
                       (unsigned long long)more->seeds[i].to);
  if (!sums_fit(s, more)) return error_set(why, "%s: more than a sum holds", s->cell);
  for (int i = 0; i < more->n_seeds; i++) TRY(seeds_add(s, more->seeds[i], why));
  s->flights += more->flights;
  s->touched += more->touched;
  s->not_finite += more->not_finite;
  for (int i = 0; i < more->n_measure; i++) {
    const measure_t *const from = &more->measure[i];
    measure_t *const to = measure_of(s, from->name);
    if (!to) return error_failed(why, "out of memory");
    to->flights += from->flights;
    to->sum += from->sum;
    to->least = fmin(to->least, from->least);
    to->most = fmax(to->most, from->most);
    for (int k = 0; k < SUMMARY_BINS; k++) to->in[k] += from->in[k];
  }
  return DONE;
}
