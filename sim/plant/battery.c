// battery.c - one lithium-polymer cell under the motors' load.
#include "plant/battery.h"

#include "base/where.h"

static double at_least(double least, double x) {
  return where(x > least, x, least);
}

double battery_open_V(const battery_param_t *p, double charge) {
  if (!(p->capacity_As > 0.0) || p->n < 2) return BATTERY_FULL_V;
  const double last = p->n - 2, at = where(charge < 1.0, at_least(0.0, charge), 1.0) * (p->n - 1);
  const double i = where(at < last, whole_part(at), last), low_V = element_at(p->open_V, i);
  return low_V + (at - i) * (element_at(p->open_V + 1, i) - low_V);
}

double battery_current_A(const battery_param_t *p, const double *thrust_N, const double *left, int n) {
  double current_A = p->idle_A;
  for (int i = 0; i < n; i++) {
    const double f = at_least(0.0, thrust_N[i]);
    current_A += (left ? left[i] : 1.0) * f * (p->a_ApN + f * p->b_ApN2);
  }
  return current_A;
}

double battery_voltage_V(const battery_param_t *p, double charge, double current_A) {
  if (!(p->capacity_As > 0.0)) return BATTERY_FULL_V;
  return at_least(0.0, battery_open_V(p, charge) - p->resistance_ohm * current_A);
}

double battery_discharge(const battery_param_t *p, double charge, double current_A, double span_s) {
  if (!(p->capacity_As > 0.0)) return charge;
  return at_least(0.0, charge - current_A * span_s / p->capacity_As);
}
