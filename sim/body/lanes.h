// lanes.h - eight vehicles, moved side by side by the code for one (body/forces.h, compiled for eight).
//
// Storage is lane beside lane: number i of vehicle k is at [LANES * i + k].
#ifndef SIM_BODY_LANES_H
#define SIM_BODY_LANES_H

#include "base/lane.h"
#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define LANES_EFFECTS 32 // FX_MAX
#define LANES_PARAMS  9  // FX_PARAM_MAX

typedef struct lanes lanes_t;

// Where the numbers of each struct of a vehicle are, in the struct's order; lanes_alike_t has the other
// members.
typedef struct {
  double *rigid, *touch, *plant, *push;
  double *excess[LANES_EFFECTS], *load[LANES_EFFECTS], *sense[LANES_EFFECTS],
      *tick[LANES_EFFECTS];    // parameters p of each
  double *untouched, *inertia; // what effects at ticks start from: a plant, and the vehicle file's inertia
  double *battery, *open_V;    // the members before and after its `n`
  double *sensed_from;
  double *now, *before; // y, charge, current, voltage at the tick's end and at its beginning
  double *look;
} lanes_at_t;

enum { LANES_CHARGE = 17, LANES_CURRENT_A, LANES_VBAT_V, LANES_NOW }; // after y

// What is known of each vehicle at the end of a tick.
typedef struct {
  double rotors_N[LANES], gap_m[LANES];
} lanes_seen_t;

// What is true at the beginning of a tick: position, velocity, attitude, rates, specific force, upward and
// downward range, in this order (sense/truth.h).
#define LANES_TRUTH 18
typedef struct {
  double *number;   // room for LANES_TRUTH rows of LANES
  unsigned motors;  // whether they turn, one bit per lane
  double up[LANES]; // cosine of the tilt
} lanes_truth_t;

// What all vehicles in the lanes have in common.
typedef struct {
  bool lag_in_speed, plain_lag, ticks, pushed, looked, loaded; // looked: `look` holds for y
  int excess_of, n_excess, n_load, n_sense, n_tick,
      n_open_V; // n_tick: 0 if bodies apply effects at ticks themselves
  int excess[LANES_EFFECTS], load[LANES_EFFECTS], sense[LANES_EFFECTS], tick[LANES_EFFECTS]; // in fx_table
  int excess_form[LANES_EFFECTS]; // in curve_table; -1: none
  double span_s;
} lanes_alike_t;

// How many numbers stand at the beginning of each struct for one vehicle; touch and plant have nothing else.
typedef struct {
  size_t rigid, touch, plant, look, battery;
} lanes_numbers_t;

// Present distance of the nearest point from floor and ceiling.
typedef struct {
  double floor_m[LANES], ceiling_m[LANES];
} lanes_gap_t;

// --- instants (body/points.h) -----------------------------------------------------------------------------

// Eight instants.
typedef struct {
  double y[LANES_CHARGE][LANES], command_N[4][LANES], vbat_V[LANES], t_s[LANES];
} lanes_instants_t;

// What a range sensor sees, and what perfect sensors read: specific force, angular acceleration, range.
typedef struct {
  double range_m[LANES], range_rate_mps[LANES];
} lanes_sight_t;
#define LANES_READINGS 7
typedef struct {
  double of[LANES_READINGS][LANES];
} lanes_readings_t;

// One more effect: its indices in fx_table and curve_table (-1: no form), and p.
typedef struct {
  int fx, form;
  double p[LANES_PARAMS];
} lanes_effect_t;

typedef struct {
  // Null if there is no memory, or a struct's numbers are not contiguous.
  lanes_t *(*open)(const lanes_numbers_t *numbers);
  void (*close)(lanes_t *l);
  const lanes_at_t *(*at)(const lanes_t *l);
  void (*set)(lanes_t *l, const lanes_alike_t *alike);
  // begin: selects the lanes `in` (one bit each). left: those that are still in. Lanes that have left since
  // begin(), because they differ too much from the others, must be moved alone.
  void (*begin)(unsigned in);
  unsigned (*left)(void);
  // Begins a tick: copies `now` to `before`. Returns the surfaces (TOUCH_*) that may be touched in it.
  int (*tick)(lanes_t *l);
  // The integrator's callback: dydt at state y, both RIGID_N * LANES. context: lanes_t.
  void (*derivative)(void *context, const double *y, double *dydt);
  void (*gap)(lanes_t *l, lanes_gap_t *gap);
  // Ends a tick: normalises the quaternions in `now`, looks at what acts there, and updates the battery.
  // Returns look.loaded.
  bool (*end)(lanes_t *l, lanes_seen_t *seen);
  // What perfect sensors, with the effects on sensors, read before the next tick.
  void (*sense)(lanes_t *l, lanes_truth_t *truth);
  // Looks at what acts at the instants; up: cosines of the tilt there. No surface may be near.
  void (*look)(lanes_t *l, const lanes_instants_t *at, double up[LANES]);
  // What sensors read at the instants of look().
  void (*read)(lanes_t *l, const lanes_sight_t *sight, lanes_readings_t *to);
  // Keeps the results of both, kept_bytes() bytes.
  size_t (*kept_bytes)(void);
  void (*keep)(const lanes_t *l, void *kept);
  // Both for a vehicle that differs from the one kept only in its effects at ticks, with the same thrusts.
  // moved: its rotors are in other places.
  void (*read_again)(lanes_t *l, const void *kept, bool moved, lanes_readings_t *to);
  // What sensors read with one more effect, on load, excess or sensors.
  void (*read_more)(lanes_t *l, const lanes_effect_t *more, const void *kept, lanes_readings_t *to);
} lanes_door_t;

// For registers of that many bits (lane_bits() of base/lane.h); the results have the same bits.
extern const lanes_door_t lanes_door_256, lanes_door_512;

#ifdef __cplusplus
}
#endif

#endif
