// standing.c - what a named effect does, in one sentence; how sure its name is; how much of a channel is
// left.
#include "gap/8_report/report.h"

#include <math.h>
#include <string.h>

// --- what it does -----------------------------------------------------------------------------------------

// All rows of one channel of the held-out flights.
typedef struct {
  double mean, rms;
} amount_t;

static amount_t amount_of(const double *v, int n) {
  amount_t a = {0.0, 0.0};
  for (int i = 0; i < n; i++) {
    a.mean += v[i] / n;
    a.rms += v[i] * v[i] / n;
  }
  a.rms = sqrt(a.rms);
  return a;
}

// Of the number that is known worst, in parts of it; what has several may have some that are 0.
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

void report_say(finding_t *f, const double *effect, int rows) {
  const amount_t a = amount_of(effect, rows);
  const double late_s = fx_use_size(f->use, 0);
  if (f->fx->group == FX_TIMING)
    snprintf(f->says, REPORT_TEXT, "commands act %.2g +- %.1g ms %s", 1e3 * fabs(late_s),
             1e3 * f->named->stderr_[0], late_s < 0.0 ? "earlier" : "later");
  else if (a.mean * a.mean > 0.5 * a.rms * a.rms) // most of it is steady
    say_steady(f, a.mean, f->says);
  else
    snprintf(f->says, REPORT_TEXT, "%s changes by %.2g +- %.1g %s rms", gap_channel[f->profile.channel],
             a.rms, a.rms * relative_error(f), gap_unit[f->profile.channel]);
}

void report_family(const finding_t *f, const char *last, char text[REPORT_TEXT]) {
  snprintf(text, REPORT_TEXT, "%s", f->fx->name);
  for (int i = 0; i < f->named->n_rival; i++) {
    const size_t used = strlen(text);
    snprintf(text + used, REPORT_TEXT - used, "%s%s", i + 1 < f->named->n_rival ? ", " : last,
             f->named->rival[i]->name);
  }
}

// --- how sure ---------------------------------------------------------------------------------------------

const char *const standing_name[] = {"ambiguous", "likely", "strong"};

standing_t report_standing(const report_t *r, const finding_t *f) {
  const diagnosis_t *const d = &r->study->diagnosis;
  const int ch = f->profile.channel;
  const bool feedback = f->named->confirm.answer == CONFIRM_NO;
  if (f->named->n_rival || feedback) return STANDS_AMBIGUOUS;
  const bool unexplained = d->unknown && d->left.cell.channel == ch;
  const left_over_t left = report_adequacy(r, ch);
  return unexplained || left == LEFT_MORE || left == LEFT_UNKNOWN ? STANDS_LIKELY : STANDS_STRONG;
}

// --- how much is left -------------------------------------------------------------------------------------

#define LEFT_OVER 2.0 // times the floor: there is a gap, whatever could be named

const char *const left_name[] = {"not known", "quieter than the model's noise", "noise", "more than noise"};

left_over_t report_adequacy(const report_t *r, int channel) {
  const diagnosis_t *const d = &r->study->diagnosis;
  const gap_part_t *const p = &d->held_out.channel[channel];
  if (!p->used || !d->nominal_flew) return LEFT_UNKNOWN;
  if (p->after > LEFT_OVER * p->floor) return LEFT_MORE;
  return p->after < p->floor ? LEFT_QUIETER : LEFT_NOISE;
}

double report_left(const report_t *r) {
  const found_t *const f = &r->study->diagnosis.found;
  return f->left_before > 0.0 ? f->left / f->left_before : 1.0;
}

left_over_t report_adequacy_of_all(const report_t *r) {
  left_over_t worst = LEFT_UNKNOWN;
  for (int ch = 0; ch < CHANNELS; ch++) {
    const left_over_t one = report_adequacy(r, ch);
    if (one > worst) worst = one;
  }
  return worst;
}
