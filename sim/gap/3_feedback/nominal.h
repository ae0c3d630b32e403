// nominal.h - flights in which nothing is hidden: the model itself, in closed loop along a log's own track,
// through the same sensors, rates and noise. What the workflow sees in them is what feedback and noise alone
// produce.
//
// The pilot is the one that the vehicle file names ([controller], nominal_known.h), else a cascade of
// proportional loops whose gains are fitted to the log: moments on rates and attitude, thrust on climb and
// height; what turns it by how much the log's vehicle turns, if that is swifter (swiftness.c); with as much
// lead on the rates as makes its commands as noisy as the log's. Noise and disturbance are those of the log:
// sensors by what two successive samples differ by, disturbing forces (gusts.h) and moments, first-order
// Gauss-Markov, by what the residual has beyond that.
#ifndef SIM_GAP_3_FEEDBACK_NOMINAL_H
#define SIM_GAP_3_FEEDBACK_NOMINAL_H

#include "gap/2_predict/residual.h"
#include "gap/3_feedback/slow_errors.h"
#include "pilots/flown_by.h"
#include <math.h>

#define NOMINAL_STEP_S 0.002 // of a flight, about: a sample of the log has a whole number of them

// Of one sample.
static inline int nominal_steps(double sample_s) {
  return (int)fmax(1.0, round(sample_s / NOMINAL_STEP_S));
}

#define RATE_GAIN_LEAST 8.0 // 1/s, of a vehicle that small; with less it falls over

// How a flight was flown and measured.
typedef struct {
  double rate_gain[3], tilt_gain; // 1/s, 1/s2: angular acceleration per rate and per angle
  double rate_lead[3];         // 1: the same per angular acceleration, as a pilot sees it from call to call
  double rate_gain_most;       // 1/s: with more its motors do not follow
  double turn_noise_radps2[2]; // of its commands about x and y, sd of a sample; 0: not known
  double spared; // so much of the noise of a log that it is not fed with, 0 to 1: that is of logging
  double climb_gain, height_gain; // 1/s, 1/s2
  double outer_s;                 // between two looks at place and speed; 0: at every call
  bool kicks;                     // its lead is on the error of a rate: what is wanted steps at each look
  double nose_lead;               // with kicks: of the rate about z it wants so much per rate of its heading
  bool unread;                    // rows are fewer than commands: what is read of rate gains is not believed
  double acc_mps2[3], gyro_radps[3], vel_mps[3], pos_m[3], angle_rad, vbat_V, range_m; // sd of a sample
  slow_t slow_pos_m, slow_vel_mps, slow_angle_rad; // errors of the estimates that last, besides
  double force_mps2[3], force_tau_s;               // disturbing forces, sd and correlation time (gusts.h)
  double quick_mps2[3];                            // and such as last for GUST_QUICK_S
  double turn_radps2[3], turn_tau_s;               // and moments
  const flown_by_t *flown_by; // who flew, as far as the vehicle file says; null: nobody knows
} closed_loop_t;

// residual: of the best model so far, by channel and row of the set. Without disturbing forces.
closed_loop_t closed_loop_of(const set_t *s, const model_t *m, const flown_by_t *by,
                             double *const residual[CHANNELS]);
// Noise of the range, by its rows.
double closed_loop_range_m(const set_t *s, const model_t *m, const double *residual_m);

// The same by a pilot that turns it with this rate gain at least, and commands as noisily.
closed_loop_t closed_loop_turning(const closed_loop_t *w, const set_t *s, const model_t *m, double gain);

// With a rate gain; off: logarithm of how much the model turns over how much the log's vehicle does; NaN: it
// cannot be flown.
typedef struct {
  double gain, off;
} turned_t;

// Of n in the gain's order, that at which it first turns as much, between two of them; else the nearest one.
// 0: none could be flown. believed: what was read, the first, may be right. Else only those count from which
// on a larger gain turns it more: with less a vehicle swings, which is no sign of a swift pilot.
double closed_loop_gain(const turned_t *t, int n, bool believed);

// Turned with the gain with which the model turns as much as the log's vehicle, if that is more than was read
// (swiftness.c); as it is where the log has no rates or the pilot is known. FAILED: no memory.
MUST_CHECK done_t closed_loop_match(closed_loop_t *w, const set_t *s, const model_t *m, unsigned long seed,
                                    why_t *why);

#define NOMINAL_VARIED 0.3 // of a gain: a fit from a log in closed loop knows it no better

// The same as another pilot could have flown it, whose gains fit the log as well; where they are unread every
// odd one is at least as swift as the Crazyflie's INDI, and every other of these as the motors allow. Number
// 0 is the fit itself. Of a pilot that is known there is but one.
closed_loop_t closed_loop_varied(const closed_loop_t *w, int i);

// One flight along the track of grid g. truth (may be null): the same without the errors of sensors and
// estimates. What the log lacks of its track for a while is bridged; after a gap in time the vehicle is put
// where the log goes on. BAD_INPUT: it cannot be flown, or was lost; FAILED: no memory; then both are empty.
// Free the flights.
MUST_CHECK done_t nominal_fly(const grid_t *g, const model_t *m, const closed_loop_t *loop,
                              unsigned long seed, gap_flight_t *flight, gap_flight_t *truth, why_t *why);

// One flight along each flight of a set, by a model, as it is seen and as it is: a set of each, with the same
// channels. BAD_INPUT, FAILED: as nominal_flights. Free it, also on an error.
typedef struct {
  set_t seen, is;
  gap_flights_t seen_flights, is_flights;
} along_t;

MUST_CHECK done_t nominal_along(along_t *a, const set_t *like, const model_t *m, const closed_loop_t *loop,
                                unsigned long seed, why_t *why);
void along_free(along_t *a);

// What is flown of a flight, s: of one that counts, so that a longer log costs no more, and of a trial.
// Nothing is seen in a trial but how much it shakes: of moments that last for a second 30 s say it to an
// eighth.
#define NOMINAL_S 60.0
#define TRIAL_S   30.0

// The first part of a flight. The points are the grid's own.
grid_t nominal_part(const grid_t *g, double most_s);

// One flight along each flight of a set that can be flown, of each that part. truth: the same flights
// without errors; may be null. Both lists have room. BAD_INPUT: none could be flown; FAILED: no memory.
MUST_CHECK done_t nominal_flights(gap_flights_t *to, gap_flights_t *truth, const set_t *s, const model_t *m,
                                  const closed_loop_t *loop, double most_s, unsigned long seed, why_t *why);
// The flights as a set; several: as flights of a log that has several (lift.h). FAILED: no memory.
MUST_CHECK done_t nominal_set(set_t *s, const gap_flights_t *flown, bool several, const model_t *m,
                              why_t *why);

#endif
