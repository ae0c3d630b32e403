// drawn.h - random deviations of one flight's vehicle, sensors and air: what a level of noise lets differ
// from flight to flight (`vary`, sense/noise.h), drawn from the flight's seed. The controller is told none of
// them.
//
// All numbers are drawn in every flight, whatever their width, from a random stream that nothing else uses.
// So a changed row moves no other row, and the sensors' noise is that of the same seed without draws.
#ifndef SIM_FLIGHT_DRAWN_H
#define SIM_FLIGHT_DRAWN_H

#include "base/error.h"
#include "sense/noise.h"
#include "vehicle/model.h"
#include <stdint.h>

typedef struct {
  double gust_mps2, gust_tau_s; // sd of the gusts' force over the mass, each axis; correlation time
  // Relative deviations from the vehicle file; rotor: additional, of the thrust of rotor_number (1..4) alone.
  double mass, thrust, rotor, rotor_number, lag;
  double delay_s; // of commands, added to the vehicle's
  d3_t acc_bias_b_mps2;
  double up_scale, up_offset_m, down_scale, down_offset_m;
  double curve_a, curve_b; // relative: what the ceiling adds; how fast that falls with distance
  double top_m;            // height of the body's top, relative to the vehicle file
  double mount_x_rad, mount_y_rad;
} drawn_t;

typedef struct {
  const char *name; // key in a flight's JSON
  size_t offset;    // of the number in drawn_t
  bool which;       // an index (rotor_number), not an amount
} drawn_field_t;

extern const drawn_field_t drawn_fields[];
extern const int drawn_field_count;

// Draws the deviations of this seed. FAILED: no memory.
MUST_CHECK done_t drawn_of(const vary_t *vary, uint64_t seed, drawn_t *drawn, why_t *why);

double drawn_get(const drawn_t *drawn, const drawn_field_t *field);

// Adds the sensors' deviations to the level's errors.
void drawn_sense(const drawn_t *drawn, noise_t *noise);

// Turns a vehicle file's model into this flight's. An effect `wind` that has gusts keeps its own. BAD_INPUT:
// so many effects that there is no room for the gusts.
MUST_CHECK done_t drawn_vehicle(const drawn_t *drawn, model_t *model, why_t *why);

#endif
