// disturbed.c - what disturbs a vehicle: a person at a client or at the page, and the events of its scene.
#include "drone/disturbed.h"

#include "base/constants.h"
#include <math.h>
#include <string.h>

#define DAMAGE    "motor_damage"
#define LOWER_MPS 0.3 // of a ceiling that comes down onto the vehicle: it pushes, and does not cut
#define CLEAR_M   0.1 // farther above the vehicle the ceiling is moved at once

// Adds the wind and payload of the parameters to the scene's own.
static void push(flight_loop_t *loop, const desk_params_t *p) {
  body_push(loop_body(loop), d3(1e-3 * (double)p->windX, 1e-3 * (double)p->windY,
                                1e-3 * ((double)p->windZ - G_MPS2 * (double)p->payload)));
}

// Moves the ceiling at once down to CLEAR_M above the vehicle's highest point, which is less than CLEAR_M
// above its centre; from there on at LOWER_MPS.
static void move_ceiling(flight_loop_t *loop, double asked_m) {
  model_t *const m = loop_model(loop);
  const double wanted_m = asked_m < DISTURBED_NO_CEILING_M ? asked_m : HUGE_VAL;
  if (m->ceiling_m == wanted_m) return;
  const double clear_m = loop_body(loop)->y[RIGID_POS_M + 2] + 2.0 * CLEAR_M;
  const double slow_m = fmin(m->ceiling_m, clear_m) - LOWER_MPS * LOOP_TICK_S;
  m->ceiling_m = fmax(wanted_m, slow_m);
  body_surround(&loop_body(loop)->touch, m);
}

// Applies the damage of the parameters; while they have none, the scene's own.
static void weaken(const disturbed_t *d, flight_loop_t *loop, const desk_params_t *p) {
  model_t *const m = loop_model(loop);
  for (int i = 0; i < m->n_fx; i++) {
    fx_use_t *const use = &m->fx[i];
    if (use->fx != fx_find(DAMAGE)) continue;
    memcpy(use->p, d->damage, sizeof d->damage);
    if (p->weakMotor == 0) return;
    use->p[0] = p->weakMotor;
    use->p[1] = (double)p->weakBy;
    use->p[2] = 0.0;
  }
}

static bool changed(const void *now, const void *was, size_t size) {
  return memcmp(now, was, size) != 0;
}

void disturbed_follow(const disturbed_t *d, flight_loop_t *loop, const desk_params_t *p,
                      const desk_params_t *was) {
  move_ceiling(loop, (double)p->ceiling);
  if (changed(&p->windX, &was->windX, 3 * sizeof(float)) ||
      changed(&p->payload, &was->payload, sizeof p->payload))
    push(loop, p);
  if (p->weakMotor != was->weakMotor || changed(&p->weakBy, &was->weakBy, sizeof p->weakBy))
    weaken(d, loop, p);
  if (changed(&p->battery, &was->battery, sizeof p->battery)) loop_body(loop)->charge = (double)p->battery;
}

const event_t *disturbed_due(disturbed_t *d, const scene_t *scene, uint32_t on_ms) {
  if (d->happened == scene->n_event) return NULL;
  const event_t *const next = &scene->event[d->happened];
  if (1e3 * next->at_s > (double)on_ms) return NULL;
  d->happened++;
  return next;
}

done_t disturbed_open(disturbed_t *d, model_t *model, why_t *why) {
  const fx_t *const damage = fx_find(DAMAGE);
  if (!model_fx(model, damage)) {
    fx_use_t use = fx_use(damage);
    use.p[1] = 0.0; // the loss
    TRY(model_add_fx(model, &use, why));
  }
  memcpy(d->damage, model_fx(model, damage)->p, sizeof d->damage);
  return DONE;
}

void disturbed_begin(disturbed_t *d, flight_loop_t *loop, const desk_params_t *now) {
  d->happened = 0;
  push(loop, now);
}
