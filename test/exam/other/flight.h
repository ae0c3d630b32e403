// flight.h - a flight of the second plant, as the log and the files that its user writes.
#ifndef TEST_EXAM_OTHER_FLIGHT_H
#define TEST_EXAM_OTHER_FLIGHT_H

#include "exam/other/senses.h"
#include <stdbool.h>
#include <stdio.h>

typedef enum { COMMAND_SPEED, COMMAND_SHARE, COMMAND_N } command_unit_t;

// What is wrong with a log, or with what its user says of the columns.
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

// How its user logs. All of it is known to them, and stands in the columns file as far as that has words for
// it.
typedef struct {
  int every;           // ticks of 2 ms to a row
  bool means;          // a row is a mean over its period, else what is at its time
  double late_s;       // the logged command is that old
  command_unit_t unit; // speed, share of the greatest speed, newton
  unsigned lacks;      // streams
  dirt_t dirt;
} habits_t;

// One sort of manoeuvre: up, down and about the vertical, or sideways.
enum { SORT_ALL, SORT_UPRIGHT, SORT_SIDEWAYS, SORTS };

typedef struct {
  nature_t truth, known; // the user knows the second, but for what it does not say
  senses_t senses;
  habits_t habits;
  double briskness; // of the pilot
  bool ladder;      // take-off, steps of height and holds, landing; else pieces that excite it
  int sort;         // which of these: a flight has one sort of them, or all
  double span_s;
  uint64_t seed;
} other_job_t;

// Nothing hidden yet; everything but the flights' seed is drawn.
other_job_t other_job(dice_t *d);

// For how long what the file does not have acted: outside the library at half its size or more; a surface by
// a hundredth of the thrust or more.
#define FELT_GAIN 0.01
typedef struct {
  double strange_s, ceiling_s, ground_s;
} felt_t;

// Flies pieces that excite it, near the floor and under the ceiling where there is one. False: it was lost,
// or could not be written. felt: is added to.
bool other_fly(const other_job_t *job, FILE *out, felt_t *felt);

void other_write_columns(const other_job_t *job, FILE *out);
void other_write_vehicle(const other_job_t *job, FILE *out);

#endif
