// flight.h - a recorded flight in SI on one time base, signal by signal: what the workflow's stages work on.
#ifndef SIM_GAP_FLIGHT_H
#define SIM_GAP_FLIGHT_H

#include "io/columns.h"
#include "model.h"

typedef struct {
  char name[256];       // of the log, for messages
  int n;                // samples
  double *t_s;          // strictly increasing, uniform within a segment
  double *v[SIG_COUNT]; // per signal (io/columns.h): n numbers, NaN: none at this instant; null: not logged.
                        // SIG_A*: specific force in body axes; SIG_QW..QZ: body to world, length 1;
                        // SIG_Z: of the feet over the floor, 0 at rest on it
  bool motors_N;        // SIG_M*: newton, else commands of 0..65535
  double *motor_speed_radps[4];      // measured rotor speeds; null: not logged
  double *range_up_m, *range_down_m; // fresh samples only, NaN between them; null: not logged
  bool *saturated;                   // a motor was at a limit (the sample is masked)
  int *segment;                      // 0, 1, 2..: a new one after every gap; filters start again
  double rate_Hz;                    // median sample rate
} gap_flight_t;

typedef struct {
  gap_flight_t *flight;
  int n;
} gap_flights_t;

// ST_BAD_INPUT: names file, line and column. The caller frees.
MUST_CHECK status_t gap_read(gap_flight_t *f, const char *path, const columns_t *columns,
                             const model_t *vehicle, why_t *why);
void gap_flight_free(gap_flight_t *f);

#endif
