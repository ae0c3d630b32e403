// confirm.c - the names once more, with the reference trajectory as the instrument.
#include "gap/5_infer/confirm.h"

#include "base/lsq_blocks.h"
#include "base/lsq_instrument.h"
#include "gap/2_predict/grid.h"
#include "gap/5_infer/instrument.h"
#include <math.h>
#include <stdlib.h>

// --- what they say ----------------------------------------------------------------------------------------

static bool right_sign(const candidate_t *c, const confirm_t *a) {
  for (int k = 0; k < c->n; k++)
    if (c->use.fx->size[k].sign > 0 && a->value[k] <= 0.0) return false;
  return true;
}

static double wald_p(const double *v, const double *V, int first, int n, int all, double blocks) {
  double own[FX_SIZE_MAX * FX_SIZE_MAX];
  for (int i = 0; i < n; i++)
    for (int k = 0; k < n; k++) own[i * n + k] = V[(first + i) * all + first + k];
  return lsq_f_above(lsq_wald(v, own, n) / n, n, blocks);
}

typedef struct {
  double plain[COLUMN_MAX], b[COLUMN_MAX], F[COLUMN_MAX], blocks[COLUMN_MAX];
  double V[COLUMN_MAX * COLUMN_MAX], apart[COLUMN_MAX * COLUMN_MAX];
} fit_t;

static void answer(const candidate_t *c, const fit_t *f, int all, named_t *named) {
  confirm_t *const a = &named->confirm;
  double differ[FX_SIZE_MAX];
  bool beyond = false;
  *a = (confirm_t){.answer = CONFIRM_WEAK, .F = HUGE_VAL, .blocks = HUGE_VAL};
  for (int k = 0; k < c->n; k++) a->F = fmin(a->F, f->F[c->first + k]);
  if (!(a->F >= CONFIRM_F)) return;
  for (int k = 0; k < c->n; k++) a->blocks = fmin(a->blocks, f->blocks[c->first + k]);
  a->blocks = fmax(a->blocks, c->n + 2.0);
  const double free = a->blocks - c->n; // degrees of freedom
  for (int k = 0; k < c->n; k++) {
    const int i = c->first + k;
    a->value[k] = f->b[i];
    a->stderr_[k] = sqrt(f->V[i * (all + 1)]);
    differ[k] = f->b[i] - f->plain[i];
    // Less does not matter, however sure it is: the named error already holds it.
    beyond = beyond || fabs(differ[k]) > hypot(a->stderr_[k], named->stderr_[k]);
  }
  a->p = wald_p(a->value, f->V, c->first, c->n, all, free);
  a->p_apart = wald_p(differ, f->apart, c->first, c->n, all, free);
  a->apart = beyond && a->p_apart < SELECT_ALPHA;
  a->answer = a->p < SELECT_ALPHA && right_sign(c, a) ? CONFIRM_YES : CONFIRM_NO;
}

static done_t judge(const confirming_t *t, found_t *found, why_t *why) {
  int column[COLUMN_MAX];
  double value[COLUMN_MAX];
  gram_t g;
  const int n = t->names.columns;
  for (int i = 0; i < t->names.n; i++)
    for (int k = 0; k < t->names.candidate[i].n; k++) {
      column[t->names.candidate[i].first + k] = t->names.candidate[i].first + k;
      value[t->names.candidate[i].first + k] = *candidate_value(&t->names.candidate[i], k);
    }
  const explained_t known = {n, column, value, false};
  TRY(gram_make(&g, t->s, &t->table, &known, NULL, why));
  fit_t *const f = malloc(sizeof *f);
  const lsq_instrument_t job = {g.total, g.block, g.n_block, n, GROUPS, CONFIRM_LAGS, CONFIRM_F};
  const bool good =
      f && lsq_instrument(&job, &(lsq_instrumented_t){f->plain, f->b, f->F, f->blocks, f->V, f->apart});
  for (int i = 0; i < found->n; i++)
    for (int k = 0; k < t->names.n; k++) {
      if (t->of[k] != found->named[i].candidate) continue;
      found->named[i].confirm = (confirm_t){.answer = CONFIRM_WEAK};
      if (good) answer(&t->names.candidate[k], f, n, &found->named[i]);
    }
  const done_t status = f ? DONE : error_failed(why, "out of memory");
  free(f);
  gram_free(&g);
  return status;
}

// --- the whole --------------------------------------------------------------------------------------------

static done_t take_names(confirming_t *t, const candidates_t *c, why_t *why) {
  t->names = (candidates_t){.candidate = calloc((size_t)c->n + 1, sizeof(candidate_t))};
  if (!t->names.candidate) return error_failed(why, "out of memory");
  for (int i = 0; i < c->n && t->names.n < 2 * NAMED_MAX; i++) {
    if (!c->candidate[i].named || t->names.columns + c->candidate[i].n > COLUMN_MAX) continue;
    candidate_t *const to = &t->names.candidate[t->names.n];
    *to = c->candidate[i];
    to->first = t->names.columns;
    t->of[t->names.n++] = i;
    t->names.columns += to->n;
  }
  return candidates_model(&t->names, t->base, &t->now, why);
}

static bool all_told(const set_t *s) {
  for (int f = 0; f < s->n_grid; f++)
    if (!set_points_there(&s->grid[f])) return false;
  return s->n_grid > 0;
}

done_t select_confirm(const candidates_t *c, set_t *s, const model_t *base, const manner_t *manner,
                      found_t *found, const char **why_not, why_t *why) {
  confirming_t t = {.s = s, .base = base, .manner = manner};
  bool flew = false;
  *why_not = NULL;
  if (found->n == 0 || !all_told(s)) return DONE;
  done_t status = take_names(&t, c, why);
  if (status == DONE) status = confirm_table(&t, why);
  if (status == DONE) status = confirm_instruments(&t, &flew, why);
  if (status == DONE && flew) status = judge(&t, found, why);
  if (status == DONE && !flew) *why_not = "the model cannot be flown along the logged set points";
  table_free(&t.table);
  free(t.names.candidate);
  return status;
}
