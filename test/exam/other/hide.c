// hide.c - see hide.h.
#include "exam/other/hide.h"

#include <string.h>

#define CF_ARM_M  0.046
#define CF_KG     0.0329
#define TIP_MPS   47.0 // tip speed in a hover, from 0.03 to 1 kg
#define DELAY_MAX 0.1

static double arm_m(const nature_t *n) {
  return hypot(n->x_m[0], n->y_m[0]);
}

double hide_stretch(const nature_t *n) {
  return sqrt(arm_m(n) / CF_ARM_M);
}

// Returns the force over rotor speed and hub velocity that slows a hovering vehicle at this rate, 1/s.
static double by_rate(const nature_t *n, double rate) {
  return rate * n->mass_kg / (4.0 * nature_hover_radps(n));
}

nature_t hide_vehicle(dice_t *d) {
  nature_t n = {.mass_kg = exp(dice_between(d, log(0.03), log(1.5))), .ceiling_m = HUGE_VAL, .sag_V = 4.2};
  const double arm = CF_ARM_M * pow(n.mass_kg / CF_KG, 0.47) * dice_between(d, 0.85, 1.2);
  const double angle = dice_between(d, 0.66, 0.91), x = arm * cos(angle), y = arm * sin(angle);
  static const double sign[4][3] = {{1, -1, 1}, {-1, -1, -1}, {-1, 1, 1}, {1, 1, -1}}; // x, y, spin
  n.radius_m = arm * dice_between(d, 0.45, 0.6);
  const double hover = TIP_MPS * dice_between(d, 0.8, 1.2) / n.radius_m;
  n.k_Ns2 = n.mass_kg * NATURE_G_MPS2 / (4.0 * hover * hover);
  n.torque_m = n.radius_m * dice_between(d, 0.2, 0.3);
  n.inertia_kgm2[0] = dice_between(d, 0.2, 0.28) * n.mass_kg * arm * arm;
  n.inertia_kgm2[1] = n.inertia_kgm2[0] * dice_between(d, 1.0, 1.25);
  n.inertia_kgm2[2] = n.inertia_kgm2[0] * dice_between(d, 1.6, 1.95);
  n.most_radps = hover * sqrt(dice_between(d, 1.9, 3.0));
  n.lag_s = dice_share(d) < 0.15 ? 0.0 : dice_between(d, 0.015, 0.07);
  for (int i = 0; i < 4; i++) {
    n.x_m[i] = sign[i][0] * x;
    n.y_m[i] = sign[i][1] * y;
    n.spin[i] = sign[i][2];
    n.gain[i] = 1.0;
  }
  n.rest_m = 0.5 * n.radius_m;
  if (dice_share(d) < 0.4) {
    n.hub_kg = by_rate(&n, dice_between(d, 0.15, 0.5));
    n.climb_kg = by_rate(&n, dice_between(d, 0.15, 0.4));
  }
  return n;
}

// --- effects of the library --------------------------------------------------------------------------------

typedef struct {
  double times, which;
  nature_t *n;
  dishonest_t *senses;
} hide_t;

static double either(const hide_t *h) {
  return h->which < 0.5 ? h->times : -h->times;
}
static vec_t direction(const hide_t *h, double size) {
  return vec(size * cos(2.0 * OTHER_PI * h->which), size * sin(2.0 * OTHER_PI * h->which), 0.0);
}
static void mass(const hide_t *h) {
  h->n->mass_kg *= 1.0 + 0.05 * either(h);
}
static void thrust_scale(const hide_t *h) {
  for (int i = 0; i < 4; i++) h->n->gain[i] *= 1.0 - 0.05 * either(h);
}
static void motor_damage(const hide_t *h) {
  h->n->gain[(int)(3.999 * h->which)] *= 1.0 - 0.06 * h->times;
}
static void cg_offset(const hide_t *h) {
  const vec_t off = direction(h, 0.033 * h->times * arm_m(h->n));
  for (int i = 0; i < 4; i++) {
    h->n->x_m[i] -= off.x;
    h->n->y_m[i] -= off.y;
  }
}
static void inertia(const hide_t *h) {
  for (int k = 0; k < 3; k++) h->n->inertia_kgm2[k] *= 1.0 + 0.3 * h->times;
}
static void motor_lag(const hide_t *h) {
  h->n->lag_s += HIDE_LAG_S * h->times;
}
static void delay(const hide_t *h) {
  h->n->delay_s = fmin(h->n->delay_s + HIDE_DELAY_S * h->times, DELAY_MAX);
}
static void rotor_drag(const hide_t *h) {
  h->n->hub_kg += by_rate(h->n, 0.25 * h->times);
}
static void climb_inflow(const hide_t *h) {
  h->n->climb_kg += by_rate(h->n, 0.38 * h->times);
}
static void body_drag(const hide_t *h) {
  static const double axis[3] = {1.0, 1.15, 0.9};
  for (int k = 0; k < 3; k++) h->n->body_kgpm[k] += 0.06 * axis[k] * h->times * h->n->mass_kg;
}
static void flapping(const hide_t *h) {
  h->n->flap_kgm += 6.0 * either(h) * h->n->inertia_kgm2[0] / (4.0 * nature_hover_radps(h->n));
}
static void translational_lift(const hide_t *h) {
  h->n->lift_kgpm += 0.09 * h->times * h->n->mass_kg;
}
// Moves the air if there is a drag to feel it; else pushes.
static void wind(const hide_t *h) {
  const double push_N = 0.1 * h->times * h->n->mass_kg;
  const double felt = 4.0 * nature_hover_radps(h->n) * h->n->hub_kg;
  if (felt > 0.0)
    h->n->air_mps = direction(h, push_N / felt);
  else
    h->n->push_N = direction(h, push_N);
}
static void battery_sag(const hide_t *h) {
  h->n->sag = 0.6 * h->times;
  h->n->sag_V = 3.8 + 0.4 * h->which;
}
static void thrust_curve(const hide_t *h) {
  h->n->bend_pN = 0.25 * either(h) / (0.25 * h->n->mass_kg * NATURE_G_MPS2);
}
static void ceiling(const hide_t *h) {
  h->n->ceiling_share = 0.2 * h->times;
  h->n->ceiling_m0 = (2.0 + 2.0 * h->which) * h->n->radius_m;
}
static void ground(const hide_t *h) {
  h->n->ground_share = 1.0 * h->times;
}
static void accel_bias(const hide_t *h) {
  h->senses->acc_mps2 = direction(h, 0.12 * h->times);
}
static void imu_misalignment(const hide_t *h) {
  h->senses->acc_turn_rad = direction(h, 0.021 * h->times);
}
static void tof_bias(const hide_t *h) {
  h->senses->range_m = 0.02 * either(h);
}

