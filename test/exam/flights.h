// flights.h - flights for an exam: logs in memory of the six-degree-of-freedom plant in closed loop, with
// noise.
#ifndef TEST_EXAM_FLIGHTS_H
#define TEST_EXAM_FLIGHTS_H

#include "gap/1_read/flight.h"

#define EXAM_SPAN_S 20.0
#define EXAM_TICK_S 0.002

typedef struct {
  const model_t *truth; // including what is hidden
  bool hover_only;
  bool indi; // flown by the flight code, else by the firmware's PID
  unsigned long seed;
  bool set_points; // the log has set points
} exam_flight_t;

// FAILED: no memory, or it crashed. Free it.
MUST_CHECK done_t exam_fly(const exam_flight_t *job, gap_flight_t *flight, why_t *why);

// The vehicle that the workflow is given: a Crazyflie under a ceiling, without any effect.
MUST_CHECK done_t exam_vehicle(model_t *m, why_t *why);

#endif
