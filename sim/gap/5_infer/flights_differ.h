// flights_differ.h - constants by which each flight differs from the others.
//
// A battery strapped on anew, a sensor restarted or another day's wind causes them. None is named, because an
// effect of the library has one size in all flights.
#ifndef SIM_GAP_5_INFER_FLIGHTS_DIFFER_H
#define SIM_GAP_5_INFER_FLIGHTS_DIFFER_H

#include "gap/5_infer/acts_as.h"
#include "gap/5_infer/windows.h"

typedef struct {
  int n;                // flights; 0: they do not differ
  cell_t cell;          // the channel in which they differ most
  double *mean, *error; // by flight: its constant in that channel about the mean of all, and its standard
                        // error; error 0: it has no row
  acts_as_t as;         // effects that would do with another size in each flight
  fx_use_t *use;        // effect i of these in flight f: use[i * n + f]
} flights_differ_t;

// Finds the flights' constants in the cell's channel, and effects that would do. cell: of
// windows_by_flight(). residual: what is left, by channel and row. base, chosen: the model, and what is named
// beside it. FAILED: no memory. Free it, also on an error.
MUST_CHECK done_t flights_differ_make(flights_differ_t *d, set_t *s, double *const residual[CHANNELS],
                                      const model_t *base, const candidates_t *c, const chosen_t *chosen,
                                      const cell_t *cell, why_t *why);
void flights_differ_free(flights_differ_t *d);

#endif
