// touch.c - contact of feet, body and blades with floor, ceiling and wall.
#include "plant/touch.h"

#include "base/where.h"

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

// A surface as seen from the centre of mass: the direction towards it (body axes, length 1), and the
// distance.
typedef struct {
  d3_t towards_b;
  double room_m;
} side_t;

static side_t floor_of(const touch_t *t, d3_t pos_w_m, const axes_t *axes) {
  return (side_t){d3_scale(-1.0, axes_to_body(axes, t->floor_up_w)), touch_above_floor_m(t, pos_w_m)};
}

static side_t ceiling_of(const touch_t *t, d3_t pos_w_m, const axes_t *axes) {
  return (side_t){axes_up_b(axes), t->ceiling_m - pos_w_m.z};
}

static side_t wall_of(const touch_t *t, d3_t pos_w_m, const axes_t *axes) {
  const double side = where(t->wall_y_m < 0.0, -1.0, 1.0);
  return (side_t){axes_to_body(axes, d3(0.0, side, 0.0)), side * (t->wall_y_m - pos_w_m.y)};
}

// True if a point of the vehicle may be nearer to the surface than margin_m.
static bool is_near(const touch_t *t, side_t side, double margin_m) {
  const d3_t to = side.towards_b;
  const double along_m = where(to.z > 0.0, to.z * t->above_m, -to.z * t->below_m);
  return side.room_m < along_m + t->beside_m * (fabs(to.x) + fabs(to.y)) + margin_m;
}

PAIR_COPIES int touch_near(const touch_t *t, d3_t pos_w_m, const axes_t *axes, double margin_m) {
  const bool wall = t->wall_y_m < HUGE_VAL && t->wall_y_m > -HUGE_VAL; // most vehicles have none
  return (is_near(t, floor_of(t, pos_w_m, axes), margin_m) ? TOUCH_FLOOR : 0) |
         (is_near(t, ceiling_of(t, pos_w_m, axes), margin_m) ? TOUCH_CEILING : 0) |
         (wall && is_near(t, wall_of(t, pos_w_m, axes), margin_m) ? TOUCH_WALL : 0);
}

// Factor by which the x and y of `to` lead from a disc's centre to its point that is nearest to the surface.
static double disc_reach_m(const touch_t *t, d3_t to) {
  return t->disc_radius_m / sqrt(to.x * to.x + to.y * to.y + TOUCH_LEVEL * TOUCH_LEVEL);
}

static d3_t point_of(const touch_t *t, int g, int i, d3_t to, double reach_m) {
  const d3_t p = group_of(t, g)[i];
  return g == DISCS ? d3_add(p, d3(reach_m * to.x, reach_m * to.y, 0.0)) : p;
}

// The gap between the surface and the point that is nearest to it.
static double left_m(const touch_t *t, side_t side) {
  const double reach_m = disc_reach_m(t, side.towards_b);
  double most_m = -HUGE_VAL;
  for (int g = 0; g < GROUPS; g++)
    for (int i = 0; i < 4; i++) {
      const double at_m = d3_dot(side.towards_b, point_of(t, g, i, side.towards_b, reach_m));
      most_m = where(at_m > most_m, at_m, most_m);
    }
  return side.room_m - most_m;
}

PAIR_COPIES touch_gap_t touch_gap(const touch_t *t, d3_t pos_w_m, const axes_t *axes) {
  return (touch_gap_t){left_m(t, floor_of(t, pos_w_m, axes)), left_m(t, ceiling_of(t, pos_w_m, axes)),
                       left_m(t, wall_of(t, pos_w_m, axes))};
}

// The surface that presses, and the body's motion.
typedef struct {
  d3_t n, vel_b, rate_b; // n: surface normal, towards the vehicle
} press_t;

// Adds the contact force at one point, where its depth_m in the surface is above 0.
static void push(const touch_t *t, const press_t *p, d3_t point, double depth_m, load_t *load) {
  const d3_t vel = d3_add(p->vel_b, d3_cross(p->rate_b, point));
  const double out_mps = d3_dot(vel, p->n);
  const double soft = where(depth_m < TOUCH_SOFT_M, depth_m / TOUCH_SOFT_M, 1.0);
  const double normal_N = t->spring_Npm * depth_m - t->damper_Nspm * soft * out_mps;
  if (!any_of(depth_m > 0.0 && normal_N > 0.0)) return;
  const d3_t along = d3_add_scaled(vel, -out_mps, p->n);
  const double speed = d3_norm(along), slip_N = TOUCH_FRICTION * normal_N;
  const double grip = where(t->grip_Nspm * speed > slip_N, slip_N / speed, t->grip_Nspm);
  const d3_t force = d3_sub(d3_scale(normal_N, p->n), d3_scale(grip, along));
  load_t pushed = *load;
  load_add(&pushed, force, d3_cross(point, force));
  load->force_b_N = D3_WHERE(depth_m > 0.0 && normal_N > 0.0, pushed.force_b_N, load->force_b_N);
  load->moment_b_Nm = D3_WHERE(depth_m > 0.0 && normal_N > 0.0, pushed.moment_b_Nm, load->moment_b_Nm);
}

// An upper bound of how far any point of the group lies towards the surface.
static double bound_m(const touch_t *t, int g, d3_t to) {
  return to.z * where(to.z > 0.0, t->highest_m[g], t->lowest_m[g]) + t->beside_m * (fabs(to.x) + fabs(to.y));
}

static void press(const touch_t *t, side_t side, const double y[RIGID_N], const axes_t *axes, load_t *load) {
  const d3_t to = side.towards_b;
  const press_t p = {d3_scale(-1.0, to), axes_to_body(axes, d3_of(y + RIGID_VEL_MPS)),
                     d3_of(y + RIGID_RATE_RADPS)};
  const double reach_m = disc_reach_m(t, to);
  for (int g = 0; g < GROUPS; g++) {
    const double bound = bound_m(t, g, to);
    if (!any_of(bound > side.room_m)) continue;
    for (int i = 0; i < 4; i++) {
      const d3_t point = point_of(t, g, i, to, reach_m);
      const double depth_m = where(bound > side.room_m, d3_dot(to, point) - side.room_m, -1.0);
      if (any_of(depth_m > 0.0)) push(t, &p, point, depth_m, load);
    }
  }
}

PAIR_COPIES void touch_load(const touch_t *t, int surfaces, const double y[RIGID_N], const axes_t *axes,
                            load_t *load) {
  const d3_t pos_w_m = d3_of(y + RIGID_POS_M);
  if (surfaces & TOUCH_FLOOR) press(t, floor_of(t, pos_w_m, axes), y, axes, load);
  if (surfaces & TOUCH_CEILING) press(t, ceiling_of(t, pos_w_m, axes), y, axes, load);
  if (surfaces & TOUCH_WALL) press(t, wall_of(t, pos_w_m, axes), y, axes, load);
}
