// nominal_pilot.h - a nominal flight, and the pilot that flies it. Within sim/gap only.
#ifndef SIM_GAP_3_FEEDBACK_NOMINAL_PILOT_H
#define SIM_GAP_3_FEEDBACK_NOMINAL_PILOT_H

#include "gap/3_feedback/nominal.h"

// The track's acceleration is a difference over this on both sides; a mean over as much is without noise.
#define AHEAD_S 0.1

// What a step leaves of an error by axis, and the sd of what comes anew.
typedef struct {
  double keep[3], fresh[3];
} decay_t;

typedef struct {
  const grid_t *g;
  const model_t *m;
  closed_loop_t own; // as the log was flown, as far as this pilot can
  const closed_loop_t *w;
  double level, push; // 1/s: position errors to velocity, velocity errors to acceleration, level
  body_t body;
  random_t *random, *shakes; // of what is seen, and of what disturbs
  d3_t gust_w_N, quick_w_N, disturbs_b_Nm;
  gap_flight_t *log, *truth;                  // truth: what a log without errors would say; may be null
  int from, to, at;                           // points of the track
  d3_t pos_off_m, vel_off_mps, angle_off_rad; // errors that last
  d3_t turn_trim_radps2;                      // what holds it level, for a thrust of its weight
  double lift_trim;                           // thrust over weight that holds it
  grid_point_t is, seen;                      // now, as far as a log or a pilot asks
  grid_point_t track;                         // where it is to be now
  d3_t bent_mps2, bent_radps2;                // acceleration of the track there, and of its turning
  d3_t bends_mps2[2], bends_radps2[2];        // at the point before and the one behind,
  int bends_at;                               // which is this one
  d3_t rate_before_radps;                     // seen at the last command; NaN: at none yet
  d3_t turn_slow_radps2;                      // commands as slower motors follow them
  double load_slow, call_s, quick;            // quick: the share of the way that they go from call to call
  double due_s, outer_due_s;                  // until the next command, and the next look at place and speed
  d3_t acc_mps2;                              // wanted since the last look, with what carries the weight
  unsigned long seed;
  // Of what lasts, over a step.
  decay_t pos_keeps, vel_keeps, angle_keeps, force_keeps, quick_keeps, turn_keeps;
  double down_s, masked_to_s; // in contact since it was put on its track; of the log
  int puts;                   // how often it was put back
  struct known *known;        // who flew, where the vehicle file says so (nominal_known.h); else null
} nominal_flight_t;

// At a new point of the track, before anything is commanded there.
void pilot_look_ahead(nominal_flight_t *f);
// This share of the way to the next point, where no gap in time lies between: a pilot is told more often than
// a point comes. What it is told by steps, it commands by steps, and a log of its commands misses none.
void pilot_take_track(nominal_flight_t *f, double share);
bool pilot_goes_on(const nominal_flight_t *f);

// Commands that bring the vehicle, as it is seen, to its track.
void pilot_steer(nominal_flight_t *f, double step_s, const grid_point_t *track, const grid_point_t *seen,
                 double motor_N[ROTORS]);

// What a change of the wanted turning or thrust is commanded by more than it is, for motors that are slow.
double pilot_motor_lead(double motor_tau_s);

// Between two commands, where that is known of who flew; else 0: it commands whenever it is asked.
double pilot_period_s(const flown_by_t *by);

// The largest rate gain, 1/s, with which a cascade does not ring: of motors of that lag, and commands that
// are so late and come so seldom; more often than a nominal flight has steps they never come.
double pilot_gain_most(double motor_tau_s, double delay_s, double period_s);

// Gains that do not ring with the body's lag.
void pilot_tame(nominal_flight_t *f);

// Finds what holds the body level, and gives it that.
void pilot_trim(nominal_flight_t *f);

// The signals that the log of grid g has, with room for so many samples. Motors are newton. False: no memory.
bool nominal_log_room(gap_flight_t *log, const grid_t *g, size_t n);

// One sample more, with what is seen (or is true) at it.
void nominal_log_write(const nominal_flight_t *f, gap_flight_t *log, const grid_point_t *p,
                       const double motor_N[ROTORS], double t_s);

#endif
