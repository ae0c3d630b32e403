// battery.c - one lithium-polymer cell under the motors' load.
#include "plant/battery.h"

static double larger(double a, double b) {
  return a > b ? a : b;
}

double battery_open_V(const battery_param_t *p, double charge) {
  if (!(p->capacity_As > 0.0) || p->n < 2) return BATTERY_FULL_V;
  const double at = (charge < 1.0 ? larger(charge, 0.0) : 1.0) * (p->n - 1);
  const int i = at < p->n - 2 ? (int)at : p->n - 2;
  return p->open_V[i] + (at - i) * (p->open_V[i + 1] - p->open_V[i]);
}

double battery_current_A(const battery_param_t *p, const double *thrust_N, const double *left, int n) {
  double current_A = p->idle_A;
  for (int i = 0; i < n; i++) {
    const double f = larger(thrust_N[i], 0.0);
    current_A += (left ? left[i] : 1.0) * f * (p->a_ApN + f * p->b_ApN2);
  }
  return current_A;
}

double battery_voltage_V(const battery_param_t *p, double charge, double current_A) {
  if (!(p->capacity_As > 0.0)) return BATTERY_FULL_V;
  return larger(battery_open_V(p, charge) - p->resistance_ohm * current_A, 0.0);
}

double battery_discharge(const battery_param_t *p, double charge, double current_A, double span_s) {
  if (!(p->capacity_As > 0.0)) return charge;
  return larger(charge - current_A * span_s / p->capacity_As, 0.0);
}
