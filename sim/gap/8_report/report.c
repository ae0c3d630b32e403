// report.c - gathers what the report says of a study.
#include "gap/8_report/report.h"

#include "base/folder.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- what could have been seen ----------------------------------------------------------------------------

static bool rivals_a_name(const report_t *r, const fx_t *fx) {
  const found_t *const found = &r->study->diagnosis.found;
  for (int i = 0; i < found->n && fx->group != FX_ALONE; i++)
    if (found_use(found, &found->named[i])->fx->group == fx->group) return true;
  return false;
}

// Returns why these flights cannot tell whether an effect is there; null if they can.
static const char *obstacle_of(const report_t *r, const fx_t *fx) {
  static const char *const obstacle[] = {
      [MADE_BY_FEEDBACK] = "feedback makes it: the set points as instruments do not show it",
      [MADE_BY_MISSED_COMMANDS] = "the log is too slow: what commands did between two samples looks like it",
      [MADE_BY_NOISE] = "noise that is fed back, or a disturbance, may look like it",
      [MADE_BY_CONTROL] = "control that answers a disturbance may make as much of it"};
  const diagnosis_t *const d = &r->study->diagnosis;
  const char *const lacks = candidates_obstacle(fx, &r->study->vehicle, &d->fit);
  if (lacks) return lacks;
  for (int i = 0; i < d->withdrawn.n; i++)
    if (d->withdrawn.name[i].fx == fx)
      return "the fitted flights show it, and the held-out ones contradict it";
  for (int i = 0; i < d->n_refuted; i++)
    if (d->refuted[i].fx == fx ||
        (d->refuted[i].by == MADE_BY_CONTROL && candidates_alike(d->refuted[i].fx, fx)))
      return obstacle[d->refuted[i].by];
  if (!d->nominal_flew)
    return "the model could not be flown along these tracks: what feedback alone would show is not known";
  return NULL;
}

// Adds an effect that was looked for to `shown` if its typical size would have been seen, else to `untested`.
// least: the smallest size that would have been seen, over the typical size.
static void take_looked_for(report_t *r, const fx_t *fx, const candidate_t *c, double least) {
  const diagnosis_t *const d = &r->study->diagnosis;
  int n;
  const fx_param_t *const size = &fx_use_params(&c->use, &n)[fx->size[c->from].param];
  const double typical = c->typical[c->from], from = fmax(least * typical, candidates_least(fx, &d->fit));
  if (from < typical) {
    r->shown[r->n_shown++] = (shown_t){fx, size, from, model_fx(&r->study->vehicle, fx) != NULL};
    return;
  }
  untested_t *const u = &r->untested[r->n_untested++];
  *u = (untested_t){.fx = fx, .flyable = true};
  if (d->found.echo[c - d->candidates.candidate])
    text_add(u->why, REPORT_TEXT, "something like it is there, at one place or time only");
  else if (!(from <= size->max))
    text_add(u->why, REPORT_TEXT, "next to nothing in the residuals of these flights depends on it alone");
  else
    text_add(u->why, REPORT_TEXT,
             "in these flights it would have been seen from %s %.2g%s%s on; typical is %.2g", size->name,
             from, text_gap(size->unit), size->unit, typical);
}

static bool is_named(const diagnosis_t *d, const fx_t *fx) {
  for (int i = 0; i < d->found.n; i++)
    if (found_use(&d->found, &d->found.named[i])->fx == fx) return true;
  return false;
}

// Sorts all other effects. More or less of those in the vehicle file can be looked for, too.
static void take_others(report_t *r) {
  const diagnosis_t *const d = &r->study->diagnosis;
  for (int i = 0; i < fx_count && i < FX_MAX; i++) {
    const fx_t *const fx = fx_table[i];
    if (is_named(d, fx)) continue;
    const candidate_t *c;
    const double least = found_least(&d->found, &d->candidates, fx, &c);
    const char *obstacle = obstacle_of(r, fx);
    if (!obstacle && !c && rivals_a_name(r, fx)) continue;
    if (!obstacle && !c)
      obstacle = model_fx(&r->study->vehicle, fx)
                     ? "the vehicle file has it, and no other number of it is looked for in these logs"
                 : report_turning_missed(r) && residual_has(&d->fit, CH_FZ)
                     ? "it shows in none of the residuals, because rows miss commands: log faster"
                     : "it shows in none of the residuals that can be formed from these logs";
    if (!obstacle) {
      take_looked_for(r, fx, c, least);
      continue;
    }
    untested_t *const u = &r->untested[r->n_untested++];
    *u = (untested_t){.fx = fx};
    text_add(u->why, REPORT_TEXT, "%s", obstacle);
  }
}

