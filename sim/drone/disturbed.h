// disturbed.h - what a person at a client or at the page does to a vehicle, and what its scene has happen.
#ifndef SIM_DRONE_DISTURBED_H
#define SIM_DRONE_DISTURBED_H

#include "drone/rows.h"
#include "drone/scene.h"
#include "flight/loop.h"

#define DISTURBED_NO_CEILING_M 10.0 // so high is none

typedef struct {
  double damage[FX_PARAM_MAX]; // of a motor, as the scene has it
  int happened;                // events of the scene
} disturbed_t;

// Before it is switched on: the model gets what can be switched on later. FAILED: no memory.
MUST_CHECK done_t disturbed_open(disturbed_t *d, model_t *model, why_t *why);

// When it is switched on, and before each tick: what stands in `now`, and did not in `was`.
void disturbed_begin(disturbed_t *d, flight_loop_t *loop, const desk_params_t *now);
void disturbed_follow(const disturbed_t *d, flight_loop_t *loop, const desk_params_t *now,
                      const desk_params_t *was);

// The next event of the scene that is due on_ms after it was switched on, each once; null: none is.
const event_t *disturbed_due(disturbed_t *d, const scene_t *scene, uint32_t on_ms);

#endif
