// verify.c - flights that were not fitted to, before and after.
#include "gap/7_verify/verify.h"

#include "gap/2_predict/lines.h"
#include <math.h>

static void spread(const double *v, int n, double *rms, double *sd) {
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < n; i++) {
    sum += v[i];
    squares += v[i] * v[i];
  }
  *rms = n ? sqrt(squares / n) : 0.0;
  *sd = n ? sqrt(fmax(squares / n - sum * sum / n / n, 0.0)) : 0.0;
}

done_t verify_held(set_t *s, const model_t *before, const model_t *after, const nominal_t *nominal,
                   held_t *held, why_t *why) {
  lines_t b, a = {.r = {NULL}};
  *held = (held_t){.left_before = 0.0};
  done_t status = lines_make(&b, s, why);
  if (status == DONE) status = lines_make(&a, s, why);
  if (status == DONE) status = residual_of(s, before, b.r, why);
  if (status == DONE) status = residual_of(s, after, a.r, why);
  for (int ch = 0; ch < CHANNELS && status == DONE; ch++) {
    gap_part_t *const p = &held->channel[ch];
    const rows_t *rows = set_rows(s, ch);
    const color_t color = residual_has(s, ch) ? color_fit(rows, a.r[ch]) : (color_t){.used = false};
    p->used = color.used;
    p->floor = nominal->floor[ch];
    if (!p->used) continue;
    spread(b.r[ch], rows->n, &p->before, &p->before_sd);
    spread(a.r[ch], rows->n, &p->after, &p->after_sd);
    held->left_before += color_left(rows, &color, b.r[ch]);
    held->left_after += color_left(rows, &color, a.r[ch]);
  }
  lines_free(&b);
  lines_free(&a);
  return status;
}
