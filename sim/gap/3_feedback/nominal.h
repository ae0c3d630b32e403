// nominal.h - nominal flights, in which nothing is hidden: the model itself flies in closed loop along a
// log's own track, through the same sensors, rates and noise. What the workflow sees in them is what feedback
// and noise alone produce.
//
// The pilot is the one that the vehicle file names ([controller], nominal_known.h), else a cascade of
// proportional loops whose gains are fitted to the log: moments on rates and attitude, thrust on climb and
// height. Where the model turns less than the log's vehicle with these gains, they are raised (swiftness.c).
// The rates have as much lead as makes the commands as noisy as the log's or, where every command is told to
// be logged, as their answer to the noise of the rates says. Noise and disturbance are those of the log:
// sensor noise is read off the differences of successive samples, disturbing forces (gusts.h) and moments,
// first-order Gauss-Markov or new at each step, off what the residual has beyond that.
#ifndef SIM_GAP_3_FEEDBACK_NOMINAL_H
#define SIM_GAP_3_FEEDBACK_NOMINAL_H

#include "gap/2_predict/residual.h"
#include "gap/3_feedback/slow_errors.h"
#include "pilots/flown_by.h"
#include <math.h>

#define NOMINAL_STEP_S 0.002 // s, about: a sample of the log has a whole number of steps

// Returns the number of steps of one sample.
static inline int nominal_steps(double sample_s) {
  return (int)fmax(1.0, round(sample_s / NOMINAL_STEP_S));
}

#define YAW_GAIN        5.0 // 1/s, about z: as the Crazyflie's, whose yaw is weak; the least
#define RATE_GAIN_LEAST 8.0 // 1/s: with less a vehicle that small falls over

// How a flight was flown and measured.
typedef struct {
  double rate_gain[3], tilt_gain; // 1/s, 1/s2: angular acceleration per rate and per angle
  double rate_lead[3];            // no unit: angular acceleration commanded per that seen from call to call
  double rate_gain_most; // 1/s: no larger one is flown, because it rings; `swift` times that of such motors
  double swift; // no unit: how far beyond it the log's pilot was; 1, or 0, which counts as 1: it was not
  double turn_noise_radps2[2]; // of a sample of the commands about x and y, sd; 0: not known
  double spared; // share (0 to 1) of the log's noise that logging adds and the pilot is not fed with
  double climb_gain, height_gain; // 1/s, 1/s2
  double outer_s;                 // s, between two looks at place and speed; 0: it looks at every call
  bool kicks;                     // the lead is on the rate error: the wanted rate steps at each look
  double nose_lead;               // with kicks: wanted rate about z per rate of the heading error, no unit
  bool unread;                    // rows are fewer than commands: rate gains read off them are not believed
  double acc_mps2[3], gyro_radps[3], vel_mps[3], pos_m[3], angle_rad, vbat_V, range_m; // sd of a sample
  slow_t slow_pos_m, slow_vel_mps, slow_angle_rad; // lasting errors of the estimates, besides
  double force_mps2[3], force_tau_s;               // disturbing forces, sd and correlation time (gusts.h)
  double quick_mps2[3];                            // and forces that last for GUST_QUICK_S, sd
  double turn_radps2[3], turn_tau_s;               // and moments, as rows show them
  double turn_quick[3];       // share (0 to 1) of their variance that no two steps have in common
  const flown_by_t *flown_by; // who flew, if the vehicle file says so; null: not known
} closed_loop_t;

// Finds how the flights of a set were flown and measured, with disturbing forces left at 0. residual: of the
// best model so far, by channel and row of the set. FAILED: no memory.
MUST_CHECK done_t closed_loop_of(closed_loop_t *w, const set_t *s, const model_t *m, const flown_by_t *by,
                                 double *const residual[CHANNELS], why_t *why);
// Returns the sd of the range noise, m, as the residual of the range rows shows it.
double closed_loop_range_m(const set_t *s, const model_t *m, const double *residual_m);

// Returns the same with a pilot whose rate gain (1/s) is at least this one, and whose commands are as noisy.
closed_loop_t closed_loop_turning(const closed_loop_t *w, const set_t *s, const model_t *m, double gain);

// How much the model turns with a rate gain. off: logarithm of its turning over that of the log's vehicle;
// NaN: it cannot be flown.
typedef struct {
  double gain, off;
} turned_t;

// Returns the gain at which the model first turns as much as the log's vehicle, interpolated between two of n
// tries in the order of their gains; else that of the nearest try; 0: none could be flown. believed: the gain
// that was read, the first, may be right. Else only those count from which on a larger gain turns the model
// more: with less gain a vehicle swings, which is no sign of a swift pilot.
double closed_loop_gain(const turned_t *t, int n, bool believed);

// Raises the gains to those with which the model turns as much as the log's vehicle, if these are larger
// (swiftness.c). Nothing changes where the log has no rates or the pilot is known. FAILED: no memory.
MUST_CHECK done_t closed_loop_match(closed_loop_t *w, const set_t *s, const model_t *m, unsigned long seed,
                                    why_t *why);

#define NOMINAL_VARIED 0.3 // share of a gain: a fit to a log in closed loop knows it no better

// Returns the loop of another pilot that could have flown the log, because its gains fit as well. Number 0 is
// the fit itself. Where gains are unread, every odd one is at least as swift as the Crazyflie's INDI, and
// every other of these as swift as the motors allow. A pilot that is known does not vary.
closed_loop_t closed_loop_varied(const closed_loop_t *w, int i);

// Flies along the track of grid g. truth (may be null): the same flight without the errors of sensors and
// estimates. What the log lacks of its track for a while is bridged; after a gap in time the vehicle is put
// where the log goes on. BAD_INPUT: the track cannot be flown, or the vehicle was lost too often; FAILED: no
// memory; then both are empty. Free the flights.
MUST_CHECK done_t nominal_fly(const grid_t *g, const model_t *m, const closed_loop_t *loop,
                              unsigned long seed, gap_flight_t *flight, gap_flight_t *truth, why_t *why);

// Flights of a model, one along each flight of a set: as they are seen, and as they are.
typedef struct {
  set_t seen, is;
  gap_flights_t seen_flights, is_flights;
} along_t;

// Flies them, and makes a set of each kind, with the same channels as `like`. BAD_INPUT, FAILED: as
// nominal_flights. Free it, also on an error.
MUST_CHECK done_t nominal_along(along_t *a, const set_t *like, const model_t *m, const closed_loop_t *loop,
                                unsigned long seed, why_t *why);
void along_free(along_t *a);

// How much of a flight is flown, s: in a flight that counts, so that a longer log costs no more, and in a
// trial. A trial only tells how much the vehicle shakes; 30 s tell that to an eighth for moments that last
// for a second.
#define NOMINAL_S 60.0
#define TRIAL_S   30.0

// Returns the first part of a flight, most_s long from its first good point on. It shares the grid's points.
grid_t nominal_part(const grid_t *g, double most_s);

// Flies one flight along the first most_s of each flight of a set that can be flown. truth: the same flights
// without errors; may be null. Both lists have room. BAD_INPUT: none could be flown; FAILED: no memory.
MUST_CHECK done_t nominal_flights(gap_flights_t *to, gap_flights_t *truth, const set_t *s, const model_t *m,
                                  const closed_loop_t *loop, double most_s, unsigned long seed, why_t *why);
// Makes a set of the flights. several: as flights of a log that has several (lift.h). FAILED: no memory.
MUST_CHECK done_t nominal_set(set_t *s, const gap_flights_t *flown, bool several, const model_t *m,
                              why_t *why);

#endif
