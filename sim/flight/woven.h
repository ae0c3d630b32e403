// woven.h - flights in lanes: their numbers in and out, and what one of them does again alone.
#ifndef SIM_FLIGHT_WOVEN_H
#define SIM_FLIGHT_WOVEN_H

#include "crazyflie/crazyflie.h"
#include "flight/loop_parts.h"
#include "flight/weave.h"

typedef struct {
  lanes_state_t *state;
  // Parts of blocks that go in and out every millisecond, tick or sample.
  weave_t drawn_more, set, moved;      // in
  weave_t noise_of_imu;                // drawn in lanes, but for who is by itself
  weave_t felt;                        // out: what is measured and estimated of pilot_in_t
  weave_t now, range_begin, range_end; // of an app and of its range sensors, since some milliseconds
  weave_t curve, learned, guard;       // what pilot_t.tell() speaks of
  weave_t ranges;                      // in: besides, of whom sensed alone
  weave_t looked;                      // out: what of an app those look at who stand around
} woven_t;

// False: the processor cannot do it, or there is no memory.
bool woven_open(woven_t *w);
void woven_close(woven_t *w);

// `looked` is that from here on.
void woven_look(woven_t *w, const pilot_around_t *around);
// What of it has changed.
void woven_get_looked(woven_t *w, void *const app[LANES]);

// Lane k is that flight's from here on, and its vehicle's; and no more.
void woven_begin_flight(woven_t *w, int k, flight_loop_t *f);
void woven_begin_vehicle(woven_t *w, int k, crazyflie_t *c);
void woven_end_senses(woven_t *w, int k, flight_loop_t *f);
void woven_end_vehicle(woven_t *w, int k, crazyflie_t *c);

// A block (lanes_blocks.h) of a lane, and a part of one; of all lanes at once.
void woven_put(woven_t *w, int block, int k, void *one);
void woven_get(woven_t *w, int block, int k, void *one);
void woven_put_part(woven_t *w, const weave_t *part, int k, const void *one);
void woven_get_part(woven_t *w, const weave_t *part, int k, void *one);
// IMU_DRAWN rows of LANES numbers; what motors are commanded, PILOT_MOTORS rows; that which was applied, and
// what came of it, as pilot_in_t has them from applied_N on.
double *woven_noise_of_imu(woven_t *w);
double *woven_motors(woven_t *w);
double *woven_moved(woven_t *w);
void woven_put_all(woven_t *w, const weave_t *part, void *const one[LANES]);
void woven_get_all(woven_t *w, const weave_t *part, void *const one[LANES]);

// Another set point of that flight.
void woven_set(woven_t *w, int k, const pilot_in_t *in);

// Its state comes here, and goes back after it was changed.
void woven_vehicle_home(woven_t *w, int k, flight_loop_t *f);
void woven_vehicle_back(woven_t *w, int k, flight_loop_t *f);
void woven_senses_back(woven_t *w, int k, flight_loop_t *f);
// What was sensed of it alone its pilot gets in the lane.
void woven_tell_sensed(woven_t *w, int k, const flight_loop_t *f);

// The milliseconds since the last copy, again, by the code of one vehicle: who parted from the others. Its
// state is here then.
void woven_sense_alone(woven_t *w, int k, flight_loop_t *f);
void woven_pilot_alone(woven_t *w, int k, flight_loop_t *f);

#endif
