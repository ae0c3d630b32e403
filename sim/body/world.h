// world.h - a vehicle in its surroundings: plant, effects and integrator together, one tick at a time.
#ifndef SIM_BODY_WORLD_H
#define SIM_BODY_WORLD_H

#include "plant/integrate.h"
#include "plant/vertical.h"
#include "vehicle/model.h"

typedef struct {
  const model_t *model; // owned by the caller; must outlive the world
  vertical_t vehicle;
  double y[VERTICAL_N];
  integrate_t *integrate;
  int contacts; // how often the ceiling was touched
  bool broken;  // the solver gave up; the state stands still
} world_t;

// At height z_m (0: at rest on the ground) and thrust_N, not moving. step_s: of the integrator, > 0.
// BAD_INPUT: step_s out of range. FAILED: no memory. The world must not be moved in memory; close what
// was opened.
MUST_CHECK done_t world_open(world_t *w, const model_t *model, integrate_kind_t kind, double step_s,
                             double z_m, double thrust_N);

// Holds command_N (within the model's limits; returned as applied) and force_N from outside for span_s.
double world_tick(world_t *w, double command_N, double force_N, double span_s);

double world_acc_mps2(const world_t *w);      // vertical, 0 at rest on a surface
double world_ceiling_gap_m(const world_t *w); // rotor plane to ceiling; INFINITY: none
double world_thrust_ratio(const world_t *w);  // what the effects multiply the thrust by

void world_close(world_t *w);

#endif
