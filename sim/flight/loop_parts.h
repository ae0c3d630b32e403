// loop_parts.h - a flight tick by tick: for callers that set the pace, and for flying several at once
// (flight/together.h).
#ifndef SIM_FLIGHT_LOOP_PARTS_H
#define SIM_FLIGHT_LOOP_PARTS_H

#include "flight/over.h"
#include "flight/plan.h"
#include "flight/record.h"
#include "flight/senses.h"

#define LOOP_TICK_S 0.002

// For these callers only.
typedef struct flight_loop {
  const plan_t *plan;
  const model_t *model; // points to `own`
  model_t own;          // this flight's: with random deviations; on the vertical axis a point
  noise_t noise;        // of this flight's sensors: with random deviations
  const pilot_t *pilot;
  body_t body;
  random_t *random;
  senses_t senses;
  mocap_t mocap;
  vertical_t vertical;
  pilot_in_t in;
  bool ordered; // in.set changed in this tick
  double motor_N[PILOT_MOTORS];
  double up_min, gap_min_m, range_m; // up_min: smallest cosine of the tilt since the last sample
  bool range_new;
  int way;
  double order_s;     // before this time no other set point is due
  double ceiling_z_m; // as the pilot estimated it at the last sample
  long tick;
  int every; // ticks per sample
  truth_t truth;
  thoughts_t thoughts;
} flight_loop_t;

// Runs sensors, estimator and pilot of a tick. After FLIGHT_FLIES the vehicle is to be moved (loop_move).
// *seen is set where a sample is due, and valid until the next call.
flight_over_t loop_tick(flight_loop_t *loop, tick_t *seen, bool *is_sample);
void loop_move(flight_loop_t *loop);

// --- the same in parts -------------------------------------------------------------------------------------

double loop_tick_s(const flight_loop_t *f);

// Update the set point, and take what is true at the tick's start. After FLIGHT_FLIES two milliseconds
// follow, each with its noise drawn, a new upward range noted, and the pilot called.
flight_over_t loop_tick_order(flight_loop_t *f);
void loop_see_truth(flight_loop_t *f);
void loop_draw(flight_loop_t *f, const truth_t *truth, senses_drawn_t *drawn);
void loop_draw_more(flight_loop_t *f, const truth_t *truth, senses_drawn_t *drawn); // all but the IMU's
void loop_note_range(flight_loop_t *f);
void loop_pilot(flight_loop_t *f);

// Then take a sample, where one is due; it is valid until the next.
bool loop_is_sample(const flight_loop_t *f);
tick_t loop_look(flight_loop_t *f);

// Call when the body has moved. rotors_N: of all rotors, in free air; gap_m: of the nearest rotor.
void loop_moved(flight_loop_t *f, double rotors_N, double vbat_V, double gap_m);

// Flies the whole flight, alone. FAILED: no memory.
MUST_CHECK done_t loop_run(flight_loop_t *f, record_t *record, bool *finite, why_t *why);

#endif
