// coordinates.c - the coordinates along which a flight is cut.
#include "gap/5_infer/coordinates.h"

#include <math.h>

static const char *const NAME[COORDINATES][2] = {[COORDINATE_CEILING] = {"ceiling distance", "m"},
                                                 [COORDINATE_HEIGHT] = {"height", "m"},
                                                 [COORDINATE_X] = {"x", "m"},
                                                 [COORDINATE_Y] = {"y", "m"},
                                                 [COORDINATE_VEL_X] = {"v_x", "m/s"},
                                                 [COORDINATE_VEL_Y] = {"v_y", "m/s"},
                                                 [COORDINATE_VEL_Z] = {"v_z", "m/s"},
                                                 [COORDINATE_VOLTAGE] = {"voltage", "V"},
                                                 [COORDINATE_THRUST] = {"thrust", "N"},
                                                 [COORDINATE_RATE_X] = {"roll rate", "rad/s"},
                                                 [COORDINATE_RATE_Y] = {"pitch rate", "rad/s"},
                                                 [COORDINATE_RATE_Z] = {"yaw rate", "rad/s"},
                                                 [COORDINATE_TIME] = {"time", "s"}};

const char *coordinate_name(int i) {
  return NAME[i][0];
}
const char *coordinate_unit(int i) {
  return NAME[i][1];
}

bool coordinate_is_place(int i) {
  return i == COORDINATE_CEILING || i == COORDINATE_HEIGHT || i == COORDINATE_X || i == COORDINATE_Y ||
         i == COORDINATE_TIME;
}

static double thrust_of(const grid_t *g, int j) {
  double sum = 0.0;
  for (int k = 0; k < ROTORS; k++) sum += g->motors[0].thrust_N[k][j];
  return sum;
}

static d3_t vel_b_mps(const grid_point_t *p) {
  const axes_t axes = axes_of(p->q_wb);
  return axes_to_body(&axes, p->vel_w_mps);
}

double coordinate_of(int i, const grid_t *g, const model_t *m, int j) {
  const grid_point_t *p = &g->point[j];
  const double none = (double)NAN;
  const double up_m = m->ceiling_m - p->pos_w_m.z - body_rotor_z_m(m);
  switch (i) {
  case COORDINATE_CEILING: return g->has_position && isfinite(up_m) ? up_m : none;
  case COORDINATE_HEIGHT: return g->has_position ? p->pos_w_m.z - body_rest_z_m(m) : none;
  case COORDINATE_X: return g->has_position ? p->pos_w_m.x : none;
  case COORDINATE_Y: return g->has_position ? p->pos_w_m.y : none;
  case COORDINATE_VEL_X: return g->has_velocity ? vel_b_mps(p).x : none;
  case COORDINATE_VEL_Y: return g->has_velocity ? vel_b_mps(p).y : none;
  case COORDINATE_VEL_Z: return g->has_velocity ? vel_b_mps(p).z : none;
  case COORDINATE_VOLTAGE: return g->has_vbat ? p->vbat_V : none;
  case COORDINATE_THRUST: return g->motors[0].thrust_N[0] ? thrust_of(g, j) : none;
  case COORDINATE_RATE_X: return g->has_rates ? p->rate_b_radps.x : none;
  case COORDINATE_RATE_Y: return g->has_rates ? p->rate_b_radps.y : none;
  case COORDINATE_RATE_Z: return g->has_rates ? p->rate_b_radps.z : none;
  case COORDINATE_TIME: return p->t_s - g->flight->t_s[0]; // of the log, also if part of it is held out
  }
  return none;
}
