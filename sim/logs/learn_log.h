// learn_log.h - the flight code's own learner over recorded flights: filter, lag, distance, RLS as they fly.
//
// A pass over a flight gives, tick by tick, what the learner would see. Weights and covariance are carried
// from flight to flight by the caller; filters start again with every flight and after every gap. Near the
// ground the clearance (z - rest height) takes the place of the ceiling distance.
#ifndef SIM_LOGS_LEARN_LOG_H
#define SIM_LOGS_LEARN_LOG_H

#include "base/error.h"
#include "effects/fx.h"
#include "flight/learn.h"
#include "flight/params.h"
#include "logs/columns.h"
#include "vehicle/model.h"
#include <stdio.h>

#define LEARN_CUTOFF_HZ      8.0f // distances change more slowly in flight; what is faster is the rotors
#define LEARN_FAR_M          0.2f // from here on the surface does nothing: thrust over specific force is the mass
#define LEARN_NEAR_M         0.07f // "below 7 cm"
#define LEARN_STANDS_RATIO   1.25f // force over thrust, far from any surface, with stands_mass_kg
#define LEARN_MASS_TICKS_MIN 100

typedef struct {
  flight_param_t param; // filter, motor lag, rules of learning, start weights; pos.mass_kg
  columns_t columns;
  model_t vehicle;
  int surface;          // SURFACE_CEILING or SURFACE_GROUND
  double rest_height_m; // SURFACE_GROUND
  float stands_mass_kg; // tells standing from flying: the vehicle file's mass, or better the measured one
  FILE *points;         // gets `distance,ratio` of every sample that teaches; null: nothing is written
} learn_job_t;

// Defaults for this vehicle and surface: its mass and lag, LEARN_CUTOFF_HZ; rls.q = 0, so that every flight
// counts the same; near the ground the weights start from free air, 1, 0, ...
void learn_job_init(learn_job_t *job, const model_t *vehicle, int surface);

// Cells of a flight that were left out; as log_rows_bad.
typedef struct {
  long n;
  why_t first;
} learn_bad_t;

// Sums over ticks far from the surface.
typedef struct {
  double thrust_N, force_mps2;
  long n;
} learn_mass_t;

typedef struct {
  long ticks; // judged: the distance is known, and no contact
  long near;  // of them nearer than LEARN_NEAR_M
  double all_before_N,
      all_after_N; // standard deviation of the vertical force residual, without and with the curve
  double near_before_N, near_after_N; // its rms below LEARN_NEAR_M; NaN if there is no such tick
  double bias_N;                      // its mean, with the curve
  double nearest_m;
} learn_score_t;

// Each goes over one flight. BAD_INPUT: as flight_log_open and flight_log_next, or no tick at all; what
// was summed or learned so far is then of no use. bad may be null.
MUST_CHECK done_t learn_log_mass(const learn_job_t *job, const char *path, learn_mass_t *sum,
                                 learn_bad_t *bad, why_t *why);
MUST_CHECK done_t learn_log_teach(const learn_job_t *job, const char *path, learn_t *learn, why_t *why);
MUST_CHECK done_t learn_log_score(const learn_job_t *job, const char *path, const rbf_weights_t *curve,
                                  learn_score_t *score, learn_bad_t *bad, why_t *why);

// The mass that the sums tell, or NaN if there were too few ticks.
double learn_mass_kg(const learn_mass_t *sum);

#endif