// --- what several outputs say -----------------------------------------------------------------------------

const char *report_log_name(const report_t *r, const gap_flight_t *log) {
  const study_t *const s = r->study;
  const char *const own = folder_file(log->name);
  for (int i = 0; i < s->fit.n + s->held.n; i++)
    if (strcmp(s->flight[i].name, log->name) != 0 && strcmp(folder_file(s->flight[i].name), own) == 0)
      return log->name;
  return own;
}

void report_apart(const fx_t *fx, const fx_t *rival, char text[REPORT_TEXT]) {
  const char *const both = fx_apart(fx, rival);
  const bool same = both || strcmp(fx->fly, rival->fly) == 0;
  snprintf(text, REPORT_TEXT, "%s%s%s", both ? both : fx->fly, same ? "" : "; then ", same ? "" : rival->fly);
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

bool report_turning_missed(const report_t *r) {
  const diagnosis_t *const d = &r->study->diagnosis;
  bool out = false, missed = false;
  for (int ch = CH_WX; ch <= CH_WZ; ch++) out = out || d->fit.excluded[ch];
  for (int f = 0; f < d->fit.n_grid; f++) missed = missed || grid_misses_commands(&d->fit.grid[f]);
  return out && missed;
}

bool report_can_tell(const report_t *r) {
  const diagnosis_t *const d = &r->study->diagnosis;
  return (d->nominal_flew || d->found.n > 0) && report_has_residual(r);
}

void report_headline(const report_t *r, const char *vehicle, FILE *out) {
  const char *const in = vehicle ? " in " : "", *const what = vehicle ? vehicle : "";
  if (r->study->diagnosis.unknown)
    fprintf(out, "Something is missing%s%s that cannot be named", in, what);
  else if (!report_can_tell(r))
    fprintf(out, "These flights cannot tell what is missing%s%s", in, what);
  else if (report_adequacy_of_all(r) == LEFT_MORE)
    fprintf(out,
            "Nothing can be named that is missing%s%s, and more is left than noise and feedback leave (see "
            "the notes)",
            in, what);
  else
    fprintf(out, "Nothing is missing%s%s that these flights could show", in, what);
}

// --- how much is left -------------------------------------------------------------------------------------

const char *const left_name[] = {"not known", "quieter than the model's noise", "noise", "more than noise"};

left_over_t report_adequacy(const report_t *r, int channel) {
  const diagnosis_t *const d = &r->study->diagnosis;
  const gap_part_t *const p = &d->held_out.channel[channel];
  if (!p->used || !d->nominal_flew) return LEFT_UNKNOWN;
  if (p->after > LEFT_OVER * p->floor || p->jumps > LEFT_JUMPS) return LEFT_MORE;
  return p->after < p->floor ? LEFT_QUIETER : LEFT_NOISE;
}

double report_left(const report_t *r) {
  const found_t *const f = &r->study->diagnosis.found;
  return f->left_before > 0.0 ? f->left / f->left_before : 1.0;
}

bool report_contradicted(const report_t *r) {
  const diagnosis_t *const d = &r->study->diagnosis;
  return d->found.n && !(d->held_out.left_after < d->held_out.left_before);
}

left_over_t report_adequacy_of_all(const report_t *r) {
  left_over_t worst = LEFT_UNKNOWN;
  for (int ch = 0; ch < CHANNELS; ch++) {
    const left_over_t one = report_adequacy(r, ch);
    if (one > worst) worst = one;
  }
  return worst;
}

// --- the whole --------------------------------------------------------------------------------------------

done_t report_make(report_t *r, study_t *study, why_t *why) {
  const diagnosis_t *const d = &study->diagnosis;
  *r = (report_t){.study = study, .verdict = d->found.n ? "named" : d->unknown ? "unknown" : "none"};
  TRY(report_take_evidence(r, study, why));
  take_others(r);
  TRY(report_take_fitness(r, why));
  report_warn(r);
  report_advise(r);
  return DONE;
}

void report_free(report_t *r) {
  lines_free(&r->before);
  lines_free(&r->after);
  free(r->own);
  r->own = NULL;
}
