// gap_track.h - two flights of the exam's vehicle in which nothing is hidden, as grid points, and the closed
// loop as identified from their logs.
#ifndef TEST_RIG_GAP_TRACK_H
#define TEST_RIG_GAP_TRACK_H

#include "exam/flights.h"
#include "gap/3_feedback/nominal.h"

typedef struct {
  model_t vehicle;
  gap_flight_t flight[2];
  set_t set;
  closed_loop_t loop;
} gap_track_t;

// How they are flown. spoil (or null) changes the flights before they become grid points.
typedef struct {
  bool indi, hover; // else by the firmware's PID, and with manoeuvres
  void (*spoil)(gap_track_t *t);
} gap_track_job_t;

done_t gap_track_make(gap_track_t *t, const gap_track_job_t *job, why_t *why);
void gap_track_free(gap_track_t *t);

// Keeps one of `every` samples of each flight.
void gap_track_thin(gap_track_t *t, int every);
// Makes rows that are means over `every` samples. A range stays a sample.
void gap_track_average(gap_track_t *t, int every);

#endif
