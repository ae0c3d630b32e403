// truth.c - what an exam hides.
#include "exam/truth.h"

#include "gap/2_predict/grid.h"
#include "plant/battery.h"
#include "rig/turned.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

// --- forms of the exam's own ------------------------------------------------------------------------------

// Two Gaussian bells over the distance.
static double bells(const fx_use_t *u, const fx_place_t *at) {
  const double d = at->ceiling_gap_m;
  return u->p[0] * (0.75 * exp(-d * d / 0.0018) + 0.45 * exp(-(d - 0.06) * (d - 0.06) / 0.002));
}
static double root(const fx_use_t *u, const fx_place_t *at) {
  const double r = at->radius_m / fmax(at->ceiling_gap_m, 0.01);
  return u->p[0] * (sqrt(1.0 + 1.5 * r * r) - 1.0);
}
static double squares(const fx_use_t *u, const fx_place_t *at) {
  const double r = at->radius_m / (4.0 * fmax(at->ground_gap_m, 0.01));
  return u->p[0] * 4.0 * r * r;
}
static double wide_bell(const fx_use_t *u, const fx_place_t *at) {
  return u->p[0] * 0.2 * exp(-at->ground_gap_m * at->ground_gap_m / 0.0032);
}
static void hub_drag(const fx_use_t *u, const fx_motion_t *m, load_t *load) {
  for (int i = 0; i < ROTORS; i++) {
    const double k = u->p[0] * pow(m->rotor_radps[i] / 2000.0, 1.3) * 2000.0;
    const fx_hub_t hub = fx_hub(m, i, 1.0);
    fx_push_hub(&hub, d3(-k * hub.air_b_mps.x, -1.1 * k * hub.air_b_mps.y, 0.0), load);
  }
}
static void plate_drag(const fx_use_t *u, const fx_motion_t *m, load_t *load) {
  const d3_t v = m->air_b_mps;
  const double c = u->p[0];
  load_add(load, d3(-c * fabs(v.x) * v.x, -c * fabs(v.y) * v.y, -1.3 * c * fabs(v.z) * v.z),
           d3(0.0, 0.0, 0.0));
}
static void inflow(const fx_use_t *u, const fx_motion_t *m, load_t *load) {
  for (int i = 0; i < ROTORS; i++) {
    const fx_hub_t hub = fx_hub(m, i, 1.0);
    const double v = hub.air_b_mps.z;
    fx_push_hub(&hub, d3(0.0, 0.0, -u->p[0] * m->rotor_radps[i] * v / (1.0 + 0.3 * fabs(v))), load);
  }
}
static void flap(const fx_use_t *u, const fx_motion_t *m, load_t *load) {
  const double k = u->p[0] * 8000.0 / (1.0 + 0.1 * d3_norm(m->air_b_mps));
  load->moment_b_Nm = d3_add(load->moment_b_Nm, d3(k * m->air_b_mps.y, -k * m->air_b_mps.x, 0.0));
}
static void lift(const fx_use_t *u, const fx_motion_t *m, load_t *load) {
  load->force_b_N.z += u->p[0] * pow(hypot(m->air_b_mps.x, m->air_b_mps.y), 1.7);
}
static void sag(const fx_use_t *u, const fx_tick_t *t, fx_plant_t *plant) {
  const double low = 1.0 - t->vbat_V / BATTERY_FULL_V, scale = 1.0 - u->p[0] * (0.7 * low + 2.0 * low * low);
  for (int i = 0; i < ROTORS; i++) plant->thrust_scale[i] *= scale;
}
static void turned(const fx_use_t *u, fx_sensed_t *sensed) {
  const axes_t a = axes_of(turned_about(d3(sin(u->p[1]), cos(u->p[1]), 0.0), u->p[0]));
  sensed->acc_b_mps2 = axes_to_body(&a, sensed->acc_b_mps2);
}
static void range_scale(const fx_use_t *u, fx_sensed_t *sensed) {
  sensed->range_m += u->p[0] * (0.9 + 0.3 * sensed->range_m);
}
static void breeze(const fx_use_t *u, const fx_tick_t *t, fx_plant_t *plant) {
  const double now = u->p[0] * (1.0 + 0.25 * sin(0.6 * t->t_s));
  plant->force_w_N = d3_add(plant->force_w_N, d3(now * cos(u->p[1]), now * sin(u->p[1]), 0.0));
}

