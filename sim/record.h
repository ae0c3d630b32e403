// record.h - a flight in memory: one sample every 10 ms, or every tick of a slower controller.
#ifndef SIM_RECORD_H
#define SIM_RECORD_H

#include "controller.h"
#include "error.h"
#include <stdbool.h>
#include <stdio.h>

typedef struct {
  double t_s, setpoint_m;
  double z_m, climb_mps, acc_mps2; // as it is
  double gap_m, gap_min_m;         // to the ceiling: now, and smallest since the last sample
  double thrust_N, command_N;      // of the rotors in free air; what was commanded at t_s
  double ratio;                    // what the effects multiply the thrust by
  int contacts;                    // with the ceiling, since the start
  sense_t sense;                   // as measured
  thoughts_t thoughts;             // as believed
} sample_t;

typedef struct {
  sample_t *sample;
  int n, room;
} record_t;

// ST_FAILED: no memory; nothing was added.
MUST_CHECK status_t record_add(record_t *r, const sample_t *sample);

void record_free(record_t *r);

// Writes the flight as a CSV with Crazyflie log names (README, logs). The stream knows if that failed.
void record_write(const record_t *r, FILE *file);

#endif
