// numbers.c - the numbers of a name, and what the reference as the instrument says of them.
#include "gap/8_report/report.h"

#include "base/text.h"
#include "gap/5_infer/confirm.h"
#include <math.h>

const char *const report_feedback[] = {"", "instrument too weak", "may be made by feedback",
                                       "not made by feedback"};

static void take_size(finding_t *f, const fx_param_t *param, int k) {
  const double in_file = f->in_file ? fx_use_size(f->in_file, k) : (double)NAN;
  f->number[f->n_number++] = (number_t){
      .param = &param[f->fx->size[k].param],
      .value = fx_use_size(f->use, k),
      .stderr_ = f->named->stderr_[k],
      .in_file = in_file,
      .by_instrument = f->named->confirm.value[k] + (f->in_file ? in_file : 0.0),
  };
}

// A number that was tried at a few values; null: it has a standard error.
static void take_other(finding_t *f, const fx_param_t *param, int which, double error, const char *none) {
  f->number[f->n_number++] = (number_t){.param = &param[which],
                                        .value = f->use->p[which],
                                        .stderr_ = none ? (double)NAN : error,
                                        .no_stderr = none,
                                        .in_file = (double)NAN};
}

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
  for (int k = 0; k < f->fx->n_size; k++) {
    const fx_param_t *const p = f->number[k].param;
    text_add(text, REPORT_TEXT, "%s%s %.3g +- %.2g%s%s", k ? ", " : " ", p->name, f->number[k].by_instrument,
             a->stderr_[k], text_gap(p->unit), p->unit);
  }
  text_add(text, REPORT_TEXT, " (first-stage F %.3g)", a->F);
  if (a->apart)
    text_add(text, REPORT_TEXT, "; apart from least squares by more than both errors, p %.1g", a->p_apart);
}

void report_take_numbers(finding_t *f) {
  const double error = f->named->shape_stderr;
  int n;
  const fx_param_t *const param = fx_use_params(f->use, &n);
  for (int k = 0; k < f->fx->n_size; k++) take_size(f, param, k);
  if (fx_use_has_shape(f->use))
    take_other(f, param, f->fx->shape_param, error,
               error > 0.0    ? NULL
               : isnan(error) ? "not known"
                              : "the best of those tried");
  if (f->fx->n_kind) take_other(f, param, fx_use_kind(f->use), 0.0, "the better of those tried");
  text_add(f->family, REPORT_TEXT, "%s", f->fx->name);
  for (int i = 0; i < f->named->n_rival; i++)
    text_add(f->family, REPORT_TEXT, "%s%s", i + 1 < f->named->n_rival ? ", " : " or ",
             f->named->rival[i]->name);
  say_instrument(f);
}
