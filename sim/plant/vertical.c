// vertical.c - the vehicle on its vertical axis.
#include "plant/vertical.h"

#include <math.h>

static double free_acc_mps2(const vertical_t *v, const double y[VERTICAL_N], double ratio) {
  return (ratio * y[VERTICAL_THRUST_N] + v->force_N) / v->mass_kg - PLANT_GRAVITY_MPS2;
}

double vertical_acc_mps2(const vertical_t *v, const double y[VERTICAL_N], double ratio) {
  return v->contact == CONTACT_NONE ? free_acc_mps2(v, y, ratio) : 0.0;
}

void vertical_derivative(const vertical_t *v, const double y[VERTICAL_N], double ratio,
                         double dydt[VERTICAL_N]) {
  dydt[VERTICAL_Z_M] = v->contact == CONTACT_NONE ? y[VERTICAL_CLIMB_MPS] : 0.0;
  dydt[VERTICAL_CLIMB_MPS] = vertical_acc_mps2(v, y, ratio);
  dydt[VERTICAL_THRUST_N] = (v->command_N - y[VERTICAL_THRUST_N]) / v->motor_tau_s;
}

double vertical_margin(const vertical_t *v, const double y[VERTICAL_N], double ratio) {
  switch (v->contact) {
  case CONTACT_GROUND: return -free_acc_mps2(v, y, ratio);
  case CONTACT_CEILING: return free_acc_mps2(v, y, ratio);
  case CONTACT_NONE: break;
  }
  return fmin(y[VERTICAL_Z_M], v->ceiling_m - y[VERTICAL_Z_M]);
}

void vertical_switch(vertical_t *v, double y[VERTICAL_N]) {
  if (v->contact != CONTACT_NONE) {
    v->contact = CONTACT_NONE;
    return;
  }
  const int at_ceiling = v->ceiling_m - y[VERTICAL_Z_M] < y[VERTICAL_Z_M];
  v->contact = at_ceiling ? CONTACT_CEILING : CONTACT_GROUND;
  y[VERTICAL_Z_M] = at_ceiling ? v->ceiling_m - VERTICAL_NUDGE_M : VERTICAL_NUDGE_M;
  y[VERTICAL_CLIMB_MPS] = 0.0;
}
