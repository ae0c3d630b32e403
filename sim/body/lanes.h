// lanes.h - eight vehicles, moved side by side by what moves one (body/forces.h, compiled for eight numbers).
//
// Numbers lie lane beside lane: number i of vehicle k is at [LANES * i + k].
#ifndef SIM_BODY_LANES_H
#define SIM_BODY_LANES_H

#include "base/lane.h"
#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define LANES_EFFECTS 16 // FX_MAX

typedef struct lanes lanes_t;

// Where the numbers of a struct of one vehicle go, in its order; the other members stand in lanes_alike_t.
typedef struct {
  double *rigid, *touch, *plant, *push_w_N;
  double *excess[LANES_EFFECTS], *load[LANES_EFFECTS]; // p of each effect
  double *y, *look;
} lanes_at_t;

// What is one and the same for all of them.
typedef struct {
  bool lag_in_speed, plain_lag, ticks, pushed, looked, loaded; // looked: `look` is of y
  int excess_of, n_excess, n_load;
  int excess[LANES_EFFECTS], load[LANES_EFFECTS]; // in fx_table
  int excess_form[LANES_EFFECTS];                 // in curve_table; -1: none
} lanes_alike_t;

// How many numbers each struct begins with for one vehicle; of touch and plant that is all.
typedef struct {
  size_t rigid, touch, plant, look;
} lanes_numbers_t;

// Null: no memory, or a struct whose numbers do not lie one behind the other.
lanes_t *lanes_open(const lanes_numbers_t *numbers);
void lanes_close(lanes_t *l);

const lanes_at_t *lanes_at(const lanes_t *l);
void lanes_set(lanes_t *l, const lanes_alike_t *alike);

// From here on the lanes `in` (a bit each) count. What of them had to leave since lanes_begin, because they
// differ too much from the others, is to be moved alone: those that are still in.
void lanes_begin(unsigned in);
unsigned lanes_left(void);

// For the integrator: dydt at state y, both RIGID_N * LANES. context: lanes_t.
void lanes_derivative(void *context, const double *y, double *dydt);

// The quaternions in `y` are brought back to unit length, and what acts there is looked at. Whether
// look.loaded.
bool lanes_end(lanes_t *l);

#ifdef __cplusplus
}
#endif

#endif
