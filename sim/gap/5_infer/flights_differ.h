// flights_differ.h - what flights differ by, each by a constant of its own.
//
// A battery that is strapped on anew, a sensor that is started anew, another day's wind: an effect of the
// library has one size in all flights, and none is named.
#ifndef SIM_GAP_5_INFER_FLIGHTS_DIFFER_H
#define SIM_GAP_5_INFER_FLIGHTS_DIFFER_H

#include "gap/5_infer/acts_as.h"
#include "gap/5_infer/windows.h"

typedef struct {
  int n;                // flights; 0: they do not differ
  cell_t cell;          // the channel in which they differ most
  double *mean, *error; // by flight: of that channel, about the mean of all; error 0: it has no row
  acts_as_t as;         // what would do, had it another size in each flight
  fx_use_t *use;        // number i of them in flight f: use[i * n + f]
} flights_differ_t;

// cell: of windows_by_flight(). residual: what is left, by channel and row. base, chosen: the model, and
// what is named beside it. FAILED: no memory. Free it, also on an error.
MUST_CHECK done_t flights_differ_make(flights_differ_t *d, set_t *s, double *const residual[CHANNELS],
                                      const model_t *base, const candidates_t *c, const chosen_t *chosen,
                                      const cell_t *cell, why_t *why);
void flights_differ_free(flights_differ_t *d);

#endif
