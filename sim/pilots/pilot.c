// pilot.c - the flight code at the controls.
#include "pilots/pilot.h"

#include <string.h>

_Static_assert(RBF_N == CURVE_WEIGHTS, "logs hold all the weights");

done_t pilot_init(pilot_t *p, const flight_param_t *param, double period_s) {
  p->param = *param;
  return outer_init(&p->flight, param, (float)period_s) == ST_OK ? DONE : BAD_INPUT;
}

static void tell(const pilot_t *p, const outer_out_t *out, bool taught, thoughts_t *thoughts) {
  thoughts->y = taught ? (double)p->flight.learn.y : (double)NAN;
  thoughts->zc_m = out->zc_known ? (double)out->zc_m : (double)NAN;
  thoughts->ceiling_z_m = (double)out->ceiling_z_m;
  thoughts->ratio = (double)out->at.ratio;
  thoughts->slope_per_m = (double)out->at.slope_per_m;
  for (int i = 0; i < RBF_N; i++) {
    thoughts->weights[i] = (double)p->flight.learn.rls.theta.w[i];
    thoughts->variance[i] = (double)p->flight.learn.rls.P[i][i];
  }
}

static double step(void *state, const sense_t *in, thoughts_t *thoughts) {
  pilot_t *p = state;
  const outer_in_t flight_in = {
      .pos_w_m = {.z = (float)in->z_m},
      .vel_w_mps = {.z = (float)in->climb_mps},
      .acc_b_mps2 = {.z = (float)in->acc_mps2 + GRAVITY_MPS2},
      .q_wb = {.w = 1.0f},
      .thrust_N = (float)in->applied_N,
      .range_new = in->range_new,
      .range_m = (float)in->range_m,
      .setpoint = {.pos_w_m = {.z = (float)in->setpoint_m}},
  };
  const unsigned taught_before = p->flight.learn.rls.count;
  if (memcmp(&p->param, &p->flight.param, sizeof p->param) != 0) (void)!outer_tune(&p->flight, &p->param);
  const outer_out_t out = *outer_step(&p->flight, &flight_in);
  outer_learn(&p->flight);
  tell(p, &out, p->flight.learn.rls.count != taught_before, thoughts);
  return (double)out.thrust_N;
}

controller_t pilot_controller(pilot_t *p) {
  return (controller_t){.state = p, .period_s = (double)p->flight.coef.period_s, .step = step};
}
