// touch.c - contact of feet, body and blades with floor and ceiling.
#include "plant/touch.h"

#define POINTS (2 * TOUCH_CORNERS + ROTORS)

void touch_init(touch_t *t, double mass_kg) {
  t->below_m = t->above_m = t->beside_m = 0.0;
  const d3_t *const group[] = {t->foot, t->top, t->disc};
  for (int g = 0; g < 3; g++)
    for (int i = 0; i < 4; i++) {
      const d3_t p = group[g][i];
      const double radius_m = group[g] == t->disc ? t->disc_radius_m : 0.0;
      t->below_m = fmax(t->below_m, -p.z);
      t->above_m = fmax(t->above_m, p.z);
      t->beside_m = fmax(t->beside_m, hypot(p.x, p.y) + radius_m);
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

// All points, the discs' towards `side` (+1: up, -1: down).
static void points_of(const touch_t *t, d3_t up, double side, d3_t point[POINTS]) {
  const double flat = up.x * up.x + up.y * up.y;
  const double reach_m = side * t->disc_radius_m / sqrt(flat + TOUCH_LEVEL * TOUCH_LEVEL);
  for (int i = 0; i < 4; i++) {
    point[i] = t->foot[i];
    point[4 + i] = t->top[i];
    point[8 + i] = d3_add(t->disc[i], d3(reach_m * up.x, reach_m * up.y, 0.0));
  }
}

touch_gap_t touch_gap(const touch_t *t, double z_m, const axes_t *axes) {
  const d3_t up = axes_up_b(axes);
  d3_t point[POINTS];
  touch_gap_t gap = {HUGE_VAL, HUGE_VAL};
  points_of(t, up, -1.0, point);
  for (int i = 0; i < POINTS; i++) gap.floor_m = fmin(gap.floor_m, z_m + d3_dot(up, point[i]));
  points_of(t, up, 1.0, point);
  for (int i = 0; i < POINTS; i++)
    gap.ceiling_m = fmin(gap.ceiling_m, t->ceiling_m - z_m - d3_dot(up, point[i]));
  return gap;
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

void touch_load(const touch_t *t, int surfaces, const double y[RIGID_N], const axes_t *axes, load_t *load) {
  const d3_t up = axes_up_b(axes), rate_b = d3_of(y + RIGID_RATE_RADPS);
  const d3_t vel_b = axes_to_body(axes, d3_of(y + RIGID_VEL_MPS));
  const double z_m = y[RIGID_POS_M + 2];
  for (int surface = TOUCH_FLOOR; surface <= TOUCH_CEILING; surface++) {
    if (!(surfaces & surface)) continue;
    const double side = surface == TOUCH_CEILING ? 1.0 : -1.0;
    const double room_m = surface == TOUCH_CEILING ? t->ceiling_m - z_m : z_m;
    d3_t point[POINTS];
    points_of(t, up, side, point);
    for (int i = 0; i < POINTS; i++) {
      const double depth_m = side * d3_dot(up, point[i]) - room_m;
      if (depth_m > 0.0) push(t, point[i], depth_m, d3_scale(-side, up), vel_b, rate_b, load);
    }
  }
}
