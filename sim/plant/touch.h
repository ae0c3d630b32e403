// touch.h - contact of feet, body and blades with floor and ceiling: springs, dampers, friction at points.
//
//   N = k d + c d' min(1, d / TOUCH_SOFT_M), not below 0;   friction = -min(g, mu N / |v_t|) v_t
//
// d: how deep the point is inside the surface, v_t: its velocity along it. Floor, ceiling and wall are
// half-spaces, so that nothing can tunnel: whatever is inside is pushed out. The floor may slope: it goes
// through the origin, with the normal floor_up_w. The points are four feet, four corners of the
// body's top, and of each rotor disc the one that is nearest to the surface. Nothing sticks by itself: a
// vehicle stays at a ceiling as long as the ceiling effect makes its thrust larger than its weight.
#ifndef SIM_PLANT_TOUCH_H
#define SIM_PLANT_TOUCH_H

#include "plant/rigid.h"

#define TOUCH_SOFT_M  1e-5 // the damper comes in over this depth
#define TOUCH_LEVEL   0.02 // below about this tilt (rad) a disc touches with its inside, above with its edge
#define TOUCH_CORNERS 4
#define TOUCH_POINTS  12 // feet, corners, discs
#define TOUCH_FLOOR   1
#define TOUCH_CEILING 2
#define TOUCH_WALL    4
#define TOUCH_STEP_S  5e-4 // longest step at which the springs below are stable and settle
// Per kilogram of vehicle and point: with these, a Crazyflie at rest is 8 um deep, and hitting at 10 m/s
// goes less than 9 mm deep. Assumptions; nothing that is measured depends on them.
#define TOUCH_SPRING   3e5   // N/m/kg
#define TOUCH_DAMPER   165.0 // N/(m/s)/kg
#define TOUCH_GRIP     150.0 // N/(m/s)/kg  friction at small speed
#define TOUCH_FRICTION 0.5   // mu

// Points from the centre of mass, body axes.
typedef struct {
  d3_t foot[TOUCH_CORNERS], top[TOUCH_CORNERS], disc[ROTORS];
  double disc_radius_m;
  double below_m, above_m, beside_m; // how far any point reaches: for a first, cheap look
  double lowest_m[3], highest_m[3];  // feet, top, discs
  double spring_Npm, damper_Nspm, grip_Nspm;
  double ceiling_m; // HUGE_VAL: none
  double wall_y_m;  // of a wall across y, on whose side towards y = 0 the vehicle is; HUGE_VAL: none
  d3_t floor_up_w;  // of length 1, z > 0; straight up: level at height 0
} touch_t;

typedef struct {
  double floor_m, ceiling_m, wall_m;
} touch_gap_t;

// Sets `below`, `above`, `beside`, `lowest` and `highest` from the points, and springs from the mass.
void touch_init(touch_t *t, double mass_kg);

// The surfaces (TOUCH_*) that a point may be nearer to than margin_m; pos_w_m: of the centre of mass.
int touch_near(const touch_t *t, d3_t pos_w_m, const axes_t *axes, double margin_m);

// Smallest distance of any point from each surface; below 0: inside.
touch_gap_t touch_gap(const touch_t *t, d3_t pos_w_m, const axes_t *axes);

// How far a place lies above the floor, along its normal.
static inline double touch_above_floor_m(const touch_t *t, d3_t pos_w_m) {
  return d3_dot(t->floor_up_w, pos_w_m);
}

// Adds what the surfaces do to the body. surfaces: TOUCH_* that are to be looked at.
void touch_load(const touch_t *t, int surfaces, const double y[RIGID_N], const axes_t *axes, load_t *load);

#endif
