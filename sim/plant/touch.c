// touch.c - contact of feet, body and blades with floor and ceiling.
#include "plant/touch.h"

enum { FEET, TOPS, DISCS, GROUPS };

static const d3_t *group_of(const touch_t *t, int g) {
  return g == FEET ? t->foot : g == TOPS ? t->top : t->disc;
}

void touch_init(touch_t *t, double mass_kg) {
  t->below_m = t->above_m = t->beside_m = 0.0;
  for (int g = 0; g < GROUPS; g++) {
    t->lowest_m[g] = HUGE_VAL;
    t->highest_m[g] = -HUGE_VAL;
    for (int i = 0; i < 4; i++) {
      const d3_t p = group_of(t, g)[i];
      t->lowest_m[g] = fmin(t->lowest_m[g], p.z);
      t->highest_m[g] = fmax(t->highest_m[g], p.z);
      t->beside_m = fmax(t->beside_m, hypot(p.x, p.y) + (g == DISCS ? t->disc_radius_m : 0.0));
    }
    t->below_m = fmax(t->below_m, -t->lowest_m[g]);
    t->above_m = fmax(t->above_m, t->highest_m[g]);
  }
  t->spring_Npm = TOUCH_SPRING * mass_kg;
  t->damper_Nspm = TOUCH_DAMPER * mass_kg;
  t->grip_Nspm = TOUCH_GRIP * mass_kg;
}

int touch_near(const touch_t *t, double z_m, const axes_t *axes, double margin_m) {
  const d3_t up = axes_up_b(axes);
  const double beside_m = t->beside_m * (fabs(up.x) + fabs(up.y)) + margin_m;
  const double below_m = up.z > 0.0 ? up.z * t->below_m : -up.z * t->above_m;
  const double above_m = up.z > 0.0 ? up.z * t->above_m : -up.z * t->below_m;
  return (z_m < below_m + beside_m ? TOUCH_FLOOR : 0) |
         (t->ceiling_m - z_m < above_m + beside_m ? TOUCH_CEILING : 0);
}

// How far a disc's nearest point towards `side` (+1: up, -1: down) lies from its centre, times `up`.
static double disc_reach_m(const touch_t *t, d3_t up, double side) {
  const double flat = up.x * up.x + up.y * up.y;
  return side * t->disc_radius_m / sqrt(flat + TOUCH_LEVEL * TOUCH_LEVEL);
}

static d3_t point_of(const touch_t *t, int g, int i, d3_t up, double reach_m) {
  const d3_t p = group_of(t, g)[i];
  return g == DISCS ? d3_add(p, d3(reach_m * up.x, reach_m * up.y, 0.0)) : p;
}

// The largest of side * up' p over all points.
static double farthest_m(const touch_t *t, d3_t up, double side) {
  const double reach_m = disc_reach_m(t, up, side);
  double most_m = -HUGE_VAL;
  for (int g = 0; g < GROUPS; g++)
    for (int i = 0; i < 4; i++) {
      const double at_m = side * d3_dot(up, point_of(t, g, i, up, reach_m));
      most_m = at_m > most_m ? at_m : most_m;
    }
  return most_m;
}

touch_gap_t touch_gap(const touch_t *t, double z_m, const axes_t *axes) {
  const d3_t up = axes_up_b(axes);
  return (touch_gap_t){z_m - farthest_m(t, up, -1.0), t->ceiling_m - z_m - farthest_m(t, up, 1.0)};
}

// One point, depth_m inside a surface whose normal (out of the surface) is n.
static void push(const touch_t *t, d3_t point, double depth_m, d3_t n, d3_t vel_b, d3_t rate_b,
                 load_t *load) {
  const d3_t vel = d3_add(vel_b, d3_cross(rate_b, point));
  const double out_mps = d3_dot(vel, n);
  const double soft = depth_m < TOUCH_SOFT_M ? depth_m / TOUCH_SOFT_M : 1.0;
  const double normal_N = t->spring_Npm * depth_m - t->damper_Nspm * soft * out_mps;
  if (!(normal_N > 0.0)) return;
  const d3_t along = d3_add_scaled(vel, -out_mps, n);
  const double speed = d3_norm(along), slip_N = TOUCH_FRICTION * normal_N;
  const double grip = t->grip_Nspm * speed > slip_N ? slip_N / speed : t->grip_Nspm;
  const d3_t force = d3_sub(d3_scale(normal_N, n), d3_scale(grip, along));
  load_add(load, force, d3_cross(point, force));
}

// No point of the group lies more than this towards `side`.
static double bound_m(const touch_t *t, int g, d3_t up, double side) {
  const double z_m = side * up.z > 0.0 ? t->highest_m[g] : t->lowest_m[g];
  return side * up.z * z_m + t->beside_m * (fabs(up.x) + fabs(up.y));
}

static void press(const touch_t *t, double side, double room_m, const double y[RIGID_N], const axes_t *axes,
                  load_t *load) {
  const d3_t up = axes_up_b(axes), rate_b = d3_of(y + RIGID_RATE_RADPS);
  const d3_t vel_b = axes_to_body(axes, d3_of(y + RIGID_VEL_MPS));
  const double reach_m = disc_reach_m(t, up, side);
  for (int g = 0; g < GROUPS; g++) {
    if (bound_m(t, g, up, side) <= room_m) continue;
    for (int i = 0; i < 4; i++) {
      const d3_t point = point_of(t, g, i, up, reach_m);
      const double depth_m = side * d3_dot(up, point) - room_m;
      if (depth_m > 0.0) push(t, point, depth_m, d3_scale(-side, up), vel_b, rate_b, load);
    }
  }
}

void touch_load(const touch_t *t, int surfaces, const double y[RIGID_N], const axes_t *axes, load_t *load) {
  const double z_m = y[RIGID_POS_M + 2];
  if (surfaces & TOUCH_FLOOR) press(t, -1.0, z_m, y, axes, load);
  if (surfaces & TOUCH_CEILING) press(t, 1.0, t->ceiling_m - z_m, y, axes, load);
}
