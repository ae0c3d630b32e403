// slot_many.h - the outcome of many simulated hovers in the gap, and of the real ones.
#ifndef SIM_FLIGHT_SLOT_MANY_H
#define SIM_FLIGHT_SLOT_MANY_H

#include "flight/slot.h"

typedef struct {
  fly_kind_t kind;
  const char *effect; // NAME:KEY=VALUE,... in place of the scenario's; null: none
  double mass_kg;     // in place of the vehicle file's; 0: the file's
  bool ceiling;
  double rise_m;
  int seeds; // 1..seeds
} slot_case_t;

typedef struct {
  int flights, captured;
  int captured_as[SLOT_FLIGHTS]; // of those flown like the k-th real one: seed mod SLOT_FLIGHTS
  double low_m, high_m;          // smallest and largest median gap of a captured flight; NaN: none was
  double median_m;               // the median of these
  double free_m;                 // smallest gap of a flight that was not captured; NaN: none
  double lift_s[2];              // means: take-offs of 8 and of 1.6 s
  double peak_m;                 // mean, above rest
} slot_many_t;

// BAD_INPUT: not a valid effect. FAILED: no memory, or a flight that did not stay finite.
MUST_CHECK done_t slot_fly_many(const slot_case_t *c, slot_many_t *m, why_t *why);

// The same for this gap's real flights, from the folder of recorded flights; lift_s and peak_m are not set.
// BAD_INPUT: as slot_judge_file.
MUST_CHECK done_t slot_real_many(const char *folder, slot_many_t *m, why_t *why);

#endif
