// orders.h - the commands of eight bodies, as rows: internal to body/abreast.h.
#ifndef SIM_BODY_ORDERS_H
#define SIM_BODY_ORDERS_H

#include "base/lane.h"
#include "body/body.h"

#define ORDERS_DELAY                                                                                         \
  16 // ticks, a power of two; bodies with this delay or a longer one are commanded by body_command()

// Limits, commands on their way to the motors, and time: row i is motor i of all bodies.
typedef struct {
  double least_N[LANES], most_N[LANES], t_s[LANES];
  double command_N[ORDERS_DELAY][ROTORS][LANES], due_N[ROTORS][LANES];
  unsigned delay[LANES];  // ticks
  unsigned tick;          // of the next row
  unsigned queued[LANES]; // as in body_t
  unsigned ahead;         // the bodies whose body_t lags behind
} orders_t;

// True if a tick of b needs nothing but its commands: no effects at ticks, no long delay, rotors with a lag.
bool orders_suffice(const body_t *b);

// From here on, lane k belongs to b.
void orders_begin(orders_t *o, int k, const body_t *b);

// Does for all what body_command() and body_tick_begin() do. applied_N: within limits, as body_t.command_N.
void orders_take(orders_t *o, const double *command_N, double *applied_N);
// Call it after the tick of the bodies `in`.
void orders_end(orders_t *o, unsigned in, double span_s);

// Brings b's commands and time up to date.
void orders_give(orders_t *o, int k, body_t *b);

#endif
