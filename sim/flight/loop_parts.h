// loop_parts.h - a flight tick by tick: for one who sets the pace, and for those who fly several at once
// (flight/together.h).
#ifndef SIM_FLIGHT_LOOP_PARTS_H
#define SIM_FLIGHT_LOOP_PARTS_H

#include "flight/over.h"
#include "flight/plan.h"
#include "flight/record.h"
#include "flight/senses.h"

#define LOOP_TICK_S 0.002

// Not for callers but those.
typedef struct flight_loop {
  const plan_t *plan;
  const model_t *model; // `own`
  model_t own;          // this flight's: as drawn, on the vertical axis a point
  noise_t noise;        // so are the sensors
  const pilot_t *pilot;
  body_t body;
  random_t *random;
  senses_t senses;
  mocap_t mocap;
  vertical_t vertical;
  pilot_in_t in;
  bool ordered; // in.set is another in this tick
  double motor_N[PILOT_MOTORS];
  double up_min, gap_min_m, range_m; // up_min: smallest cosine of the tilt since the last sample
  bool range_new;
  int way;
  double order_s;     // until then no other order is due
  double ceiling_z_m; // as the pilot thinks it, at the last sample
  long tick;
  int every; // ticks a sample
  truth_t truth;
  thoughts_t thoughts;
} flight_loop_t;

// Sensors, estimator and pilot of a tick; FLIGHT_FLIES: then the vehicle is to be moved. *seen is set where a
// sample is due, and good until the next call.
flight_over_t loop_tick(flight_loop_t *loop, tick_t *seen, bool *is_sample);
void loop_move(flight_loop_t *loop);

// --- the same in parts -------------------------------------------------------------------------------------

double loop_tick_s(const flight_loop_t *f);

// Set points, and what is true at a tick's start. FLIGHT_FLIES: then two milliseconds come, each with its
// noise, what was seen upwards in it, and the pilot.
flight_over_t loop_tick_order(flight_loop_t *f);
void loop_see_truth(flight_loop_t *f);
void loop_draw(flight_loop_t *f, const truth_t *truth, senses_drawn_t *drawn);
void loop_draw_more(flight_loop_t *f, const truth_t *truth, senses_drawn_t *drawn); // but imu's
void loop_note_range(flight_loop_t *f);
void loop_pilot(flight_loop_t *f);

// Then a sample, where one is due; good until the next.
bool loop_is_sample(const flight_loop_t *f);
tick_t loop_look(flight_loop_t *f);

// When the body has moved: what its rotors give, its battery's voltage, and how near it is to the ceiling.
void loop_moved(flight_loop_t *f, double rotors_N, double vbat_V, double gap_m);

// All of it, alone.
MUST_CHECK done_t loop_run(flight_loop_t *f, record_t *record, bool *finite, why_t *why);

#endif
