// lines.h - room for one number per row of every channel of a set.
#ifndef SIM_GAP_2_PREDICT_LINES_H
#define SIM_GAP_2_PREDICT_LINES_H

#include "gap/2_predict/residual.h"
#include <stdlib.h>

typedef struct {
  double *r[CHANNELS];
} lines_t;

static inline void lines_free(lines_t *l) {
  for (int ch = 0; ch < CHANNELS; ch++) free(l->r[ch]);
  *l = (lines_t){.r = {NULL}};
}

// All zero. FAILED: no memory. Free it, also on an error.
MUST_CHECK static inline done_t lines_make(lines_t *l, const set_t *s, why_t *why) {
  bool good = true;
  for (int ch = 0; ch < CHANNELS; ch++) {
    l->r[ch] = calloc((size_t)set_rows(s, ch)->n + 1, sizeof(double));
    good = good && l->r[ch];
  }
  return good ? DONE : error_failed(why, "out of memory");
}

#endif
