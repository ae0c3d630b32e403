// stock_units.c - conversion between SI and the units of the Crazyflie's firmware.
#include "crazyflie/stock_units.h"

#include "base/clip.h"
#include "base/constants.h"
#include "base/either.h"
#include "base/few.h"

#define SUPPLY_START_V 4.2
#define SUPPLY_GAIN    0.01
#define SUPPLY_MIN_V   2.0
#define PARTS          (PILOT_MOTORS / FEW_N)
#define UNIT_MAX       1e6 // far beyond all commands; keeps the sums of whole numbers exact

stock_angles_t stock_angles(dq_t q) {
  const double lean = 2.0 * (q.w * q.y - q.x * q.z); // sine of the nose-down angle
  return (stock_angles_t){
      .roll_deg = STOCK_DEG * atan2(2.0 * (q.w * q.x + q.y * q.z), 1.0 - 2.0 * (q.x * q.x + q.y * q.y)),
      .pitch_deg = -STOCK_DEG * asin(clip(lean, -1.0, 1.0)),
      .yaw_deg = STOCK_DEG * atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z)),
  };
}

stock_view_t stock_view(const pilot_in_t *in) {
  const stock_angles_t angles = stock_angles(in->q_wb);
  return (stock_view_t){
      .gyro_dps = d3_scale(STOCK_DEG, in->gyro_b_radps),
      .acc_g = d3_scale(1.0 / G_MPS2, in->acc_b_mps2),
      .roll_deg = angles.roll_deg,
      .pitch_deg = angles.pitch_deg,
      .yaw_deg = angles.yaw_deg,
  };
}

double stock_cap_deg(double angle_deg) {
  return fabs(angle_deg) <= 180.0 ? angle_deg : remainder(angle_deg, 360.0);
}

stock_power_param_t stock_power_legacy(void) {
  return (stock_power_param_t){
      .volt_cubic = {-0.014830744918356092, 0.04724465241828281, -0.01847364358025878, 0.005960923942142},
      .thrust_min_N = 0.012817578393224994,
      .thrust_max_N = 0.12,
  };
}

stock_power_param_t stock_power_plus(void) {
  return (stock_power_param_t){
      .volt_cubic = {-0.02476537915958403, 0.06523793527519485, -0.026792504967750107, 0.006776789303971145},
      .thrust_min_N = 0.012817578393224994,
      .thrust_max_N = 0.12,
  };
}

stock_power_param_t stock_power_60g(void) {
  stock_power_param_t p = stock_power_legacy();
  p.thrust_max_N = 0.060 * G_MPS2 / PILOT_MOTORS;
  return p;
}

stock_power_param_t stock_power_2022(void) {
  stock_power_param_t p = stock_power_60g();
  p.volt_quadratic[0] = 0.088;
  p.volt_quadratic[1] = -0.0006239;
  return p;
}

void stock_power_start(stock_power_t *s) {
  *s = (stock_power_t){.supply_V = SUPPLY_START_V};
}

void stock_mix(const stock_command_t *command, double unit[PILOT_MOTORS]) {
  const double t = command->thrust, yaw = trunc(command->yaw);
  const double r = trunc(trunc(command->roll) / 2.0), p = trunc(trunc(command->pitch) / 2.0);
  unit[0] = trunc(t - r + p + yaw);
  unit[1] = trunc(t - r - p - yaw);
  unit[2] = trunc(t + r - p + yaw);
  unit[3] = trunc(t + r + p - yaw);
}

FEW_INLINE few_t cubic_N(const double c[4], few_t v) {
  return c[0] + v * (c[1] + v * (c[2] + v * c[3]));
}

FEW_INLINE bool any_motor(const few_bits_t holds[PARTS]) {
  few_bits_t any = holds[0];
  for (int i = 1; i < PARTS; i++) any = any | holds[i];
  return few_any(any);
}

// The only real root of the cubic, which rises everywhere (Cardano): with v = t - b/(3a), t^3 + 3 m t = 2 n.
static double cubic_V(const double c[4], double thrust_N) {
  const double shift = c[2] / (3.0 * c[3]);
  const double m = c[1] / (3.0 * c[3]) - shift * shift;
  const double n = 0.5 * (shift * c[1] / c[3] - (c[0] - thrust_N) / c[3]) - shift * shift * shift;
  const double root = sqrt(n * n + m * m * m);
  return cbrt(n + root) + cbrt(n - root) - shift;
}

