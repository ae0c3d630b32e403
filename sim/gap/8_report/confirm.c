// confirm.c - what the reference as the instrument says of a name, in words.
#include "gap/8_report/report.h"

#include "gap/5_infer/confirm.h"
#include <string.h>

const char *const report_feedback[] = {"", "instrument too weak", "may be made by feedback",
                                       "not made by feedback"};

static void add_values(const finding_t *f, char text[REPORT_TEXT]) {
  const confirm_t *const a = &f->named->confirm;
  int n;
  const fx_param_t *const param = fx_use_params(f->use, &n);
  for (int k = 0; k < f->fx->n_size; k++) {
    const fx_param_t *const p = &param[f->fx->size[k].param];
    const size_t used = strlen(text);
    snprintf(text + used, REPORT_TEXT - used, "%s%s %.3g +- %.2g%s%s", k ? ", " : " ", p->name,
             a->value[k] + (f->in_file ? fx_use_size(f->in_file, k) : 0.0), a->stderr_[k],
             p->unit[0] ? " " : "", p->unit);
  }
}

bool report_confirm(const finding_t *f, char text[REPORT_TEXT]) {
  const confirm_t *const a = &f->named->confirm;
  if (a->answer == CONFIRM_NOT_TRIED) return false;
  if (a->answer == CONFIRM_WEAK) {
    snprintf(text, REPORT_TEXT,
             "instrument too weak: the set points explain too little of it (first-stage F %.2g, needed %.0f)",
             a->F, CONFIRM_F);
    return true;
  }
  snprintf(text, REPORT_TEXT, "%s, by the set points as instrument:", report_feedback[a->answer]);
  add_values(f, text);
  size_t used = strlen(text);
  snprintf(text + used, REPORT_TEXT - used, " (first-stage F %.3g)", a->F);
  used = strlen(text);
  if (a->apart)
    snprintf(text + used, REPORT_TEXT - used, "; apart from least squares by more than both errors, p %.1g",
             a->p_apart);
  return true;
}
