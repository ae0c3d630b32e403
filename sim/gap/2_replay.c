// 2_replay.c - measured state and logged commands through the model, one derivative at a time.
#include "gap/2_replay.h"

#include "body_forces.h"
#include <math.h>

static void place_body(body_t *b, const point_t *p) {
  d3_put(b->y + RIGID_POS_M, p->pos_w_m);
  d3_put(b->y + RIGID_VEL_MPS, p->vel_w_mps);
  b->y[RIGID_Q_WB] = p->q_wb.w;
  d3_put(b->y + RIGID_Q_WB + 1, d3(p->q_wb.x, p->q_wb.y, p->q_wb.z));
  d3_put(b->y + RIGID_RATE_RADPS, p->rate_b_radps);
  b->vbat_V = p->vbat_V;
}

// The range sensor sees along its axis; both sit in the rotors' plane and at the feet, near enough. A point
// is a mean over samples, a range is one of them: 10 ms apart would be told as so much latency.
static fx_sensed_t in_sight(const grid_t *g, const model_t *m, const point_t *p, const axes_t *axes) {
  const double up = fmax(axes_up_b(axes).z, 0.1);
  const double z_m = p->pos_w_m.z - p->vel_w_mps.z * p->range_before_s;
  const double above_m = m->ceiling_m - z_m - body_rotor_z_m(m);
  const double below_m = z_m - body_rest_z_m(m);
  const double side = g->range_up ? -1.0 : 1.0;
  return (fx_sensed_t){.range_m = (g->range_up ? above_m : below_m) / up,
                       .range_rate_mps = side * p->vel_w_mps.z / up};
}

static void predict(const grid_t *g, body_t *b, const point_t *p, double out[CHANNELS]) {
  double dydt[RIGID_N];
  if (b->n_tick > 0) body_effects(b, g->period_s);
  body_derivative(b, 0, b->y, dydt);
  const axes_t axes = axes_of(p->q_wb);
  const d3_t pull =
      d3(dydt[RIGID_VEL_MPS], dydt[RIGID_VEL_MPS + 1], dydt[RIGID_VEL_MPS + 2] + PLANT_GRAVITY_MPS2);
  fx_sensed_t sensed = in_sight(g, b->model, p, &axes);
  sensed.acc_b_mps2 = axes_to_body(&axes, pull);
  model_sense(b->model, &sensed);
  d3_put(out, sensed.acc_b_mps2);
  for (int i = 0; i < 3; i++) out[CH_WX + i] = dydt[RIGID_RATE_RADPS + i];
  out[CH_RANGE] = sensed.range_m;
}

static status_t run(grid_t *g, body_t *b, double *const out[CHANNELS], why_t *why) {
  place_body(b, &g->point[0]);
  if (b->n_tick > 0) body_effects(b, g->period_s); // lag and delay
  const lagged_t *motors = grid_motors(g, b->rigid.motor_tau_s, b->plant.delay_s);
  if (!motors) return error_failed(why, "out of memory");
  const double start_s = g->point[0].t_s;
  for (int j = 0; j < g->n; j++) {
    double at[CHANNELS];
    place_body(b, &g->point[j]);
    b->t_s = g->point[j].t_s - start_s;
    for (int k = 0; k < ROTORS; k++) {
      b->y[RIGID_THRUST_N + k] = motors->thrust_N[k][j];
      b->rigid.command_N[k] = motors->thrust_N[k][j] + motors->rise_Nps[k][j] * b->rigid.motor_tau_s;
    }
    predict(g, b, &g->point[j], at);
    for (int c = 0; c < CHANNELS; c++) out[c][j] = at[c];
  }
  return ST_OK;
}

status_t replay(grid_t *g, const model_t *m, double *const out[CHANNELS], why_t *why) {
  body_t b;
  const body_start_t start = {.seed = 1};
  if (g->n == 0) return ST_OK;
  if (body_open(&b, m, INTEGRATE_RK4, g->period_s, &start) != ST_OK)
    return error_failed(why, "%s: a model that cannot be replayed", m->name);
  const status_t status = run(g, &b, out, why);
  body_close(&b);
  return status;
}
