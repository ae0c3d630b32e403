// flight.h - flies the second plant, and writes the log and the files that its user would write.
#ifndef TEST_EXAM_OTHER_FLIGHT_H
#define TEST_EXAM_OTHER_FLIGHT_H

#include "exam/other/senses.h"
#include <stdbool.h>
#include <stdio.h>

typedef enum { COMMAND_SPEED, COMMAND_SHARE, COMMAND_N } command_unit_t;

// A fault of a log, or of what its user says of the columns.
typedef enum {
  DIRT_NONE,
  DIRT_EXCHANGED, // the columns of two motors
  DIRT_HALF,      // one motor's commands are half of what they were
  DIRT_GYRO,      // a rate stands still from 5 s on
  DIRT_VOLT,      // the voltage stands still
  DIRT_HOLES,     // every tenth cell of a column is no number
  DIRT_BACKWARDS, // the clock goes back a second
  DIRT_UNIT,      // acceleration in g, said to be m/s2
  DIRTS
} dirt_t;

enum { LACKS_ACC = 1, LACKS_SPEED = 2, LACKS_VOLT = 4, LACKS_WISH = 8 };

// How the user logs. The user knows all of it, and the columns file says it as far as it can.
typedef struct {
  int every;           // ticks of 2 ms per row
  bool means;          // a row is the mean over its period; else it is what was at its time
  double late_s;       // age of the logged command
  command_unit_t unit; // speed, share of the greatest speed, newton
  unsigned lacks;      // missing streams
  dirt_t dirt;
} habits_t;

// The sorts of manoeuvres: all; up, down and about the vertical; sideways.
enum { SORT_ALL, SORT_UPRIGHT, SORT_SIDEWAYS, SORTS };

typedef struct {
  nature_t truth, known; // what flies; what the user knows and writes into the vehicle file
  senses_t senses;
  habits_t habits;
  double briskness; // of the pilot
  bool ladder;      // take-off, steps of height with holds, landing; else pieces that excite the vehicle
  int sort;         // the pieces' sort of manoeuvre
  double span_s;
  uint64_t seed;
} other_job_t;

// Draws vehicle, sensors and habits. What is hidden, the span and the flights' seed are the caller's.
other_job_t other_job(dice_t *d);

// For how long flights felt what the vehicle file lacks: an effect outside the library at half its size or
// more; a surface at a hundredth of the thrust or more.
#define FELT_GAIN 0.01
typedef struct {
  double strange_s, ceiling_s, ground_s;
} felt_t;

// Flies pieces that excite the vehicle, also near the floor and, if there is one, under the ceiling; adds to
// *felt. False: the vehicle was lost, or the log could not be written.
bool other_fly(const other_job_t *job, FILE *out, felt_t *felt);

void other_write_columns(const other_job_t *job, FILE *out);
void other_write_vehicle(const other_job_t *job, FILE *out);

#endif