static const struct {
  const char *name;
  void (*hide)(const hide_t *h);
} row[HIDE_EFFECTS] = {
    {"mass", mass},
    {"thrust_scale", thrust_scale},
    {"motor_damage", motor_damage},
    {"cg_offset", cg_offset},
    {"inertia", inertia},
    {"motor_lag", motor_lag},
    {"delay", delay},
    {"rotor_drag", rotor_drag},
    {"climb_inflow", climb_inflow},
    {"body_drag", body_drag},
    {"flapping", flapping},
    {"translational_lift", translational_lift},
    {"wind", wind},
    {"battery_sag", battery_sag},
    {"thrust_curve", thrust_curve},
    {"ceiling", ceiling},
    {"ground", ground},
    {"accel_bias", accel_bias},
    {"imu_misalignment", imu_misalignment},
    {"tof_bias", tof_bias},
};

const char *hide_name(int i) {
  return row[i].name;
}

int hide_number(const char *name) {
  int i = 0;
  while (i < HIDE_EFFECTS && strcmp(row[i].name, name) != 0) i++;
  return i;
}

void hide_effect(int i, double times, double which, nature_t *n, dishonest_t *senses) {
  row[i].hide(&(hide_t){times, which, n, senses});
}

void hide_prepare(int i, dice_t *d, nature_t *n) {
  if (row[i].hide == rotor_drag) n->hub_kg = 0.0;
  if (row[i].hide == climb_inflow) n->climb_kg = 0.0;
  if (row[i].hide == wind && dice_share(d) < 0.5) n->hub_kg = by_rate(n, dice_between(d, 0.3, 0.5));
  if ((row[i].hide == ceiling || row[i].hide == tof_bias) && isinf(n->ceiling_m))
    n->ceiling_m = 0.85 * hide_stretch(n) + 6.0 * n->radius_m;
}

// --- outside the library -----------------------------------------------------------------------------------

hide_strange_t hide_strange(int i, double times, dice_t *d, double far_m, nature_t *n) {
  static const hide_strange_t answer[HIDE_STRANGE] = {{"an updraft at a place", "xy", 4u},
                                                      {"side wind in a layer", "height", 3u},
                                                      {"a push out of a corner", "xy", 3u},
                                                      {"short pulses", "time", 3u},
                                                      {"a shake from the side", "", 3u}};
  static const double accel_mps2[HIDE_STRANGE] = {0.4, 0.3, 0.3, 0.8, 0.5};
  n->strange = (strange_kind_t)(STRANGE_PLACE + i);
  n->strange_N = times * accel_mps2[i] * n->mass_kg;
  const double at[HIDE_STRANGE][3] = {{0.4 * far_m, 0.0, 0.3 * far_m},
                                      {0.5 * far_m, 0.0, 0.1 * far_m},
                                      {0.15 * far_m, 0.15 * far_m, 0.0},
                                      {dice_between(d, 2.5, 4.0), 0.0, 0.3},
                                      {dice_between(d, 1.5, 3.5), 0.0, 0.0}};
  for (int k = 0; k < 3; k++) n->strange_at[k] = at[i][k];
  return answer[i];
}
