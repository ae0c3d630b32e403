// nominal_pilot.h - a nominal flight, and the pilot that flies it. Within sim/gap only.
#ifndef SIM_GAP_3_FEEDBACK_NOMINAL_PILOT_H
#define SIM_GAP_3_FEEDBACK_NOMINAL_PILOT_H

#include "gap/3_feedback/nominal.h"

// s: the track's acceleration is a difference over this time on both sides; a mean over as much is free of
// noise.
#define AHEAD_S 0.1

// What is left of an error after a step, by axis, and the sd of what the step adds.
typedef struct {
  double keep[3], fresh[3];
} decay_t;

// Means over the steps of a row so far.
typedef struct {
  grid_point_t seen, is;
  double motor_N[ROTORS];
  bool touches; // floor or ceiling
} nominal_row_t;

typedef struct {
  const grid_t *g;
  const model_t *m;
  closed_loop_t own; // as the log was flown, as far as this pilot can without ringing
  const closed_loop_t *w;
  double level, push; // 1/s, horizontal: position error to velocity, velocity error to acceleration
  body_t body;
  random_t *random, *shakes; // for what is seen, and for what disturbs
  d3_t gust_w_N, quick_w_N, disturbs_b_Nm;
  d3_t new_b_Nm;             // sd of the moment that is new at each step
  gap_flight_t *log, *truth; // truth: the log without errors; may be null
  int steps;                 // of a row
  nominal_row_t row;         // in a log of means: the present one
  double loud;               // white noise of a step over that of a row: rows that are means have less
  int from, to, at;          // points of the track: the first, behind the last, now
  d3_t pos_off_m, vel_off_mps, angle_off_rad; // lasting errors
  d3_t turn_trim_radps2;                      // what holds it level, at a thrust of its weight
  double lift_trim;                           // thrust over weight that carries it
  grid_point_t is, seen;                      // now, true and seen, as far as log and pilot ask
  grid_point_t track;                         // where it should be now
  d3_t bent_mps2, bent_radps2;                // acceleration and angular acceleration of the track there
  d3_t bends_mps2[2], bends_radps2[2];        // the same at point `at`, and at the next one,
  int bends_at;                               // whose number this is
  d3_t rate_before_radps;                     // seen at the last command; NaN: none yet
  d3_t turn_slow_radps2;                      // the commanded turning as slower motors follow it
  double load_slow, call_s, quick; // thrust likewise; s between calls; share of the way that both go per call
  double due_s, outer_due_s;       // s, to the next command, and to the next look at place and speed
  d3_t acc_mps2;                   // wanted since the last look, including what carries the weight
  unsigned long seed;
  // Decays per step of what lasts.
  decay_t pos_keeps, vel_keeps, angle_keeps, force_keeps, quick_keeps, turn_keeps;
  double down_s, masked_to_s; // s: in contact since it was put on its track; log time when the mask ends
  int puts;                   // how often it was put back
  struct known *known;        // the pilot that the vehicle file names (nominal_known.h), else null
} nominal_flight_t;

// Takes a new point of the track; call it before anything is commanded there.
void pilot_look_ahead(nominal_flight_t *f);
// Moves the wanted state this share of the way to the next point, unless a gap in time lies between. A pilot
// is called more often than points come. Told its track in steps, it would command in steps, and a log of its
// commands would miss none.
void pilot_take_track(nominal_flight_t *f, double share);
bool pilot_goes_on(const nominal_flight_t *f);

// Sets the commands that bring the vehicle, as it is seen, to its track.
void pilot_steer(nominal_flight_t *f, double step_s, const grid_point_t *track, const grid_point_t *seen,
                 double motor_N[ROTORS]);

// Returns the lead for slow motors: how many times a change of the wanted turning or thrust is added to it.
double pilot_motor_lead(double motor_tau_s);

// Returns the s between two commands of who flew; 0: not known, and it commands whenever it is asked.
double pilot_period_s(const flown_by_t *by);

// Returns the largest rate gain, 1/s, with which a cascade does not ring, for motors of that lag and commands
// that are delay_s late and period_s apart, or a step of a nominal flight if that is longer.
double pilot_gain_most(double motor_tau_s, double delay_s, double period_s);

// Limits the gains to those that do not ring with the body's lag.
void pilot_tame(nominal_flight_t *f);

// Finds the thrust and the turning that hold the body level, and sets its motors to them.
void pilot_trim(nominal_flight_t *f);

// Makes a log of the signals that the log of grid g has, motors in newton, with room for n samples. False: no
// memory.
bool nominal_log_room(gap_flight_t *log, const grid_t *g, size_t n);

// Logs a step of a row that begins at t_s: the state that is seen (and, in the other log, is true) before it,
// and its commands. A row has what its first step has or, in a log of means, the means over all its steps.
void nominal_log_step(nominal_flight_t *f, const double motor_N[ROTORS], int step, double t_s, double step_s);

#endif
