// record6.h - a flight in six degrees of freedom in memory: what the loop saw at a tick becomes a sample.
#ifndef SIM_FLIGHT_RECORD6_H
#define SIM_FLIGHT_RECORD6_H

#include "body/body.h"
#include "crazyflie/pilot6.h"
#include "flight/record.h"
#include "sense/truth.h"

typedef struct {
  sample6_t *sample; // as many as record->n
  int room;
} record6_t;

// One tick. Nothing of it is kept but what goes into the samples.
typedef struct {
  double t_s, setpoint_m; // of the rotors' plane
  const body_t *body;
  const truth_t *truth;
  const pilot6_in_t *in;
  const ekf_out_t *estimate;
  const double *motor_N;      // PILOT6_MOTORS commands, before their limits
  const thoughts_t *thoughts; // of the pilot
  double up_min, gap_min_m;   // smallest since the last sample: cosine of the tilt, nearest rotor's gap
  bool range_new;             // since the last sample
  double range_m;             // the newest
} tick6_t;

// Distance of the rotor that is nearest to the ceiling.
double record6_gap_m(const body_t *b);

// Makes room for so many samples in both. FAILED: no memory.
MUST_CHECK done_t record6_reserve(record_t *record, record6_t *more, int room, why_t *why);

// Adds a sample to both. FAILED: no memory.
MUST_CHECK done_t record6_add(record_t *record, record6_t *more, const tick6_t *tick, why_t *why);

void record6_free(record6_t *r);

#endif
