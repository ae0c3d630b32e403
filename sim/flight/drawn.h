// drawn.h - what one flight's vehicle, sensors and air are: what a level of noise lets differ from flight to
// flight (`vary`, sense/noise.h), drawn from the flight's seed. The controller is told none of it.
//
// Each number is drawn always, whatever its width, and from a stream of its own: a row that is changed moves
// no other row, and the noise of the sensors is that of the same seed without draws.
#ifndef SIM_FLIGHT_DRAWN_H
#define SIM_FLIGHT_DRAWN_H

#include "base/error.h"
#include "sense/noise.h"
#include "vehicle/model.h"
#include <stdint.h>

typedef struct {
  double gust_mps2, gust_tau_s; // sd of the force over the mass, each axis
  // Shares by which it is more (or less) than the vehicle file says; rotor: of rotor_number (1..4) besides.
  double mass, thrust, rotor, rotor_number, lag;
  double delay_s; // of commands, besides
  d3_t acc_bias_b_mps2;
  double up_scale, up_offset_m, down_scale, down_offset_m;
  double curve_a, curve_b; // shares: of what the ceiling adds, and of how fast that falls
  double top_m;            // the body's top, from where the vehicle file has it
  double mount_x_rad, mount_y_rad;
} drawn_t;

typedef struct {
  const char *name; // key in a flight's JSON
  size_t offset;    // of the number in drawn_t
  bool which;       // it says of which, not how much
} drawn_field_t;

extern const drawn_field_t drawn_fields[];
extern const int drawn_field_count;

// FAILED: no memory.
MUST_CHECK done_t drawn_of(const vary_t *vary, uint64_t seed, drawn_t *drawn, why_t *why);

double drawn_get(const drawn_t *drawn, const drawn_field_t *field);

// Adds it to what the level says of the sensors.
void drawn_sense(const drawn_t *drawn, noise_t *noise);

// Makes a vehicle file's model this flight's. A wind that has gusts keeps its own. BAD_INPUT: so many effects
// that there is no room for the gusts.
MUST_CHECK done_t drawn_vehicle(const drawn_t *drawn, model_t *model, why_t *why);

#endif
