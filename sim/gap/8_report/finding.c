// finding.c - what the report says of a named effect: its numbers, what it does, how sure it is.
#include "gap/8_report/report.h"

#include "gap/5_infer/confirm.h"
#include <math.h>

// --- its numbers ------------------------------------------------------------------------------------------

static void take_size(finding_t *f, const fx_param_t *param, int k) {
  const double in_file = f->in_file ? fx_use_size(f->in_file, k) : (double)NAN;
  const bool shown = f->named->stderr_[k] > 0.0;
  f->number[f->n_number++] = (number_t){
      .param = &param[f->fx->size[k].param],
      .value = shown ? fx_use_size(f->use, k) : (double)NAN,
      .stderr_ = shown ? f->named->stderr_[k] : (double)NAN,
      .in_file = in_file,
      .by_instrument = f->named->confirm.value[k] + (f->in_file ? in_file : 0.0),
  };
}

// Adds the shape or the kind. none: why it has no standard error; null: it has one.
static void take_other(finding_t *f, const fx_param_t *param, int which, double error, const char *none) {
  f->number[f->n_number++] = (number_t){.param = &param[which],
                                        .value = f->use->p[which],
                                        .stderr_ = none ? (double)NAN : error,
                                        .no_stderr = none,
                                        .in_file = (double)NAN};
}

static void take_numbers(finding_t *f) {
  const double error = f->named->shape_stderr;
  int n;
  const fx_param_t *const param = fx_use_params(f->use, &n);
  for (int k = f->from; k < f->to; k++) take_size(f, param, k);
  if (fx_use_has_shape(f->use))
    take_other(f, param, f->fx->shape_param, error,
               error > 0.0    ? NULL
               : isnan(error) ? "not known"
                              : "the best of those tried");
  if (f->fx->n_kind && f->from == 0)
    take_other(f, param, fx_use_kind(f->use), 0.0, "the better of those tried");
}

const char *const report_feedback[] = {"", "instrument too weak", "may be made by feedback",
                                       "not made by feedback"};

static void say_instrument(finding_t *f) {
  const confirm_t *const a = &f->named->confirm;
  char *const text = f->instrument;
  if (a->answer == CONFIRM_NOT_TRIED) return;
  text_add(text, REPORT_TEXT, "%s", report_feedback[a->answer]);
  if (a->answer == CONFIRM_WEAK) {
    text_add(text, REPORT_TEXT, ": the set points explain too little of it (first-stage F %.2g, needed %.0f)",
             a->F, CONFIRM_F);
    return;
  }
  text_add(text, REPORT_TEXT, ", by the set points as instrument:");
  for (int k = f->from, told = 0; k < f->to; k++) {
    const number_t *const number = &f->number[k - f->from];
    const fx_param_t *const p = number->param;
    if (!(a->stderr_[k] > 0.0)) continue;
    text_add(text, REPORT_TEXT, "%s%s %.3g +- %.2g%s%s", told++ ? ", " : " ", p->name, number->by_instrument,
             a->stderr_[k], text_gap(p->unit), p->unit);
  }
  text_add(text, REPORT_TEXT, " (first-stage F %.3g)", a->F);
  if (a->apart)
    text_add(text, REPORT_TEXT, "; apart from least squares by more than both errors, p %.1g", a->p_apart);
}

// --- what it does -----------------------------------------------------------------------------------------

// Returns the relative standard error of the effect's largest size; others may be 0.
static double relative_error(const finding_t *f) {
  double value = 0.0, error = 0.0;
  for (int k = 0; k < f->fx->n_size; k++) {
    if (fabs(f->named->value[k]) < value) continue;
    value = fabs(f->named->value[k]);
    error = f->named->stderr_[k];
  }
  return value > 0.0 ? error / value : 0.0;
}

static void say_steady(const finding_t *f, double mean, char text[REPORT_TEXT]) {
  const int ch = f->profile.channel;
  const double size = fabs(mean), error = size * relative_error(f);
  const char *const way = mean < 0.0 ? "backwards" : "forwards", *const side = mean < 0.0 ? "right" : "left";
  if (ch == CH_FZ)
    snprintf(text, REPORT_TEXT, "lift is %s by %.2g +- %.1g m/s2, %.2g %% of g",
             mean < 0.0 ? "short" : "over", size, error, 100.0 * size / G_MPS2);
  else if (ch < CH_FORCES)
    snprintf(text, REPORT_TEXT, "a steady push of %.2g +- %.1g m/s2 %s%s", size, error, ch ? "to the " : "",
             ch ? side : way);
  else if (ch < CH_SMOOTH)
    snprintf(text, REPORT_TEXT, "a steady turning of %.2g +- %.1g rad/s2 about %c", mean, error,
             "xyz"[ch - CH_FORCES]);
  else
    snprintf(text, REPORT_TEXT, "the range is %.2g +- %.1g m too %s", size, error,
             mean < 0.0 ? "short" : "long");
}

static void say_what(finding_t *f, const double *effect, int rows) {
  double mean = 0.0, rms = 0.0;
  for (int i = 0; i < rows; i++) {
    mean += effect[i] / rows;
    rms += effect[i] * effect[i] / rows;
  }
  rms = sqrt(rms);
  const double late_s = fx_use_size(f->use, 0);
  if (f->fx->group == FX_TIMING)
    snprintf(f->says, REPORT_TEXT, "commands act %.3g +- %.2g ms %s", 1e3 * fabs(late_s),
             1e3 * f->named->stderr_[0], late_s < 0.0 ? "earlier" : "later");
  else if (mean * mean > 0.5 * rms * rms) // most of it is steady
    say_steady(f, mean, f->says);
  else
    snprintf(f->says, REPORT_TEXT, "%s changes by %.2g +- %.1g %s rms", gap_channel[f->profile.channel], rms,
             rms * relative_error(f), gap_unit[f->profile.channel]);
}

// --- how sure ---------------------------------------------------------------------------------------------

const char *const standing_name[] = {"ambiguous", "likely", "strong"};

// A strong name is as probable: of those that were stated so, as many were right (test/README.md).
#define STRONG 0.95

standing_t report_standing(const report_t *r, const finding_t *f) {
  const diagnosis_t *const d = &r->study->diagnosis;
  const int ch = f->profile.channel;
  const bool feedback = f->named->confirm.answer == CONFIRM_NO;
  if (f->named->n_rival || feedback) return STANDS_AMBIGUOUS;
  const bool unexplained = d->unknown && d->left.cell.channel == ch;
  const left_over_t left = report_adequacy(r, ch);
  const bool borne_out = isnan(f->named->held_share) || f->named->held_share > 0.5;
  const bool doubted = unexplained || left == LEFT_MORE || left == LEFT_UNKNOWN || report_contradicted(r) ||
                       !borne_out || f->named->probability < STRONG;
  return doubted ? STANDS_LIKELY : STANDS_STRONG;
}

// --- the whole --------------------------------------------------------------------------------------------

void report_describe(const report_t *r, finding_t *f, const double *effect, int rows) {
  take_numbers(f);
  text_add(f->family, REPORT_TEXT, "%s", f->name);
  for (int i = 0; i < f->named->n_rival; i++)
    text_add(f->family, REPORT_TEXT, "%s%s", i + 1 < f->named->n_rival ? ", " : " or ",
             f->named->rival[i]->name);
  say_instrument(f);
  say_what(f, effect, rows);
  report_apart(f->fx, f->named->n_rival ? f->named->rival[0] : f->fx, f->fly);
  f->standing = report_standing(r, f);
}
