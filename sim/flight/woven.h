// woven.h - copies flights into lanes and out, and repeats alone the milliseconds of one that parted.
#ifndef SIM_FLIGHT_WOVEN_H
#define SIM_FLIGHT_WOVEN_H

#include "crazyflie/crazyflie.h"
#include "flight/loop_parts.h"
#include "flight/weave.h"

typedef struct {
  lanes_state_t *state;
  // Parts of blocks that are copied every millisecond, tick or sample.
  weave_t drawn_more, set, moved; // in
  weave_t noise_of_imu;           // drawn in lanes; out: of a flight that senses by itself
  weave_t felt;                   // out: measurements and estimate in pilot_in_t; in: where it sensed alone
  weave_t now, range_begin, range_end; // of the last copy of an app and of its range sensors
  weave_t curve, learned, guard;       // out: what pilot_t.tell() reports
  weave_t ranges;                      // in: range readings of a flight that sensed alone
  weave_t looked;                      // out: what pilot_around_t looks at in an app
} woven_t;

// False: the processor cannot do it, or there is no memory.
bool woven_open(woven_t *w);
void woven_close(woven_t *w);

// Sets `looked` to what `around` looks at.
void woven_look(woven_t *w, const pilot_around_t *around);
// Copies out what of it has changed since the last time.
void woven_get_looked(woven_t *w, void *const app[LANES]);

// Put a flight and its vehicle into lane k, and take its senses and its vehicle out again.
void woven_begin_flight(woven_t *w, int k, flight_loop_t *f);
void woven_begin_vehicle(woven_t *w, int k, crazyflie_t *c);
void woven_end_senses(woven_t *w, int k, flight_loop_t *f);
void woven_end_vehicle(woven_t *w, int k, crazyflie_t *c);

// Copy a block (lanes_blocks.h), or a part of one, into lane k (put) or out of it (get).
void woven_put(woven_t *w, int block, int k, void *one);
void woven_get(woven_t *w, int block, int k, void *one);
void woven_put_part(woven_t *w, const weave_t *part, int k, const void *one);
void woven_get_part(woven_t *w, const weave_t *part, int k, void *one);
// Return where rows of LANES numbers lie: IMU_DRAWN rows of noise; PILOT_MOTORS rows of motor commands; the
// rows of pilot_in_t from applied_N on (what was applied, and what came of it).
double *woven_noise_of_imu(woven_t *w);
double *woven_motors(woven_t *w);
double *woven_moved(woven_t *w);
// Copy a part of a block into all lanes or out of them.
void woven_put_all(woven_t *w, const weave_t *part, void *const one[LANES]);
void woven_get_all(woven_t *w, const weave_t *part, void *const one[LANES]);

// Copies a changed set point of that flight in.
void woven_set(woven_t *w, int k, const pilot_in_t *in);

// Copy its state out of lane k, and back in after it has changed.
void woven_vehicle_home(woven_t *w, int k, flight_loop_t *f);
void woven_vehicle_back(woven_t *w, int k, flight_loop_t *f);
void woven_senses_back(woven_t *w, int k, flight_loop_t *f);
// Gives the pilot in lane k what the flight sensed alone.
void woven_tell_sensed(woven_t *w, int k, const flight_loop_t *f);

// Repeat the milliseconds since the last copy by the code of one vehicle, for a flight that parted from the
// others. Its state is then in *f.
void woven_sense_alone(woven_t *w, int k, flight_loop_t *f);
void woven_pilot_alone(woven_t *w, int k, flight_loop_t *f);

#endif
