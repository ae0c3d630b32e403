// users.h - the exam with logs as users have them: files of the second plant (test/exam/other) with a vehicle
// file, read and answered as `gap` does, and marked by its verdict alone.
#ifndef TEST_EXAM_USERS_H
#define TEST_EXAM_USERS_H

#include "base/error.h"
#include "exam/other/flight.h"
#include "exam/reliability.h"
#include <cjson/cJSON.h>

typedef enum {
  USERS_HABITS,  // of another simulator
  USERS_LADDER,  // take-off, steps of height with holds, landing
  USERS_ALONE,   // one flight, 50 or 100 Hz, streams missing
  USERS_FILE,    // the vehicle file has a wrong size, or no ceiling
  USERS_OUTSIDE, // effects outside the library
  USERS_DIRTY,   // logs and columns files with a fault
  USERS_SORTS,   // of another simulator; one flight up and down, one sideways, one with all manoeuvres
  USERS_TORQUE,  // for tests only: rotor torque two thirds or one and a half times; 100 Hz
  USERS_REFIT,   // of another simulator; something is fitted anew before each flight, and differs
  USERS_ALL,
  USERS_KINDS = USERS_ALL - 1 // those that are drawn: all but the tests' own
} users_kind_t;

#define USERS_HIDDEN 2
#define USERS_TEXT   200

typedef struct {
  users_kind_t kind;
  int lost, unmet; // times drawn again: vehicle lost; what is hidden not met for a second
  int n;           // hidden effects
  const char *hidden[USERS_HIDDEN];
  double times[USERS_HIDDEN];
  hide_strange_t strange; // what null: nothing outside the library
  bool differ;            // each flight has constants of its own
  const char *cause;      // a word that the refusal must have; null: the log has no fault
  // marks (users_mark.c)
  bool refused, unknown, located, told_differ;
  int names, right, beside, wrong; // right: hidden effects named, or told as rival of a name of their family
  reliability_t stated;            // of the names
  char answer[USERS_TEXT];
} users_set_t;

// Makes, reads, diagnoses and marks set `seed` of a kind. FAILED: no memory, or no disk space.
MUST_CHECK done_t users_one(users_kind_t kind, unsigned long seed, users_set_t *set, why_t *why);

// Marks a verdict (verdict.json); a name counts as in tools/outside/marks.py.
void users_mark(users_set_t *set, const cJSON *verdict);
bool users_exact(const users_set_t *set); // of a dirty log: refused for the cause

// The program `exam users FIRST SETS [lines [KIND]]`; prints the marks.
int users_main(int argc, char **argv);

#endif
