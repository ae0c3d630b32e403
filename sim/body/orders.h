// orders.h - what eight bodies are commanded, as rows: the inside of body/abreast.h.
#ifndef SIM_BODY_ORDERS_H
#define SIM_BODY_ORDERS_H

#include "base/lane.h"
#include "body/body.h"

#define ORDERS_DELAY                                                                                         \
  16 // ticks, a power of two; who has a longer delay, or as long a one, is commanded by body_command()

// Limits, commands on their way to the motors, and time, which goes along: row i is motor i's, of all.
typedef struct {
  double least_N[LANES], most_N[LANES], t_s[LANES];
  double command_N[ORDERS_DELAY][ROTORS][LANES], due_N[ROTORS][LANES];
  unsigned delay[LANES];  // ticks
  unsigned tick;          // of the next row
  unsigned queued[LANES]; // as body_t counts it
  unsigned ahead;         // whose body_t lags behind
} orders_t;

// Whether a tick has nothing to ask of it but what is commanded: no effects at ticks, no long delay, rotors
// with a lag.
bool orders_suffice(const body_t *b);

// Lane k is that body's from here on.
void orders_begin(orders_t *o, int k, const body_t *b);

// What body_command() and body_tick_begin() do, of all; applied_N: within limits, as body_t.command_N.
void orders_take(orders_t *o, const double *command_N, double *applied_N);
// Behind the tick of those `in`.
void orders_end(orders_t *o, unsigned in, double span_s);

// What its body_t would have.
void orders_give(orders_t *o, int k, body_t *b);

#endif
