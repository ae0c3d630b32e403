// stirs.h - how a residual comes and goes within a flight: what disturbs a vehicle, as opposed to what
// stands, begins or passes.
#ifndef SIM_GAP_3_FEEDBACK_STIRS_H
#define SIM_GAP_3_FEEDBACK_STIRS_H

#include "gap/2_predict/residual.h"

enum {
  STIRS_LAGS = (int)RESIDUAL_HZ + 1, // rows: up to a second
  STIRS_SLOW = 2                     // rows: at smaller lags the filter correlates them
};

// Of a channel, over the quieter half of its stretches of 4 s, each about its mean.
typedef struct {
  double lag[STIRS_LAGS]; // sums of products of rows that far apart, over the number of all rows
  double share;           // of the rows that count
  double changes;         // half the mean square of the changes from row to row
  double level;           // mean square of the stretches' means about each other, by the median change
} stirs_t;

// Returns the mean square of what comes and goes, or stands for longer than a stretch and changes all the
// same.
static inline double stirs_all(const stirs_t *s) {
  return (s->share > 0.0 ? s->lag[0] / s->share : 0.0) + s->level;
}
// Returns the same of products of rows STIRS_SLOW apart.
static inline double stirs_lasting(const stirs_t *s) {
  return (s->share > 0.0 ? s->lag[STIRS_SLOW] / s->share : 0.0) + s->level;
}

// Adds those of a channel's rows (smooth ones). A moment or force that begins in a flight, and stays, is in
// two changes of many, and in one stretch of many, and does not count. The quieter half has less than all
// rows, of noise, too: compare it with the same of other flights. FAILED: no memory.
MUST_CHECK done_t stirs_add(stirs_t *sum, const set_t *s, const double *v, why_t *why);

#endif
