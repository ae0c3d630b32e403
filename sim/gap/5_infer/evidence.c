// evidence.c - a beam search over sets of effects.
#include "gap/5_infer/evidence.h"

#include "base/cholesky.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Prior probability that an effect is there.
#define RARE 0.01
// Sets of each size that are extended: the right one is among the best, and similar ones fill a few places.
#define BEAM 16

// Standard deviations of the priors, over what is typical: a name is reported from an eighth on.
static const double SCALE[] = {0.5, 1.0, 2.0, EVIDENCE_TYPICAL_MOST};
#define SCALES ((int)(sizeof SCALE / sizeof *SCALE))

typedef struct {
  const round_t *r;
  information_t f;
  double *prior; // by candidate: logarithm
  evidence_t *e; // with room for `room` sets
  int room;
} beam_t;

static double set_log(const beam_t *b, const evidence_set_t *s) {
  int column[COLUMN_MAX], n = 0;
  double p[COLUMN_MAX];
  bool positive[COLUMN_MAX];
  for (int i = 0; i < s->n; i++) {
    const candidate_t *const c = &b->r->c->candidate[s->of[i]];
    for (int k = 0; k < c->n; k++) {
      if (!gram_shows(&b->r->gram, c->first + k)) continue;
      column[n] = c->first + k;
      p[n] = 1.0 / (s->scale[i] * s->scale[i]);
      positive[n++] = c->least[k] >= 0.0;
    }
  }
  return evidence_log(&b->f, n, column, p, positive);
}

static evidence_set_t set_with(const evidence_set_t *s, int candidate, int *at) {
  evidence_set_t with = *s;
  int i = with.n++;
  for (; i > 0 && with.of[i - 1] > candidate; i--) {
    with.of[i] = with.of[i - 1];
    with.scale[i] = with.scale[i - 1];
  }
  with.of[i] = candidate;
  *at = i;
  return with;
}

// Adds a candidate: the evidence is averaged over its scales, and the best scale stays.
static evidence_set_t extended(const beam_t *b, const evidence_set_t *s, int candidate) {
  int at;
  evidence_set_t with = set_with(s, candidate, &at);
  double log_of[SCALES], best = -HUGE_VAL, sum = 0.0, scale = SCALE[0];
  for (int q = 0; q < SCALES; q++) {
    with.scale[at] = SCALE[q];
    log_of[q] = set_log(b, &with);
    if (log_of[q] > best) best = log_of[q], scale = SCALE[q];
  }
  for (int q = 0; q < SCALES; q++) sum += exp(log_of[q] - best) / SCALES;
  with.scale[at] = scale;
  with.mixed += log(sum);
  with.log = best + with.mixed;
  for (int i = 0; i < with.n; i++) with.log += b->prior[with.of[i]];
  return with;
}

static bool same(const evidence_set_t *a, const evidence_set_t *b) {
  return a->n == b->n && a->of[0] == b->of[0] && memcmp(a->of, b->of, (size_t)a->n * sizeof *a->of) == 0;
}

// Of a set that is met twice, with other scales, the better one stays. from: the first set of this size.
static void keep(beam_t *b, int from, const evidence_set_t *s) {
  evidence_set_t *const set = b->e->set;
  for (int i = from; i < b->e->n; i++)
    if (same(&set[i], s)) {
      if (s->log > set[i].log) set[i] = *s;
      return;
    }
  if (b->e->n < b->room) set[b->e->n++] = *s;
}

static bool may_join(const beam_t *b, const evidence_set_t *s, int candidate) {
  choice_t choice = {.n = s->n};
  memcpy(choice.of, s->of, (size_t)s->n * sizeof *s->of);
  const candidate_t *const c = &b->r->c->candidate[candidate];
  bool shown = false;
  for (int k = 0; k < c->n; k++) shown = shown || gram_shows(&b->r->gram, c->first + k);
  return shown && !b->r->never[candidate] && round_fits(b->r, &choice, candidate);
}