// Solves the cubic for the motors in `asked` by Newton's method, which starts from the roots of the last,
// slightly different thrusts. All motors iterate at once, because a step is one long division after another;
// a motor that has converged waits for the others.
static void near_V(const double c[4], const few_t thrust_N[PARTS], const few_bits_t asked[PARTS],
                   few_t v[PARTS]) {
  const few_t zero = few_all(0.0), near = few_all(1e-9); // the next step would be about its square
  few_bits_t known[PARTS], goes_on[PARTS];
  for (int i = 0; i < PARTS; i++) {
    known[i] = v[i] > zero;
    goes_on[i] = asked[i] & known[i];
  }
  for (int n = 0; n < 6 && any_motor(goes_on); n++)
    for (int i = 0; i < PARTS; i++) {
      const few_t step = (cubic_N(c, v[i]) - thrust_N[i]) / (c[1] + v[i] * (2.0 * c[2] + v[i] * 3.0 * c[3]));
      v[i] -= few_where(goes_on[i], step, zero);
      goes_on[i] &= ~((step < near) & (-step < near));
    }
  for (int i = 0; i < PARTS; i++) goes_on[i] = goes_on[i] | (asked[i] & ~known[i]);
  if (!any_motor(goes_on)) return;
  for (int k = 0; k < PILOT_MOTORS; k++) {
    const alike_t i = k / FEW_N, at = k % FEW_N;
    if (goes_on[i][at]) v[i][at] = cubic_V(c, thrust_N[i][at]);
  }
}

static void wanted_V(const stock_power_param_t *p, const few_t thrust_N[PARTS], const few_bits_t asked[PARTS],
                     few_t v[PARTS]) {
  const double *q = p->volt_quadratic;
  if (!(q[0] > 0.0)) {
    near_V(p->volt_cubic, thrust_N, asked, v);
    return;
  }
  for (int i = 0; i < PARTS; i++) {
    const few_t grams = PILOT_MOTORS * 1e3 / G_MPS2 * thrust_N[i];
    v[i] = few_where(asked[i], grams * (q[0] + q[1] * grams), v[i]);
  }
}

// The volts at the motors for their units, and which motors run.
static void want(stock_power_t *s, const stock_power_param_t *p, const double unit[PILOT_MOTORS],
                 few_t v[PARTS], few_bits_t runs[PARTS]) {
  few_t wanted_N[PARTS];
  few_bits_t changed[PARTS];
  for (int i = 0; i < PARTS; i++) {
    const few_t whole = few_trunc(few_of(unit + FEW_N * i)), last_N = few_of(s->wanted_N + FEW_N * i);
    wanted_N[i] =
        p->thrust_max_N / STOCK_FULL * few_min(few_max(whole, few_all(-UNIT_MAX)), few_all(UNIT_MAX));
    runs[i] = wanted_N[i] >= few_all(p->thrust_min_N);
    changed[i] = runs[i] & (wanted_N[i] != last_N);
    v[i] = few_of(s->wanted_V + FEW_N * i);
    few_put(s->wanted_N + FEW_N * i, few_where(changed[i], wanted_N[i], last_N));
  }
  if (!any_motor(changed)) return;
  wanted_V(p, wanted_N, changed, v);
  for (int i = 0; i < PARTS; i++) few_put(s->wanted_V + FEW_N * i, v[i]);
}

PAIR_COPIES void stock_power_duty(stock_power_t *s, const stock_power_param_t *p,
                                  const double unit[PILOT_MOTORS], double vbat_V, double duty[PILOT_MOTORS]) {
  const few_t off = few_all(0.0);
  s->supply_V += SUPPLY_GAIN * (vbat_V - s->supply_V);
  if (!(s->supply_V >= SUPPLY_MIN_V)) { // NaN stops the motors, too
    for (int i = 0; i < PILOT_MOTORS; i++) duty[i] = 0.0;
    return;
  }
  few_t v[PARTS], most = few_all(STOCK_FULL);
  few_bits_t runs[PARTS];
  want(s, p, unit, v, runs);
  for (int i = 0; i < PARTS; i++) {
    v[i] = few_where(runs[i], few_trunc(STOCK_FULL * v[i] / s->supply_V), off);
    most = few_max(v[i], most);
  }
  double over = most[0];
  for (int i = 1; i < FEW_N; i++) over = larger(over, most[i]);
  over = over - STOCK_FULL;
  // Stored as whole vectors, as they are loaded again: a load that is wider than the store before it waits.
  for (int i = 0; i < PARTS; i++) few_put(duty + FEW_N * i, few_max(v[i] - over, off));
}

void stock_power_step(stock_power_t *s, const stock_power_param_t *p, const double unit[PILOT_MOTORS],
                      double vbat_V, double motor_N[PILOT_MOTORS]) {
  double duty[PILOT_MOTORS];
  stock_power_duty(s, p, unit, vbat_V, duty);
  const few_t off = few_all(0.0);
  for (int i = 0; i < PILOT_MOTORS; i += FEW_N) {
    const few_t share = few_of(duty + i) / STOCK_FULL;
    const few_t turning_N = few_max(cubic_N(p->volt_cubic, share * s->supply_V), off);
    few_put(motor_N + i, few_where(share > off, turning_N, off));
  }
}
