// one_state.h - the 17 numbers of one vehicle's state (plant/rigid.h) as the integrator holds them: in fours,
// of which the last are the rotors' thrusts. The derivative stores them in the same groups, because a load
// that is wider than the stores before it waits until those are in memory. Header only.
#ifndef SIM_PLANT_ONE_STATE_H
#define SIM_PLANT_ONE_STATE_H

#include "base/few.h"

#define ONE_STATE 17 // how many numbers

typedef struct {
  few_t head[3], rotors;
  double between;
} one_state_t;

FEW_INLINE one_state_t one_state_of(const double *p) {
  return (one_state_t){{few_of(p), few_of(p + 4), few_of(p + 8)}, few_of(p + 13), p[12]};
}
FEW_INLINE void one_state_put(double *p, one_state_t a) {
  for (int i = 0; i < 3; i++) few_put(p + 4 * i, a.head[i]);
  p[12] = a.between;
  few_put(p + 13, a.rotors);
}
// a + k b
FEW_INLINE one_state_t one_state_plus(one_state_t a, double k, one_state_t b) {
  for (int i = 0; i < 3; i++) a.head[i] += k * b.head[i];
  a.rotors += k * b.rotors;
  a.between += k * b.between;
  return a;
}

#endif
