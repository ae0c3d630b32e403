// evidence.c - where each named effect shows in the held-out flights, and how well.
#include "gap/8_report/report.h"

#include <math.h>
#include <string.h>

#define MATTERS_M 0.07 // farther from a ceiling its effect is below 5 % (thesis)

// What the effect adds to each channel, and its variance by the standard errors of its sizes.
typedef struct {
  lines_t effect, variance;
} adds_t;

static done_t add_variance(const report_t *r, set_t *held, const finding_t *f, int k, lines_t *variance,
                           why_t *why) {
  model_t m = r->study->diagnosis.extended;
  fx_use_t more = *f->use;
  lines_t left;
  more.p[f->fx->size[k].param] += f->named->stderr_[k];
  TRY(model_add_fx(&m, &more, why));
  const done_t status = residual_lines(held, &m, &left, why);
  for (int ch = 0; ch < CHANNELS && status == DONE; ch++)
    for (int i = 0; i < set_rows(held, ch)->n; i++)
      variance->r[ch][i] += pow(left.r[ch][i] - r->after.r[ch][i], 2);
  lines_free(&left);
  return status;
}

static done_t find_adds(const report_t *r, set_t *held, const finding_t *f, adds_t *adds, why_t *why) {
  model_t m = r->study->diagnosis.extended;
  model_drop_fx(&m, f->fx);
  if (f->in_file) TRY(model_add_fx(&m, f->in_file, why));
  TRY(residual_lines(held, &m, &adds->effect, why));
  TRY(lines_make(&adds->variance, held, why));
  for (int ch = 0; ch < CHANNELS; ch++)
    for (int i = 0; i < set_rows(held, ch)->n; i++) adds->effect.r[ch][i] -= r->after.r[ch][i];
  for (int k = 0; k < f->fx->n_size; k++) TRY(add_variance(r, held, f, k, &adds->variance, why));
  return DONE;
}

static int channel_of(const report_t *r, const char *wanted, double *const effect[CHANNELS]) {
  const diagnosis_t *const d = &r->study->diagnosis;
  double most = -1.0;
  int best = CH_FZ;
  for (int ch = 0; ch < CHANNELS; ch++) {
    const gap_part_t *const p = &d->held_out.channel[ch];
    if (!p->used || !(p->after > 0.0)) continue;
    if (wanted && strcmp(wanted, gap_channel[ch]) == 0) return ch;
    double sum = 0.0;
    for (int i = 0; i < set_rows(&d->held, ch)->n; i++) sum += effect[ch][i] * effect[ch][i];
    if (!(sum / (p->after * p->after) > most)) continue;
    most = sum / (p->after * p->after);
    best = ch;
  }
  return best;
}

static bool is_wanted(const fx_t *fx, int coordinate) {
  const char *const name = coordinate_name(coordinate);
  if (!fx->over[0]) return strcmp(name, "time") != 0;
  for (int k = 0; k < 2; k++)
    if (fx->over[k] && strcmp(name, fx->over[k]) == 0) return true;
  return false;
}

// Of the coordinates that an effect depends on the one that tells most of it; else time.
static void find_place(const report_t *r, finding_t *f, double *const effect[CHANNELS],
                       double *const variance[CHANNELS]) {
  const int channel = channel_of(r, f->fx->in, effect);
  profile_t *const p = &f->profile;
  double most = -1.0;
  int best = COORDINATE_TIME;
  for (int k = 0; k < COORDINATES; k++) {
    const profile_t over = {.channel = channel, .coordinate = k};
    const double told = is_wanted(f->fx, k) ? report_explained(r, &over, effect[channel]) : -1.0;
    if (!(told > most)) continue;
    most = told;
    best = k;
  }
  *p = (profile_t){.channel = channel, .coordinate = best};
  f->where = report_where(r, p, effect[channel]);
  report_profile(r, effect[channel], variance[channel], &f->where, p);
  f->matters = f->fx->surface ? (interval_t){0.0, MATTERS_M} : f->where;
  f->before = report_rms(r, p, &f->matters, r->before.r[channel]);
  f->after = report_rms(r, p, &f->matters, r->after.r[channel]);
}

void report_apart(const fx_t *fx, const fx_t *rival, char text[REPORT_TEXT]) {
  const char *const both = fx_apart(fx, rival);
  const bool same = both || strcmp(fx->fly, rival->fly) == 0;
  snprintf(text, REPORT_TEXT, "%s%s%s", both ? both : fx->fly, same ? "" : "; then ", same ? "" : rival->fly);
}

static done_t find_one(report_t *r, set_t *held, finding_t *f, why_t *why) {
  const diagnosis_t *const d = &r->study->diagnosis;
  f->fx = found_use(&d->found, f->named)->fx;
  f->use = model_fx(&d->extended, f->fx);
  f->in_file = model_fx(&r->study->vehicle, f->fx);
  report_take_numbers(f);
  adds_t adds = {.effect = {{NULL}}};
  const done_t status = find_adds(r, held, f, &adds, why);
  if (status == DONE) find_place(r, f, adds.effect.r, adds.variance.r);
  if (status == DONE) report_say(f, adds.effect.r[f->profile.channel], set_rows(held, f->profile.channel)->n);
  lines_free(&adds.effect);
  lines_free(&adds.variance);
  report_apart(f->fx, f->named->n_rival ? f->named->rival[0] : f->fx, f->fly);
  f->standing = report_standing(r, f);
  return status;
}

static void order_by_share(report_t *r, const found_t *found) {
  for (int i = 0; i < found->n; i++) {
    int at = i;
    for (; at > 0 && r->finding[at - 1].named->share < found->named[i].share; at--)
      r->finding[at].named = r->finding[at - 1].named;
    r->finding[at].named = &found->named[i];
  }
}

done_t report_take_evidence(report_t *r, study_t *study, why_t *why) {
  diagnosis_t *const d = &study->diagnosis;
  TRY(residual_lines(&d->held, &study->vehicle, &r->before, why));
  TRY(residual_lines(&d->held, &d->extended, &r->after, why));
  r->n_finding = d->found.n;
  order_by_share(r, &d->found);
  for (int i = 0; i < r->n_finding; i++) TRY(find_one(r, &d->held, &r->finding[i], why));
  r->left = (profile_t){.channel = d->left.cell.channel, .coordinate = d->left.cell.along};
  if (d->left.cell.statistic > 0.0 && d->left.cell.along != NOWHERE)
    report_profile(r, NULL, NULL, NULL, &r->left);
  return DONE;
}
