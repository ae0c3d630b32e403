// 8_report.c - what is to be said of a study.
#include "gap/8_report.h"

#include "gap/lsq_blocks.h"
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#define LEFT_OVER 2.0 // times the floor: there is a gap, whatever could be named

static void warn(report_t *r, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void warn(report_t *r, const char *format, ...) {
  if (r->n_warning == REPORT_WARNINGS) return;
  va_list args;
  va_start(args, format);
  vsnprintf(r->warning[r->n_warning++], REPORT_TEXT, format, args);
  va_end(args);
}

// --- what could have been seen ----------------------------------------------------------------------------

// Of the shapes of an effect the one that shows best; of its rotors the one that shows worst.
static double least_of(const diagnosis_t *d, const fx_t *fx, const candidate_t **which) {
  double least = 0.0;
  *which = NULL;
  for (int i = 0; i < d->candidates.n; i++) {
    const candidate_t *const c = &d->candidates.candidate[i];
    if (c->use.fx != fx || !(d->found.least[i] > 0.0)) continue;
    const bool worst = !fx->surface && fx->n_shape > 0 && fx_is_number(&fx->param[fx->shape_param]);
    if (*which && (worst ? d->found.least[i] < least : d->found.least[i] > least)) continue;
    least = d->found.least[i];
    *which = c;
  }
  return fmax(least, SELECT_LEAST);
}

static bool is_in_model(const report_t *r, const fx_t *fx) {
  const model_t *const m = &r->study->diagnosis.extended;
  for (int i = 0; i < m->n_fx; i++)
    if (m->fx[i].fx == fx) return true;
  return false;
}

static bool rivals_a_name(const report_t *r, const fx_t *fx) {
  const model_t *const m = &r->study->diagnosis.extended;
  for (int i = 0; i < m->n_fx && fx->class != FX_ALONE; i++)
    if (m->fx[i].fx->class == fx->class) return true;
  return false;
}

// What keeps an effect from being told from these flights at all; null: nothing.
static const char *obstacle_of(const report_t *r, const fx_t *fx) {
  const diagnosis_t *const d = &r->study->diagnosis;
  const char *const obstacle = candidates_obstacle(fx, &r->study->vehicle, &d->fit);
  if (obstacle) return obstacle;
  for (int i = 0; i < d->n_withdrawn; i++)
    if (d->withdrawn[i].fx == fx) return "the fitted flights show it, and the held-out ones contradict it";
  if (!d->nominal_flew)
    return "the model could not be flown along these tracks: what feedback alone would show is not known";
  return NULL;
}

static void find_untested(report_t *r) {
  const diagnosis_t *const d = &r->study->diagnosis;
  for (int i = 0; i < fx_count && r->n_untested < FX_TABLE_MAX; i++) {
    untested_t u = {.fx = fx_table[i]};
    if (is_in_model(r, u.fx)) continue;
    const candidate_t *c;
    int n;
    const double least = least_of(d, u.fx, &c);
    u.obstacle = obstacle_of(r, u.fx);
    if (!u.obstacle && !c) {
      if (rivals_a_name(r, u.fx)) continue;
      u.obstacle = "it shows in none of the residuals that can be formed from these logs";
    }
    if (!u.obstacle) {
      u.param = &fx_use_params(&c->use, &n)[u.fx->size[0].param];
      u.typical = candidate_typical(c, 0);
      u.seen_from = fmax(least * u.typical, u.fx->size[0].least);
      u.testable = least < 1.0;
      u.open = found_is_open(&d->found, &d->candidates, u.fx);
    }
    r->untested[r->n_untested++] = u;
  }
}

void report_why(const untested_t *u, char text[REPORT_TEXT]) {
  if (u->obstacle)
    snprintf(text, REPORT_TEXT, "%s", u->obstacle);
  else if (u->open)
    snprintf(text, REPORT_TEXT, "something like it is there, and other names explain it as well");
  else if (!isfinite(u->seen_from))
    snprintf(text, REPORT_TEXT, "nothing in the residuals of these flights depends on it");
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

// --- warnings ---------------------------------------------------------------------------------------------

static const char *base_name(const char *path) {
  const char *const slash = strrchr(path, '/');
  return slash ? slash + 1 : path;
}

static void warn_of_logs(report_t *r) {
  const study_t *const s = r->study;
  for (int i = 0; i < s->fit.n + s->held.n; i++) {
    const gap_flight_t *const f = &s->flight[i];
    for (int k = 0; k < f->n_note; k++) {
      const bool named = strncmp(f->note[k], f->name, strlen(f->name)) == 0;
      warn(r, "%s%s%s", named ? "" : base_name(f->name), named ? "" : ": ", f->note[k]);
    }
  }
}

bool report_has_residual(const report_t *r) {
  bool any = false;
  for (int ch = 0; ch < CHANNELS; ch++) any = any || r->study->diagnosis.held_out.channel[ch].used;
  return any;
}

bool report_can_tell(const report_t *r) {
  return r->study->diagnosis.nominal_flew && report_has_residual(r);
}

static void warn_of_gap(report_t *r) {
  const diagnosis_t *const d = &r->study->diagnosis;
  for (int ch = 0; ch < CHANNELS; ch++) {
    const gap_part_t *const p = &d->held_out.channel[ch];
    if (p->used && p->after > 1.05 * p->before)
      warn(r, "%s: the gap grew on the held-out flights, %.3g to %.3g %s", gap_channel[ch], p->before,
           p->after, gap_unit[ch]);
  }
  for (int ch = 0; ch < CHANNELS; ch++) {
    const gap_part_t *const p = &d->held_out.channel[ch];
    if (p->used && d->nominal_flew && p->after > LEFT_OVER * p->floor)
      warn(r,
           "%s: %.3g %s is left, where noise and feedback alone leave %.3g: more than can be named from so "
           "much flight",
           gap_channel[ch], p->after, gap_unit[ch], p->floor);
  }
}

static void warn_of_diagnosis(report_t *r) {
  const diagnosis_t *const d = &r->study->diagnosis;
  if (!report_has_residual(r))
    warn(r, "no residual can be formed: these logs have neither acceleration nor rates beside commands that "
            "explain them");
  if (d->found.n && !(d->held_out.left_after < d->held_out.left_before))
    warn(r, "the held-out flights do not confirm what is named: all channels together they are explained no "
            "better "
            "than before");
  for (int i = 0; i < d->n_withdrawn; i++) {
    const withdrawn_t *const w = &d->withdrawn[i];
    warn(r,
         "%s is withdrawn: the fitted flights show it, but it grows %s of the held-out ones, %.3g to %.3g %s",
         w->fx->name, gap_channel[w->channel], w->without, w->with, gap_unit[w->channel]);
  }
  if (!d->nominal_flew)
    warn(r, "the model could not be flown along these tracks: what feedback alone would show is not known");
  for (int ch = 0; ch < CHANNELS; ch++)
    if (d->fit.muted[ch])
      warn(r,
           "%s is left out: the logged commands say too little of it (logged more slowly than given, or "
           "motors in another order?)",
           gap_channel[ch]);
  if (d->found.aligned_s != 0.0)
    warn(r,
         "commands act %.1f ms later than the model has it: below 5 ms this is what feedback alone looks "
         "like, "
         "and it is not named",
         1e3 * d->found.aligned_s);
  const resimulation_t *const again = &r->study->resimulation;
  if (!again->flew) warn(r, "the held-out flight is not flown again: %s", again->why_not);
  if (again->lost_before || again->lost_after)
    warn(r,
         "flown again, the vehicle was put back when it was more than %.0f m off the measured track; times "
         "with the old "
         "model: %d, with the new one: %d",
         RESIMULATE_LOST_M, again->lost_before, again->lost_after);
}

static void warn_of_open(report_t *r) {
  const diagnosis_t *const d = &r->study->diagnosis;
  for (int i = 0; i < d->found.n_open; i++) {
    const named_t *const open = &d->found.open[i];
    char text[REPORT_TEXT] = "";
    for (int k = 0; k < open->n_rival; k++) {
      const size_t used = strlen(text);
      snprintf(text + used, sizeof text - used, " or %s", open->rival[k]->name);
    }
    warn(r,
         "%s%.200s is missing: these flights cannot tell which, nothing in them moves one and not the other",
         d->candidates.candidate[open->candidate].use.fx->name, text);
  }
}

// With nothing to say, what could have been said.
static void warn_of_sizes(report_t *r) {
  char text[REPORT_TEXT] = "";
  for (int i = 0; i < r->n_untested; i++) {
    const untested_t *const u = &r->untested[i];
    if (u->obstacle || !u->testable) continue;
    char one[120];
    snprintf(one, sizeof one, "%s%s %s %.2g%s%s", text[0] ? ", " : "", u->fx->name, u->param->name,
             u->seen_from, u->param->unit[0] ? " " : "", u->param->unit);
    if (strlen(text) + strlen(one) + 40 > sizeof text) {
      warn(r, "would have been seen from this size on: %s", text);
      text[0] = '\0';
      memmove(one, one + 2, strlen(one) - 1);
    }
    strcat(text, one);
  }
  if (text[0]) warn(r, "would have been seen from this size on: %s", text);
}

// --- the whole --------------------------------------------------------------------------------------------

status_t report_take_evidence(report_t *r, study_t *study, why_t *why); // 8_report_evidence.c

// The degrees of freedom are those of the selection's Wald test.
static double half_interval(const diagnosis_t *d) {
  int columns = 0;
  for (int i = 0; i < d->found.n; i++) columns += d->candidates.candidate[d->found.named[i].candidate].n;
  return lsq_t_quantile(0.025, fmax(d->fit.n_block - columns, 2.0));
}

status_t report_make(report_t *r, study_t *study, why_t *why) {
  const diagnosis_t *const d = &study->diagnosis;
  *r = (report_t){.study = study, .wide = half_interval(d)};
  r->verdict = d->found.n ? "named" : d->unknown ? "unknown" : "none";
  TRY(report_take_evidence(r, study, why));
  find_untested(r);
  warn_of_diagnosis(r);
  warn_of_gap(r);
  warn_of_open(r);
  if (d->found.n == 0) warn_of_sizes(r);
  warn_of_logs(r);
  return ST_OK;
}

void report_free(report_t *r) {
  lines_free(&r->before);
  lines_free(&r->after);
}
