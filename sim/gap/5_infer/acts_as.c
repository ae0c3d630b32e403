// acts_as.c - which single effects of the library would explain what is left on some rows.
#include "gap/5_infer/acts_as.h"

#include "base/lsq_blocks.h"
#include "gap/5_infer/evidence.h"
#include "gap/5_infer/limits.h"
#include "gap/5_infer/unknown.h"
#include <math.h>

static void take_numbers(remains_t *r, const candidates_t *c, const chosen_t *chosen) {
  r->n = 0;
  for (int i = 0; i < chosen->n; i++) {
    const candidate_t *const one = &c->candidate[chosen->of[i]];
    for (int k = 0; k < one->n; k++, r->n++) {
      r->column[r->n] = one->first + k;
      r->b[r->n] = fx_use_size(&chosen->use[i], k);
    }
  }
}

done_t remains_make(remains_t *r, set_t *s, const model_t *base, const candidates_t *c,
                    const chosen_t *chosen, why_t *why) {
  design_t table = {.columns = 0};
  r->g = (gram_t){.size = 0};
  take_numbers(r, c, chosen);
  const explained_t known = {r->n, r->column, r->b, true, NULL};
  done_t status = design_make(&table, s, base, c, chosen, why);
  if (status == DONE) status = gram_make(&r->g, s, &table, &known, NULL, why);
  design_free(&table);
  return status;
}

void remains_free(remains_t *r) {
  gram_free(&r->g);
}

void remains_put_back(const remains_t *r, double *G) {
  const int size = r->g.size, last = size - 1, n = r->n, *column = r->column;
  const double *const b = r->b;
  double squares = G[last * size + last];
  for (int k = 0; k < n; k++) {
    squares -= 2.0 * b[k] * G[column[k] * size + last];
    for (int i = 0; i < n; i++) squares += b[k] * b[i] * G[column[k] * size + column[i]];
  }
  for (int j = 0; j < last; j++)
    for (int k = 0; k < n; k++) {
      G[j * size + last] -= b[k] * G[j * size + column[k]];
      G[last * size + j] = G[j * size + last];
    }
  G[last * size + last] = squares;
}

double acts_takes(const candidate_t *c, const fx_use_t *chosen, const double *fit, const double *G, int size,
                  fx_use_t *use) {
  int column[FX_SIZE_MAX];
  double b[FX_SIZE_MAX], taken = 0.0;
  for (int k = 0; k < c->n; k++) column[k] = c->first + k;
  lsq_solve_products(fit, size, column, c->n, NULL, b, NULL);
  *use = c->use;
  for (int k = 0; k < c->n; k++) {
    const double now = chosen ? fx_use_size(chosen, k) : 0.0;
    b[k] = isfinite(b[k]) ? candidate_possible(c, k, now + b[k]) - now : 0.0;
    fx_use_resize(use, k, b[k]);
  }
  for (int k = 0; k < c->n; k++) {
    taken += 2.0 * b[k] * G[column[k] * size + size - 1];
    for (int i = 0; i < c->n; i++) taken -= b[k] * b[i] * G[column[k] * size + column[i]];
  }
  return taken;
}

static bool is_likely(const candidate_t *c, const fx_use_t *use) {
  bool likely = !c->barred;
  for (int k = 0; k < c->n; k++)
    likely = likely && fabs(fx_use_size(use, k)) <= EVIDENCE_TYPICAL_MOST * c->typical[k];
  return likely;
}

static void take_out(acts_as_t *to, int i) {
  to->n--;
  for (int k = i; k < to->n; k++) to->would[k] = to->would[k + 1];
}

static void put_in(acts_as_t *to, const would_do_t *one) {
  for (int i = 0; i < to->n; i++) {
    if (to->would[i].use.fx != one->use.fx) continue;
    if (to->would[i].worth >= one->worth) return;
    take_out(to, i);
  }
  int at = to->n;
  while (at > 0 && to->would[at - 1].worth < one->worth) at--;
  if (at == ACTS_AS_MAX) return;
  if (to->n < ACTS_AS_MAX) to->n++;
  for (int k = to->n - 1; k > at; k--) to->would[k] = to->would[k - 1];
  to->would[at] = *one;
}

void acts_add(acts_as_t *to, const candidates_t *c, int candidate, const fx_use_t *use, double taken,
              double beyond) {
  const candidate_t *const one = &c->candidate[candidate];
  const double share = taken / beyond;
  const would_do_t would = {candidate, *use, fmin(share, 1.0),
                            share - CANDIDATES_MISFIT * (one->to - one->from - 1)};
  if (would.worth >= SCORE_MOST && is_likely(one, use)) put_in(to, &would);
}

void acts_keep_best(acts_as_t *to) {
  while (to->n && to->would[to->n - 1].worth < UNKNOWN_TIE * to->would[0].worth) to->n--;
}
