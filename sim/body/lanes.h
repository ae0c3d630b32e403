// lanes.h - eight vehicles, moved side by side by what moves one (body/forces.h, compiled for eight numbers).
//
// Numbers lie lane beside lane: number i of vehicle k is at [LANES * i + k].
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

// Where the numbers of a struct of one vehicle go, in its order; the other members stand in lanes_alike_t.
typedef struct {
  double *rigid, *touch, *plant, *push;
  double *excess[LANES_EFFECTS], *load[LANES_EFFECTS], *sense[LANES_EFFECTS],
      *tick[LANES_EFFECTS];    // p of each
  double *untouched, *inertia; // what effects at ticks begin with: a plant, and the vehicle file's inertia
  double *battery, *open_V;    // before and behind its `n`
  double *sensed_from;
  double *now, *before; // y, charge, current, voltage: at the tick's end, and at its begin
  double *look;
} lanes_at_t;

enum { LANES_CHARGE = 17, LANES_CURRENT_A, LANES_VBAT_V, LANES_NOW }; // behind y

// What is known of each at the end of a tick.
typedef struct {
  double rotors_N[LANES], gap_m[LANES];
} lanes_seen_t;

// What is true at a tick's begin: place, velocity, attitude, rates, specific force, upward and downward
// range, in this order (sense/truth.h).
#define LANES_TRUTH 18
typedef struct {
  double *number;   // room for so many rows of LANES
  unsigned motors;  // whether they turn, a bit each
  double up[LANES]; // cosine of the tilt
} lanes_truth_t;

// What is one and the same for all of them.
typedef struct {
  bool lag_in_speed, plain_lag, ticks, pushed, looked, loaded; // looked: `look` is of y
  int excess_of, n_excess, n_load, n_sense, n_tick,
      n_open_V; // n_tick: 0 where bodies act at ticks themselves
  int excess[LANES_EFFECTS], load[LANES_EFFECTS], sense[LANES_EFFECTS], tick[LANES_EFFECTS]; // in fx_table
  int excess_form[LANES_EFFECTS]; // in curve_table; -1: none
  double span_s;
} lanes_alike_t;

// How many numbers each struct begins with for one vehicle; of touch and plant that is all.
typedef struct {
  size_t rigid, touch, plant, look, battery;
} lanes_numbers_t;

// How far the point that is nearest is from floor and ceiling, now.
typedef struct {
  double floor_m[LANES], ceiling_m[LANES];
} lanes_gap_t;

// --- instants (body/points.h) -----------------------------------------------------------------------------

// Eight of them.
typedef struct {
  double y[LANES_CHARGE][LANES], command_N[4][LANES], vbat_V[LANES], t_s[LANES];
} lanes_instants_t;

// What a range sensor has in sight, and what perfect sensors read: specific force, turning, range.
typedef struct {
  double range_m[LANES], range_rate_mps[LANES];
} lanes_sight_t;
#define LANES_READINGS 7
typedef struct {
  double of[LANES_READINGS][LANES];
} lanes_readings_t;

// One effect more: its numbers in fx_table and curve_table (-1: no form), and p.
typedef struct {
  int fx, form;
  double p[LANES_PARAMS];
} lanes_effect_t;

typedef struct {
  // Null: no memory, or a struct whose numbers do not lie one behind the other.
  lanes_t *(*open)(const lanes_numbers_t *numbers);
  void (*close)(lanes_t *l);
  const lanes_at_t *(*at)(const lanes_t *l);
  void (*set)(lanes_t *l, const lanes_alike_t *alike);
  // From here on the lanes `in` (a bit each) count. What of them had to leave since begin(), because they
  // differ too much from the others, is to be moved alone: those that are still in.
  void (*begin)(unsigned in);
  unsigned (*left)(void);
  // A tick begins: what is now is what was before. The surfaces (TOUCH_*) that may be touched in it.
  int (*tick)(lanes_t *l);
  // For the integrator: dydt at state y, both RIGID_N * LANES. context: lanes_t.
  void (*derivative)(void *context, const double *y, double *dydt);
  void (*gap)(lanes_t *l, lanes_gap_t *gap);
  // The quaternions in `now` are brought back to unit length, and what acts there is looked at; battery.
  // Whether look.loaded.
  bool (*end)(lanes_t *l, lanes_seen_t *seen);
  // Before the next tick: what perfect sensors with their effects read.
  void (*sense)(lanes_t *l, lanes_truth_t *truth);
  // What acts at instants, and the cosines of the tilt there. No surface is near.
  void (*look)(lanes_t *l, const lanes_instants_t *at, double up[LANES]);
  // What is read where look() has looked.
  void (*read)(lanes_t *l, const lanes_sight_t *sight, lanes_readings_t *to);
  // Keeps both: so many bytes.
  size_t (*kept_bytes)(void);
  void (*keep)(const lanes_t *l, void *kept);
  // Both, of a vehicle with other effects at ticks than the one of which it was kept; the motors did the
  // same. moved: its rotors are elsewhere.
  void (*read_again)(lanes_t *l, const void *kept, bool moved, lanes_readings_t *to);
  // What is read with an effect more that adds to load or excess, or that acts on sensors.
  void (*read_more)(lanes_t *l, const lanes_effect_t *more, const void *kept, lanes_readings_t *to);
} lanes_door_t;

// By registers of so many bits (lane_bits() of base/lane.h); the same bits come out.
extern const lanes_door_t lanes_door_256, lanes_door_512;

#ifdef __cplusplus
}
#endif

#endif
