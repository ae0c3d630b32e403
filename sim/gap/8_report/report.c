// report.c - what is to be said of a study.
#include "gap/8_report/report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- what could have been seen ----------------------------------------------------------------------------

static bool rivals_a_name(const report_t *r, const fx_t *fx) {
  const model_t *const m = &r->study->diagnosis.extended;
  for (int i = 0; i < m->n_fx && fx->group != FX_ALONE; i++)
    if (m->fx[i].fx->group == fx->group) return true;
  return false;
}

// What keeps an effect from being told from these flights at all; null: nothing.
static const char *obstacle_of(const report_t *r, const fx_t *fx) {
  const diagnosis_t *const d = &r->study->diagnosis;
  const char *const obstacle = candidates_obstacle(fx, &r->study->vehicle, &d->fit);
  if (obstacle) return obstacle;
  for (int i = 0; i < d->withdrawn.n; i++)
    if (d->withdrawn.name[i].fx == fx)
      return "the fitted flights show it, and the held-out ones contradict it";
  for (int i = 0; i < d->n_refuted; i++)
    if (d->refuted[i].fx == fx)
      return d->refuted[i].too_slow
                 ? "the log is too slow: what commands did between two samples looks like it"
                 : "feedback makes it: the set points as instruments do not show it";
  if (!d->nominal_flew)
    return "the model could not be flown along these tracks: what feedback alone would show is not known";
  return NULL;
}

static void find_untested(report_t *r) {
  const diagnosis_t *const d = &r->study->diagnosis;
  for (int i = 0; i < fx_count && r->n_untested < FX_TABLE_MAX; i++) {
    untested_t u = {.fx = fx_table[i]};
    if (model_fx(&d->extended, u.fx)) continue;
    const candidate_t *c;
    int n;
    const double least = found_least(&d->found, &d->candidates, u.fx, &c);
    u.obstacle = obstacle_of(r, u.fx);
    if (!u.obstacle && !c) {
      if (rivals_a_name(r, u.fx)) continue;
      u.obstacle = "it shows in none of the residuals that can be formed from these logs";
    }
    if (!u.obstacle) {
      u.param = &fx_use_params(&c->use, &n)[u.fx->size[0].param];
      u.typical = c->typical[0];
      u.seen_from = fmax(least * u.typical, candidates_least(u.fx, &d->fit));
      u.testable = u.seen_from < u.typical;
      u.echo = d->found.echo[c - d->candidates.candidate];
    }
    r->untested[r->n_untested++] = u;
  }
}

void report_why(const untested_t *u, char text[REPORT_TEXT]) {
  if (u->obstacle)
    snprintf(text, REPORT_TEXT, "%s", u->obstacle);
  else if (u->echo)
    snprintf(text, REPORT_TEXT, "something like it is there, at one place, time or state only");
  else if (!(u->seen_from <= u->param->max))
    snprintf(text, REPORT_TEXT, "next to nothing in the residuals of these flights depends on it alone");
  else
    snprintf(text, REPORT_TEXT,
             "in these flights it would have been seen from %s %.2g%s%s on; typical is %.2g", u->param->name,
             u->seen_from, u->param->unit[0] ? " " : "", u->param->unit, u->typical);
}

const char *report_length(double m, char text[REPORT_LENGTH]) {
  if (fabs(m) < 1.0)
    snprintf(text, REPORT_LENGTH, "%.3g mm", 1e3 * m);
  else
    snprintf(text, REPORT_LENGTH, "%.3g m", m);
  return text;
}

bool report_has_residual(const report_t *r) {
  bool any = false;
  for (int ch = 0; ch < CHANNELS; ch++) any = any || r->study->diagnosis.held_out.channel[ch].used;
  return any;
}

bool report_can_tell(const report_t *r) {
  const diagnosis_t *const d = &r->study->diagnosis;
  return (d->nominal_flew || d->found.n > 0) && report_has_residual(r);
}

const char *report_headline(const report_t *r) {
  if (r->study->diagnosis.unknown) return "Something is missing that cannot be named";
  if (!report_can_tell(r)) return "These flights cannot tell what is missing";
  if (report_adequacy_of_all(r) == LEFT_MORE)
    return "Nothing can be named, and more is left than noise and feedback leave";
  return "Nothing is missing that these flights could show";
}

// --- the whole --------------------------------------------------------------------------------------------

done_t report_make(report_t *r, study_t *study, why_t *why) {
  const diagnosis_t *const d = &study->diagnosis;
  *r = (report_t){.study = study};
  r->verdict = d->found.n ? "named" : d->unknown ? "unknown" : "none";
  TRY(report_take_evidence(r, study, why));
  find_untested(r);
  for (int i = 0; i < r->n_finding; i++) r->finding[i].standing = report_standing(r, &r->finding[i]);
  TRY(report_take_fitness(r, why));
  report_warn(r);
  report_advise(r);
  return DONE;
}

void report_free(report_t *r) {
  lines_free(&r->before);
  lines_free(&r->after);
}
