// both_ways.c - measured by predicted, and predicted by measured.
#include "gap/5_infer/both_ways.h"

#include <math.h>
#include <stdlib.h>

// Rows of all channels: what was measured, and what a model leaves.
typedef struct {
  double *measured[CHANNELS], *left[CHANNELS], *room;
} rows_of_both_t;

static bool open_rows(rows_of_both_t *r, const set_t *s) {
  size_t n = 0;
  for (int ch = 0; ch < CHANNELS; ch++) n += (size_t)set_rows(s, ch)->n + 1;
  double *next = r->room = calloc(2 * n, sizeof *r->room);
  for (int ch = 0; next && ch < CHANNELS; ch++) {
    r->measured[ch] = next;
    r->left[ch] = next + n;
    next += set_rows(s, ch)->n + 1;
  }
  return next != NULL;
}

double both_ways_agree(const increments_t *i, double k, double stderr_) {
  if (!(k > 0.0 && i->yp > 0.0)) return 0.0;
  const double forward = i->pp / i->yp - 1.0, reverse = i->yp / i->yy - 1.0;
  const double error = hypot(stderr_, 0.5 * (forward - reverse));
  return reverse > SCORE_ERRORS * error && k > reverse - SCORE_ERRORS * error ? reverse : 0.0;
}

// What missed commands make of it in nominal flights is no error of its own here: the interval holds it.
static double regression_error(const named_t *named, int k) {
  const double all = named->stderr_[k], beside = named->beside[k];
  return sqrt(fmax(all * all - beside * beside, 0.0));
}

done_t both_ways(set_t *s, const model_t *base, const chosen_t *chosen, const named_t *named, bool *stands,
                 why_t *why) {
  chosen_t others = *chosen;
  chosen_drop(&others, named->candidate);
  model_t m;
  TRY(chosen_model(&others, base, &m, why));
  rows_of_both_t r;
  if (!open_rows(&r, s)) return error_failed(why, "out of memory");
  done_t status = residual_measured(s, r.measured, why);
  if (status == DONE) status = residual_of(s, &m, r.left, why);
  *stands = false;
  for (int k = 0; k < 3 && status == DONE; k++) {
    const int ch = CH_WX + k;
    if (!residual_has(s, ch) || s->excluded[ch]) continue;
    const increments_t i = increments_of(set_rows(s, ch), r.measured[ch], r.left[ch]);
    *stands = *stands || both_ways_agree(&i, named->value[k], regression_error(named, k)) != 0.0;
  }
  free(r.room);
  return status;
}
