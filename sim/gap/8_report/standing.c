// standing.c - what a named effect does, in one sentence; how sure its name is; how much of a channel is
// left.
#include "gap/8_report/report.h"

#include <math.h>

// --- what it does -----------------------------------------------------------------------------------------

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
  double mean = 0.0, rms = 0.0;
  for (int i = 0; i < rows; i++) {
    mean += effect[i] / rows;
    rms += effect[i] * effect[i] / rows;
  }
  rms = sqrt(rms);
  const double late_s = fx_use_size(f->use, 0);
  if (f->fx->group == FX_TIMING)
    snprintf(f->says, REPORT_TEXT, "commands act %.2g +- %.1g ms %s", 1e3 * fabs(late_s),
             1e3 * f->named->stderr_[0], late_s < 0.0 ? "earlier" : "later");
  else if (mean * mean > 0.5 * rms * rms) // most of it is steady
    say_steady(f, mean, f->says);
  else
    snprintf(f->says, REPORT_TEXT, "%s changes by %.2g +- %.1g %s rms", gap_channel[f->profile.channel], rms,
             rms * relative_error(f), gap_unit[f->profile.channel]);
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
