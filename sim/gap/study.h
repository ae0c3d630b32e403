// study.h - the workflow from log files on: reads them, holds some out, diagnoses, and flies the held-out
// ones again.
#ifndef SIM_GAP_STUDY_H
#define SIM_GAP_STUDY_H

#include "base/made.h"
#include "gap/7_verify/resimulate.h"
#include "gap/diagnose.h"

#define STUDY_VEHICLE "cf21_legacy" // of sim/vehicle/vehicles: taken where no file is named

typedef struct {
  const char *vehicle, *columns; // files; null: STUDY_VEHICLE, and the Crazyflie's own names
  const char *const *log;
  int n_log;
  const char *const *hold_out; // logs, which may be among `log`, too; none: see study_t
  int n_hold_out;
  unsigned long seed;
  const made_t *made;                 // how the program was called; null: not said
  void (*progress)(const char *what); // may be null
} study_order_t;

// Where nothing is said of what is held out: of three flights or more the last third, else stretches of each
// flight by turns (by_turns.h).
typedef struct {
  study_order_t order;
  model_t vehicle;
  flown_by_t flown_by;
  char *vehicle_text;
  columns_t columns;
  gap_flight_t *flight; // those to fit to, then the held-out ones
  gap_flights_t fit, held;
  bool by_time; // every flight is fitted, and held out by turns; `held` is empty
  diagnosis_t diagnosis;
  resimulation_t resimulation;
} study_t;

// Returns the vehicle's name for messages: its file, or that it is built in.
const char *study_vehicle(const study_t *s);

// Makes the whole study. BAD_INPUT: as the readers; a log given twice; no log left to fit to. FAILED: no
// memory. Free it, also on an error.
MUST_CHECK done_t study_make(study_t *s, const study_order_t *order, why_t *why);
void study_free(study_t *s);

#endif
