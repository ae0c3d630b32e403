// pilot_outer.c - the outer loop alone as a pilot.
#include "pilots/pilot_outer.h"

#include "base/constants.h"

_Static_assert(RBF_N == CURVE_WEIGHTS, "logs hold all the weights");

void pilot_outer_tell(const outer_t *flight, thoughts_t *thoughts) {
  const outer_out_t *out = &flight->out;
  thoughts->zc_m = out->zc_known ? (double)out->zc_m : (double)NAN;
  thoughts->ceiling_z_m = (double)out->ceiling_z_m;
  thoughts->ratio = (double)out->at.ratio;
  thoughts->slope_per_m = (double)out->at.slope_per_m;
  for (int i = 0; i < RBF_N; i++) {
    thoughts->weights[i] = (double)flight->learn.rls.theta.w[i];
    thoughts->variance[i] = (double)flight->learn.rls.P[i][i];
  }
}

static void tell(const void *state, thoughts_t *thoughts) {
  const pilot_outer_t *p = state;
  pilot_outer_tell(&p->flight, thoughts);
  if (p->learned) thoughts->y = (double)p->flight.learn.y;
}

static void step(void *state, const pilot_in_t *in, double motor_N[PILOT_MOTORS]) {
  pilot_outer_t *p = state;
  double applied_N = 0.0;
  for (int i = 0; i < PILOT_MOTORS; i++) applied_N += in->applied_N[i];
  const outer_in_t flight_in = {
      .pos_w_m = {.z = (float)in->pos_w_m.z},
      .vel_w_mps = {.z = (float)in->vel_w_mps.z},
      // The outer loop takes off 9.81 as a float: that float is put back here, so that at rest 0 is left.
      .acc_b_mps2 = {.z = (float)(in->acc_b_mps2.z - G_MPS2) + GRAVITY_MPS2},
      .q_wb = {.w = 1.0f},
      .thrust_N = (float)applied_N,
      .range_new = in->range_new,
      .range_m = (float)in->range_m,
      .setpoint = {.pos_w_m = {.z = (float)in->set.pos_w_m.z}},
  };
  const unsigned before = p->flight.learn.rls.count;
  const double thrust_N = (double)outer_step(&p->flight, &flight_in)->thrust_N;
  outer_learn(&p->flight);
  p->learned = p->flight.learn.rls.count != before;
  for (int i = 0; i < PILOT_MOTORS; i++) motor_N[i] = thrust_N / PILOT_MOTORS;
}

static void reset(void *state) {
  pilot_outer_t *p = state;
  const flight_param_t param = p->flight.param;
  (void)!outer_init(&p->flight, &param, (float)p->flight.coef.period_s);
}

done_t pilot_outer_init(pilot_outer_t *p, const flight_param_t *param, double period_s, pilot_t *pilot) {
  *pilot = (pilot_t){.state = p, .step = step, .reset = reset, .tell = tell};
  return outer_init(&p->flight, param, (float)period_s) == ST_OK ? DONE : BAD_INPUT;
}
