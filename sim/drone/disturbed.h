// disturbed.h - what disturbs a vehicle: a person at a client or at the page, and the events of its scene.
#ifndef SIM_DRONE_DISTURBED_H
#define SIM_DRONE_DISTURBED_H

#include "drone/rows.h"
#include "drone/scene.h"
#include "flight/loop.h"

#define DISTURBED_NO_CEILING_M 10.0 // at this height or above there is none

typedef struct {
  double damage[FX_PARAM_MAX]; // of a motor, the scene's own
  int happened;                // events of the scene so far
} disturbed_t;

// Before switch-on: adds to the model the damage that can be switched on later. FAILED: no memory.
MUST_CHECK done_t disturbed_open(disturbed_t *d, model_t *model, why_t *why);

// At switch-on, and before each tick: apply the parameters `now`. was: those of the tick before.
void disturbed_begin(disturbed_t *d, flight_loop_t *loop, const desk_params_t *now);
void disturbed_follow(const disturbed_t *d, flight_loop_t *loop, const desk_params_t *now,
                      const desk_params_t *was);

// Returns the scene's next event that is due on_ms after switch-on, each event once; null: none is due.
const event_t *disturbed_due(disturbed_t *d, const scene_t *scene, uint32_t on_ms);

#endif
