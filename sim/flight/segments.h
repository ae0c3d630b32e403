// segments.h - what a flight was like between one set point and the next.
#ifndef SIM_FLIGHT_SEGMENTS_H
#define SIM_FLIGHT_SEGMENTS_H

#include "flight/loop.h"

// NaN: not reached, or nothing to measure.
typedef struct {
  char label[48]; // if the scenario gives one
  double setpoint_m;
  double overshoot_mm;  // beyond the set point, seen from the height at the segment's start; 0: none
  int peaks;            // extrema beyond 0.2 mm after the first crossing of the set point
  double t90_s;         // until 90 % of the way
  double settle_1mm_s;  // until within 1 mm for good
  double mean_error_mm; // height minus set point, over the last 5 s; the next two likewise
  double sd_mm;         // about that mean
  double rms_mm;        // about the set point
  double min_gap_mm;    // smallest distance to the ceiling
  int contacts;         // with the ceiling, including one that lasts from before
  double tilt_max_rad;
} segment_t;

// One segment for each waypoint of the plan. segment has room for WAYPOINTS_MAX; returns how many.
int segments_of(const record_t *record, const plan_t *plan, segment_t segment[WAYPOINTS_MAX]);

#endif
