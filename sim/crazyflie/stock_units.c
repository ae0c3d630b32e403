// stock_units.c - the border between SI and the units of the Crazyflie's firmware.
#include "crazyflie/stock_units.h"

#include "base/clip.h"
#include "base/constants.h"
#include "base/either.h"
#include "base/pair.h"

#define SUPPLY_START_V 4.2
#define SUPPLY_GAIN    0.01
#define SUPPLY_MIN_V   2.0
#define PAIRS          (PILOT_MOTORS / 2)
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

static pair_t cubic_N(const double c[4], pair_t v) {
  return c[0] + v * (c[1] + v * (c[2] + v * c[3]));
}

// The real root of the cubic, which rises everywhere (Cardano): with v = t - b/(3a), t^3 + 3 m t = 2 n.
static double cubic_V(const double c[4], double thrust_N) {
  const double shift = c[2] / (3.0 * c[3]);
  const double m = c[1] / (3.0 * c[3]) - shift * shift;
  const double n = 0.5 * (shift * c[1] / c[3] - (c[0] - thrust_N) / c[3]) - shift * shift * shift;
  const double root = sqrt(n * n + m * m * m);
  return cbrt(n + root) + cbrt(n - root) - shift;
}

// The same of those motors that are asked for, by Newton's method from the roots of thrusts that were a
// little different. All four at once, for a step is one long division after another: who is there waits for
// the others.
static void near_V(const double c[4], const pair_t thrust_N[PAIRS], const pair_bits_t asked[PAIRS],
                   pair_t v[PAIRS]) {
  const pair_t zero = pair_both(0.0), near = pair_both(1e-9); // the next step would be its square
  const pair_bits_t known[PAIRS] = {v[0] > zero, v[1] > zero};
  pair_bits_t goes_on[PAIRS] = {asked[0] & known[0], asked[1] & known[1]};
  for (int n = 0; n < 6 && pair_any(goes_on[0] | goes_on[1]); n++)
    for (int i = 0; i < PAIRS; i++) {
      const pair_t step = (cubic_N(c, v[i]) - thrust_N[i]) / (c[1] + v[i] * (2.0 * c[2] + v[i] * 3.0 * c[3]));
      v[i] -= pair_where(goes_on[i], step, zero);
      goes_on[i] &= ~((step < near) & (-step < near));
    }
  for (int k = 0; k < PILOT_MOTORS; k++) {
    const alike_t i = k / 2;
    if ((goes_on[i] | (asked[i] & ~known[i]))[k % 2]) v[i][k % 2] = cubic_V(c, thrust_N[i][k % 2]);
  }
}

static void wanted_V(const stock_power_param_t *p, const pair_t thrust_N[PAIRS],
                     const pair_bits_t asked[PAIRS], pair_t v[PAIRS]) {
  const double *q = p->volt_quadratic;
  if (!(q[0] > 0.0)) {
    near_V(p->volt_cubic, thrust_N, asked, v);
    return;
  }
  for (int i = 0; i < PAIRS; i++) {
    const pair_t grams = PILOT_MOTORS * 1e3 / G_MPS2 * thrust_N[i];
    v[i] = pair_where(asked[i], grams * (q[0] + q[1] * grams), v[i]);
  }
}

// Volts at the motors for units; which of them run.
static void want(stock_power_t *s, const stock_power_param_t *p, const double unit[PILOT_MOTORS],
                 pair_t v[PAIRS], pair_bits_t runs[PAIRS]) {
  pair_t wanted_N[PAIRS];
  pair_bits_t changed[PAIRS];
  for (int i = 0; i < PAIRS; i++) {
    const pair_t whole = pair_trunc(pair_of(unit + 2 * i)), last_N = pair_of(s->wanted_N + 2 * i);
    wanted_N[i] =
        p->thrust_max_N / STOCK_FULL * pair_min(pair_max(whole, pair_both(-UNIT_MAX)), pair_both(UNIT_MAX));
    runs[i] = wanted_N[i] >= p->thrust_min_N;
    changed[i] = runs[i] & (wanted_N[i] != last_N);
    v[i] = pair_of(s->wanted_V + 2 * i);
    pair_put(s->wanted_N + 2 * i, pair_where(changed[i], wanted_N[i], last_N));
  }
  if (!pair_any(changed[0] | changed[1])) return;
  wanted_V(p, wanted_N, changed, v);
  for (int i = 0; i < PAIRS; i++) pair_put(s->wanted_V + 2 * i, v[i]);
}

PAIR_COPIES void stock_power_duty(stock_power_t *s, const stock_power_param_t *p,
                                  const double unit[PILOT_MOTORS], double vbat_V, double duty[PILOT_MOTORS]) {
  const pair_t off = pair_both(0.0);
  s->supply_V += SUPPLY_GAIN * (vbat_V - s->supply_V);
  if (!(s->supply_V >= SUPPLY_MIN_V)) { // not a number stops the motors, too
    for (int i = 0; i < PILOT_MOTORS; i++) duty[i] = 0.0;
    return;
  }
  pair_t v[PAIRS];
  pair_bits_t runs[PAIRS];
  want(s, p, unit, v, runs);
  for (int i = 0; i < PAIRS; i++)
    pair_put(duty + 2 * i, pair_where(runs[i], pair_trunc(STOCK_FULL * v[i] / s->supply_V), off));
  double most = STOCK_FULL;
  for (int i = 0; i < PILOT_MOTORS; i++) most = larger(most, duty[i]);
  for (int i = 0; i < PILOT_MOTORS; i++) duty[i] = larger(duty[i] - (most - STOCK_FULL), 0.0);
}

void stock_power_step(stock_power_t *s, const stock_power_param_t *p, const double unit[PILOT_MOTORS],
                      double vbat_V, double motor_N[PILOT_MOTORS]) {
  double duty[PILOT_MOTORS];
  stock_power_duty(s, p, unit, vbat_V, duty);
  const pair_t off = pair_both(0.0);
  for (int i = 0; i < PILOT_MOTORS; i += 2) {
    const pair_t share = pair_of(duty + i) / STOCK_FULL;
    const pair_t turning_N = pair_max(cubic_N(p->volt_cubic, share * s->supply_V), off);
    pair_put(motor_N + i, pair_where(share > off, turning_N, off));
  }
}
