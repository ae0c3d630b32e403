// touch.h - contact of feet, body and blades with floor, ceiling and wall: springs, dampers and friction at
// points.
//
//   N = k d + c d' min(1, d / TOUCH_SOFT_M), not below 0;   friction = -min(g, mu N / |v_t|) v_t
//
// d: depth of the point in the surface, v_t: its velocity along the surface. Floor, ceiling and wall are
// half-spaces, so that nothing can tunnel: whatever is inside is pushed out. The floor goes through the
// origin and may slope; its normal is floor_up_w. The points are four feet, four corners of the body's top,
// and on each rotor disc the point that is nearest to the surface. Nothing sticks by itself: a vehicle stays
// at a ceiling as long as the ceiling effect makes its thrust larger than its weight.
#ifndef SIM_PLANT_TOUCH_H
#define SIM_PLANT_TOUCH_H

#include "plant/rigid.h"

#define TOUCH_SOFT_M  1e-5 // depth over which the damper sets in
#define TOUCH_LEVEL   0.02 // below about this tilt (rad) a disc touches with its inside, above with its edge
#define TOUCH_CORNERS 4
#define TOUCH_POINTS  12 // feet, corners, discs
#define TOUCH_FLOOR   1
#define TOUCH_CEILING 2
#define TOUCH_WALL    4
#define TOUCH_STEP_S  5e-4 // longest step at which the springs below are stable and settle
// Per kilogram of vehicle and per point. With these, a Crazyflie at rest is 8 um deep, and one that hits at
// 10 m/s goes less than 9 mm deep. Assumed; nothing that is measured depends on them.
#define TOUCH_SPRING   3e5   // N/m/kg
#define TOUCH_DAMPER   165.0 // N/(m/s)/kg
#define TOUCH_GRIP     150.0 // N/(m/s)/kg  friction at small speed
#define TOUCH_FRICTION 0.5   // mu

// Positions of the points relative to the centre of mass, body axes.
typedef struct {
  d3_t foot[TOUCH_CORNERS], top[TOUCH_CORNERS], disc[ROTORS];
  double disc_radius_m;
  double below_m, above_m, beside_m; // largest reach of any point, for a first, cheap test
  double lowest_m[3], highest_m[3];  // feet, top, discs
  double spring_Npm, damper_Nspm, grip_Nspm;
  double ceiling_m; // HUGE_VAL: none
  double wall_y_m;  // of a wall across y; the vehicle is on its side towards y = 0; HUGE_VAL: none
  d3_t floor_up_w;  // unit normal of the floor, z > 0; (0, 0, 1): level, at height 0
} touch_t;

typedef struct {
  double floor_m, ceiling_m, wall_m;
} touch_gap_t;

// Sets `below`, `above`, `beside`, `lowest` and `highest` from the points, and the springs from the mass.
void touch_init(touch_t *t, double mass_kg);

// The surfaces (TOUCH_*) to which a point may be nearer than margin_m. pos_w_m: the centre of mass.
int touch_near(const touch_t *t, d3_t pos_w_m, const axes_t *axes, double margin_m);

// The smallest distance of any point from each surface; negative if a point is inside.
touch_gap_t touch_gap(const touch_t *t, d3_t pos_w_m, const axes_t *axes);

// Distance of a position from the floor, along the floor's normal.
static inline double touch_above_floor_m(const touch_t *t, d3_t pos_w_m) {
  return d3_dot(t->floor_up_w, pos_w_m);
}

// Adds the contact forces and moments to `load`. surfaces: the TOUCH_* to consider.
void touch_load(const touch_t *t, int surfaces, const double y[RIGID_N], const axes_t *axes, load_t *load);

#endif
