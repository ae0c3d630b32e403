// lines.h - room for one number per row of every channel of a set, and for one flight point by point.
#ifndef SIM_GAP_2_PREDICT_LINES_H
#define SIM_GAP_2_PREDICT_LINES_H

#include "gap/2_predict/set.h"
#include <stdlib.h>
#include <string.h>

typedef struct {
  double *r[CHANNELS];
} lines_t;

static inline void lines_free(lines_t *l) {
  for (int ch = 0; ch < CHANNELS; ch++) free(l->r[ch]);
  *l = (lines_t){.r = {NULL}};
}

// Makes lines of zeros. FAILED: no memory. Free them, also on an error.
MUST_CHECK static inline done_t lines_make(lines_t *l, const set_t *s, why_t *why) {
  bool good = true;
  for (int ch = 0; ch < CHANNELS; ch++) {
    l->r[ch] = calloc((size_t)set_rows(s, ch)->n + 1, sizeof(double));
    good = good && l->r[ch];
  }
  return good ? DONE : error_failed(why, "out of memory");
}

// Room for the replay of any one flight: two series of each channel, and the scratch of residual_rows().
typedef struct {
  double *base[CHANNELS], *with[CHANNELS], *scratch, *room;
} flight_lines_t;

static inline bool flight_lines_make(flight_lines_t *l, const set_t *s) {
  size_t most = 1;
  for (int f = 0; f < s->n_grid; f++) most = s->grid[f].n > (int)most ? (size_t)s->grid[f].n : most;
  l->room = malloc((2 * CHANNELS + RESIDUAL_SCRATCH) * most * sizeof(double));
  for (size_t c = 0; c < CHANNELS && l->room; c++) {
    l->base[c] = l->room + c * most;
    l->with[c] = l->room + (CHANNELS + c) * most;
  }
  l->scratch = l->room ? l->room + 2 * CHANNELS * most : NULL;
  if (l->room) memset(l->scratch, 0, RESIDUAL_SCRATCH * most * sizeof(double));
  return l->room != NULL;
}

// For one of several threads: all but `base` is its own.
static inline bool flight_lines_beside(flight_lines_t *l, const set_t *s, const flight_lines_t *other) {
  const bool good = flight_lines_make(l, s);
  for (int c = 0; c < CHANNELS && good; c++) l->base[c] = other->base[c];
  return good;
}

#endif
