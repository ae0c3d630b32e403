// users.h - the exam with logs as users have them: files of the second plant (test/exam/other) with a vehicle
// file, read and answered as `gap` does, and marked from its verdict alone.
#ifndef TEST_EXAM_USERS_H
#define TEST_EXAM_USERS_H

#include "base/error.h"
#include "exam/other/flight.h"
#include "exam/reliability.h"
#include <cjson/cJSON.h>

typedef enum {
  USERS_HABITS,  // another simulator's
  USERS_LADDER,  // take-off, steps of height with holds, landing
  USERS_ALONE,   // one flight, 50 or 100 Hz, streams missing
  USERS_FILE,    // the vehicle file is wrong in what it has, or has no ceiling
  USERS_OUTSIDE, // what no library has
  USERS_DIRTY,   // logs and columns files with a fault
  USERS_SORTS,   // another simulator's; one flight up and down, one sideways, one of all
  USERS_TORQUE,  // of tests alone: the rotors' torque is two thirds, or half as much again; 100 Hz
  USERS_REFIT,   // another simulator's; before each flight something is fitted anew, and differs
  USERS_ALL,
  USERS_KINDS = USERS_ALL - 1 // that are drawn: all but of tests alone
} users_kind_t;

#define USERS_HIDDEN 2
#define USERS_TEXT   200

typedef struct {
  users_kind_t kind;
  int lost, unmet; // drawn again so often: it could not fly, or did not come where it was hidden for a second
  int n;           // hidden effects
  const char *hidden[USERS_HIDDEN];
  double times[USERS_HIDDEN];
  hide_strange_t strange; // what null: none
  bool differ;            // flights do, each by a constant of its own
  const char *cause;      // a word that a refusal is to have; null: nothing is wrong with the log
  // marks (users_mark.c)
  bool refused, unknown, located, told_differ;
  int names, right, beside, wrong; // right: hidden effects that a name, or a told rival of its family, holds
  reliability_t stated;            // of the names
  char answer[USERS_TEXT];
} users_set_t;

// Makes, reads, diagnoses and marks set `seed` of a kind. FAILED: no memory, no disk.
MUST_CHECK done_t users_one(users_kind_t kind, unsigned long seed, users_set_t *set, why_t *why);

// Marks a verdict (verdict.json); a name counts as in tools/outside/marks.py.
void users_mark(users_set_t *set, const cJSON *verdict);
bool users_exact(const users_set_t *set); // a dirty log: refused with the cause

// The kind of exam: users FIRST SETS [lines]; prints the marks.
int users_main(int argc, char **argv);

#endif