static const fx_t own[] = {
    {.name = "ceiling", .excess = bells},
    {.name = "ceiling", .excess = root},
    {.name = "ground", .excess = squares},
    {.name = "ground", .excess = wide_bell},
    {.name = "rotor_drag", .load = hub_drag},
    {.name = "body_drag", .load = plate_drag},
    {.name = "climb_inflow", .load = inflow},
    {.name = "flapping", .load = flap},
    {.name = "translational_lift", .load = lift},
    {.name = "battery_sag", .tick = sag},
    {.name = "imu_misalignment", .sense = turned},
    {.name = "tof_bias", .sense = range_scale},
    {.name = "wind", .tick = breeze},
};
enum { BELLS, ROOT, SQUARES, WIDE_BELL, HUB, PLATE, INFLOW, FLAP, LIFT, SAG, TURNED, RANGE_SCALE, BREEZE };

// --- the table ---------------------------------------------------------------------------------------------

// Where the size goes: into one parameter; along a random direction (two parameters); into a random rotor;
// into one parameter with a random sign.
typedef enum { ONE, DIRECTION, ROTOR, SIGNED } way_t;

static const struct {
  const char *name;
  double typical;
  way_t way;
  int param, own; // own: -1 none
  double own_typical;
} row[TRUTH_EFFECTS] = {
    {"ceiling", 0.20, ONE, 0, BELLS, 0.20},
    {"ground", 6.0, ONE, 0, SQUARES, 1.5},
    {"rotor_drag", 1e-6, ONE, 0, HUB, 1e-6},
    {"body_drag", 2e-3, ONE, 0, PLATE, 2e-3},
    {"climb_inflow", 1.5e-6, ONE, 0, INFLOW, 1.5e-6},
    {"battery_sag", 0.6, ONE, 0, SAG, 0.6},
    {"motor_lag", 0.025, ONE, 0, -1, 0.0},
    {"delay", 0.010, ONE, 0, -1, 0.0},
    {"motor_damage", 0.06, ROTOR, 1, -1, 0.0},
    {"mass", 0.05 * 0.0329, SIGNED, 0, -1, 0.0},
    {"thrust_scale", 0.05, SIGNED, 0, -1, 0.0},
    {"cg_offset", 1.5e-3, DIRECTION, 0, -1, 0.0},
    {"accel_bias", 0.12, DIRECTION, 0, -1, 0.0},
    {"imu_misalignment", 1.2 * 3.14159265 / 180.0, DIRECTION, 0, TURNED, 1.2 * 3.14159265 / 180.0},
    {"wind", 0.10 * 0.0329, DIRECTION, 0, BREEZE, 0.10 * 0.0329},
    {"flapping", 1.2e-8, ONE, 0, FLAP, 1.2e-8},
    {"translational_lift", 3e-3, ONE, 0, LIFT, 3e-3},
    {"tof_bias", 0.02, SIGNED, 0, RANGE_SCALE, 0.02},
    {"tof_latency", 0.05, ONE, 0, -1, 0.0},
};

const char *truth_name(int i) {
  return row[i].name;
}

static fx_use_t own_effect(int i, double size, double which) {
  int form = row[i].own;
  double scale = 1.0;
  if (form == BELLS && which > 0.5) form = ROOT, scale = 0.6;
  if (form == SQUARES && which > 0.5) form = WIDE_BELL, scale = 1.0;
  return (fx_use_t){.fx = &own[form], .p = {scale * size, 2.0 * 3.14159265 * which}};
}

