// height_rest.c - a vehicle at rest in free air, as the height filter sees it.
#include "rig/height_rest.h"

#include <math.h>

void height_rest_start(height_rest_t *r) {
  *r = (height_rest_t){.share = 1.0f, .down_m = 0.4f};
  params_default(&r->p);
  r->p.height.own = 1;
  r->p.height.delay_s = 0.0f;
  r->p.height.walk_mps2 = 0.1f; // fixed here, whatever the default is
  r->in = (height_in_t){.acc_b_mps2.z = GRAVITY_MPS2,
                        .q_wb = {.w = 1.0f},
                        .thrust_N = HEIGHT_REST_KG * GRAVITY_MPS2,
                        .mass_kg = HEIGHT_REST_KG,
                        .z_m = 0.4f,
                        .at = {.ratio = 1.0f},
                        .ceiling_z_m = NAN};
  height_init(&r->h);
}

void height_rest_step(height_rest_t *r) {
  height_in_t in = r->in;
  in.acc_b_mps2.z += r->k % 2 ? r->shake_mps2 : -r->shake_mps2;
  const float shake_m = r->k % 2 ? r->shake_m : -r->shake_m;
  in.down_m = r->silent || r->k % 3 ? 0.0f : r->down_m + shake_m + 1e-5f * (float)(r->k % 2);
  height_step(&r->h, &r->p.height, r->share, &in);
  r->k++;
}

void height_rest_for(height_rest_t *r, int steps) {
  for (; steps > 0; steps--) height_rest_step(r);
}

void height_rest_settle(height_rest_t *r) {
  height_rest_start(r);
  height_rest_for(r, 600);
}