static int by_log(const void *a, const void *b) {
  const double x = ((const evidence_set_t *)a)->log, y = ((const evidence_set_t *)b)->log;
  return (x < y) - (x > y);
}

static void search(beam_t *b) {
  evidence_set_t *const set = b->e->set;
  b->e->n = 1; // the empty set
  for (int from = 0, to = 1, depth = 0; depth < EVIDENCE_DEPTH && to > from; depth++) {
    const int next = b->e->n, n = b->r->c->n;
#pragma omp parallel for schedule(dynamic, 8)
    for (int q = 0; q < (to - from) * n; q++) {
      const evidence_set_t *const s = &set[from + q / n];
      set[next + q] = may_join(b, s, q % n) ? extended(b, s, q % n) : (evidence_set_t){.n = 0};
    }
    for (int q = 0; q < (to - from) * n; q++) {
      const evidence_set_t with = set[next + q]; // a copy: keep() writes at or before it
      if (with.n > 0) keep(b, next, &with);
    }
    qsort(set + next, (size_t)(b->e->n - next), sizeof *set, by_log);
    from = next;
    to = b->e->n < from + BEAM ? b->e->n : from + BEAM;
  }
}

static void share_out(evidence_t *e) {
  double sum = 0.0;
  qsort(e->set, (size_t)e->n, sizeof *e->set, by_log);
  for (int i = 0; i < e->n; i++) sum += e->set[i].share = exp(e->set[i].log - e->set[0].log);
  for (int i = 0; i < e->n; i++) e->set[i].share /= sum;
}

static void take_priors(beam_t *b) {
  const candidates_t *const c = b->r->c;
  for (int i = 0; i < c->n; i++) b->prior[i] = log(RARE / candidates_of(c, i));
}

static done_t open_beam(beam_t *b, const round_t *r, why_t *why) {
  *b = (beam_t){.r = r, .prior = calloc((size_t)r->c->n + 1, sizeof(double))};
  if (!b->prior) return error_failed(why, "out of memory");
  take_priors(b);
  const done_t status = information_make(&b->f, r, why);
  if (status != DONE) free(b->prior);
  return status;
}

static void close_beam(beam_t *b) {
  information_free(&b->f);
  free(b->prior);
}

done_t evidence_make(evidence_t *e, const round_t *r, why_t *why) {
  beam_t b;
  const int room = 1 + BEAM * EVIDENCE_DEPTH * r->c->n;
  *e = (evidence_t){.set = calloc((size_t)room, sizeof(evidence_set_t))};
  if (!e->set) return error_failed(why, "out of memory");
  TRY(open_beam(&b, r, why));
  b.e = e;
  b.room = room;
  search(&b);
  share_out(e);
  close_beam(&b);
  return DONE;
}

// Log of evidence times prior of a choice without member `without`; < 0: of all members.
static double choice_log(const beam_t *b, const choice_t *choice, int without) {
  evidence_set_t s = {.n = 0};
  for (int i = 0; i < choice->n; i++)
    if (i != without && s.n < EVIDENCE_DEPTH) s = extended(b, &s, choice->of[i]);
  return s.log;
}

// The same with member i in any form: its forms share one prior, and where they look alike it does not matter
// which one it is.
static double any_form_log(const beam_t *b, const choice_t *choice, int i) {
  const candidates_t *const c = b->r->c;
  double best = choice_log(b, choice, -1), sum = 1.0;
  for (int k = 0; k < c->n; k++) {
    choice_t other = *choice;
    if (k == choice->of[i] || b->r->never[k] ||
        !candidates_exclude(&c->candidate[k], &c->candidate[choice->of[i]]))
      continue;
    other.of[i] = k;
    const double log_k = choice_log(b, &other, -1);
    sum = log_k > best ? sum * exp(best - log_k) + 1.0 : sum + exp(log_k - best);
    best = fmax(best, log_k);
  }
  return best + log(sum);
}