fx_use_t truth_effect(int i, double times, double which, bool own_form) {
  if (own_form && row[i].own >= 0) return own_effect(i, times * row[i].own_typical, which);
  const double size = times * row[i].typical, angle = 2.0 * 3.14159265 * which;
  fx_use_t use = fx_use(fx_find(row[i].name));
  if (use.fx->surface) {
    // 0.20 exp(-d / 7 cm); the ground's 1.5 x 4 (R/4z)^2 is near 0.95 exp(-1.1 z/R) from 3 to 10 cm
    const bool ceiling = use.fx->surface == SURFACE_CEILING;
    use.p[0] = ceiling ? size : 0.95 * times;
    use.p[1] = ceiling ? 0.02355 / 0.07 : 1.1;
    return use;
  }
  use.p[row[i].param] = row[i].way == SIGNED && which > 0.5 ? -size : size;
  if (row[i].way == ROTOR) use.p[0] = 1.0 + floor(3.999 * which);
  if (row[i].way == DIRECTION) {
    use.p[0] = size * cos(angle);
    use.p[1] = size * sin(angle);
  }
  return use;
}

double truth_typical(const char *name) {
  int i = 0, n;
  while (i < TRUTH_EFFECTS - 1 && strcmp(row[i].name, name) != 0) i++;
  const fx_use_t use = truth_effect(i, 1.0, 0.0, false), typical = fx_use(use.fx);
  const int param = use.fx->size[0].param;
  return fabs(use.p[param] / fx_use_params(&typical, &n)[param].nominal);
}

// --- outside the library -----------------------------------------------------------------------------------

static void updraft(const fx_use_t *u, const fx_motion_t *m, load_t *load) {
  const double x = m->pos_w_m.x - 0.5, y = m->pos_w_m.y;
  const double up = u->p[0] * exp(-(x * x + y * y) / 0.09);
  load->force_b_N = d3_add(load->force_b_N, axes_to_body(m->axes, d3(0.0, 0.0, up)));
}
static void late_push(const fx_use_t *u, const fx_tick_t *t, fx_plant_t *plant) {
  if (t->t_s > 9.0 && t->t_s < 14.0) plant->force_w_N.y += u->p[0];
}
static void shear(const fx_use_t *u, const fx_motion_t *m, load_t *load) {
  const double side = m->pos_w_m.z > 0.3 && m->pos_w_m.z < 0.55 ? u->p[0] : 0.0;
  load->force_b_N = d3_add(load->force_b_N, axes_to_body(m->axes, d3(side, 0.0, 0.0)));
}
static void swirl(const fx_use_t *u, const fx_motion_t *m, load_t *load) {
  load->moment_b_Nm.z += u->p[0] * exp(-pow((m->pos_w_m.z - 0.4) / 0.1, 2.0));
}
static void one_way(const fx_use_t *u, const fx_motion_t *m, load_t *load) {
  if (m->air_b_mps.x > 0.3) load->force_b_N.y += u->p[0] * (m->air_b_mps.x - 0.3);
}
static void cable(const fx_use_t *u, const fx_motion_t *m, load_t *load) {
  const double stretch = hypot(m->pos_w_m.x, m->pos_w_m.y) - 0.5;
  if (stretch <= 0.0) return;
  const d3_t pull = d3(-m->pos_w_m.x, -m->pos_w_m.y, 0.0);
  load->force_b_N = d3_add(load->force_b_N, axes_to_body(m->axes, d3_scale(u->p[0] * stretch, pull)));
}

static const fx_t strange[TRUTH_STRANGE] = {
    {.name = "updraft", .load = updraft}, {.name = "late push", .tick = late_push},
    {.name = "shear", .load = shear},     {.name = "swirl", .load = swirl},
    {.name = "one way", .load = one_way}, {.name = "cable", .load = cable},
};

fx_use_t truth_strange(int i, double times, strange_t *answer) {
  static const strange_t answers[TRUTH_STRANGE] = {
      {"updraft at a place", "xy", 1u << CH_FZ},
      {"push for five seconds", "time", 1u << CH_FY | 1u << CH_FX},
      {"side wind in a layer", "height", 1u << CH_FX | 1u << CH_FY},
      {"yaw moment in a layer", "height", 1u << CH_WZ},
      {"side force in one direction of flight", "v_x", 1u << CH_FY},
      {"a cable that pulls far out", "xy", 1u << CH_FX | 1u << CH_FY},
  };
  static const double typical[TRUTH_STRANGE] = {0.012, 0.010, 0.010, 1.2e-5, 0.012, 0.03};
  *answer = answers[i];
  return (fx_use_t){.fx = &strange[i], .p = {times * typical[i]}};
}