done_t evidence_odds(const round_t *r, double odds[NAMED_MAX], why_t *why) {
  beam_t b;
  TRY(open_beam(&b, r, why));
  for (int i = 0; i < r->choice.n; i++)
    odds[i] = any_form_log(&b, &r->choice, i) - choice_log(&b, &r->choice, i);
  close_beam(&b);
  return DONE;
}

// Sets the information on columns from .. to - 1 that a choice, of any size, leaves; none where there is no
// solution.
static void left_beside(const information_t *f, const candidates_t *c, const choice_t *choice, int from,
                        int to, double *left) {
  int column[COLUMN_MAX];
  double Q[COLUMN_MAX * COLUMN_MAX], z[COLUMN_MAX];
  const int n = choice_columns(c, choice, column);
  for (int i = 0; i < n; i++)
    for (int k = 0; k < n; k++)
      Q[i * n + k] = f->F[column[i] * f->n + column[k]] +
                     (i == k ? 1.0 / (EVIDENCE_TYPICAL_MOST * EVIDENCE_TYPICAL_MOST) : 0.0);
  const bool known = cholesky(Q, n);
  for (int k = from; k < to; k++) {
    for (int i = 0; i < n; i++) z[i] = f->F[column[i] * f->n + k];
    if (known) cholesky_forward(Q, n, z);
    left[k] = known ? f->F[k * (f->n + 1)] : 0.0;
    for (int i = 0; i < n; i++) left[k] -= z[i] * z[i];
  }
}

// Returns the log odds of an effect with one number, of which the rows hold this information.
static double odds_of(double information, double size) {
  double sum = 0.0;
  for (int q = 0; q < SCALES; q++) {
    const double with = information * SCALE[q] * SCALE[q];
    sum += exp(0.5 * information * size * size * with / (1.0 + with)) / sqrt(1.0 + with) / SCALES;
  }
  return log(RARE * sum);
}

// Returns the size with even odds, to the last bit: halving ends where no number lies between.
static double even_odds(double information) {
  const double error = 1.0 / sqrt(information);
  double less = 0.0, more = error;
  while (odds_of(information, more) < 0.0 && more < HUGE_VAL) more *= 2.0;
  for (double half = 0.5 * more; half > less && half < more; half = 0.5 * (less + more))
    *(odds_of(information, half) < 0.0 ? &less : &more) = half;
  return more;
}

done_t evidence_least(const round_t *r, double *least, why_t *why) {
  information_t f;
  TRY(information_make(&f, r, why));
  left_beside(&f, r->c, &r->choice, 0, f.n, least);
  for (int i = 0; i < r->choice.n; i++) {
    const candidate_t *const own = &r->c->candidate[r->choice.of[i]];
    const choice_t others = choice_without(&r->choice, r->choice.of[i]);
    left_beside(&f, r->c, &others, own->first, own->first + own->n, least);
  }
  for (int k = 0; k < f.n; k++) least[k] = least[k] > 0.0 ? even_odds(least[k]) : HUGE_VAL;
  information_free(&f);
  return DONE;
}

void evidence_free(evidence_t *e) {
  free(e->set);
  *e = (evidence_t){.n = 0};
}

static bool holds(const evidence_set_t *s, const candidates_t *c, int n, const int *candidate) {
  for (int k = 0; k < s->n; k++)
    for (int m = 0; m < n; m++)
      if (candidates_exclude(&c->candidate[s->of[k]], &c->candidate[candidate[m]])) return true;
  return false;
}

double evidence_of(const evidence_t *e, const candidates_t *c, int n, const int *candidate) {
  double sum = 0.0;
  for (int i = 0; i < e->n; i++) sum += holds(&e->set[i], c, n, candidate) ? e->set[i].share : 0.0;
  return fmin(sum, 1.0); // rounding errors add up
}

const evidence_set_t *evidence_without(const evidence_t *e, const candidates_t *c, int n,
                                       const int *candidate) {
  for (int i = 0; i < e->n; i++)
    if (!holds(&e->set[i], c, n, candidate)) return &e->set[i];
  return NULL;
}
