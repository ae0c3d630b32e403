// slot.h - the air garage's hover between a deck and a ceiling, 71 mm apart: the flight, and how its track is
// judged.
//
// Protocol (XinLong-Li/air_garage_cflib 15c885b, table flights of 23 and 27 August 2024): at rest on the
// deck, then "10 mm above rest" and 15 s of hover, pose by motion capture. Seed k flies with what was
// measured on real flight k mod 8: how its markers' body was turned against the vehicle at rest, and how
// slowly it was told to rise.
#ifndef SIM_FLIGHT_SLOT_H
#define SIM_FLIGHT_SLOT_H

#include "flight/setup.h"

#define SLOT_REST_M    0.0404 // propellers to ceiling at rest: 0.8349 - 0.7915 - 0.003 m
#define SLOT_RISE_M    0.010  // commanded above rest
#define SLOT_NEAR_M    0.012  // nearer is captured; all real flights are nearer than 10 mm or farther than 18
#define SLOT_CAUGHT_S  0.3    // ... for at least so long in total
#define SLOT_LIFT_M    0.006  // it flies when it is this much higher than at rest
#define SLOT_FLIGHTS   8      // real flights in this gap
#define SLOT_TAKEOFF_S 0.5
// Ground effect as measured with a Crazyflie 2.1 over clearance h of its feet, 1 + 0.174 exp(-0.820 h/R)
// (flights of aerorobotics/neural-swarm 48b1851), here over the propellers' height h + 30 mm.
#define SLOT_GROUND "ground:form=exponential,Ca=0.496,Cb=0.82"
// The form that fits at the weight that flights over the open deck imply (README, a real gap).
#define SLOT_CEILING "ceiling:form=square-root"

// The vehicle, before its weight is varied.
MUST_CHECK done_t slot_vehicle(model_t *model, why_t *why);

// Returns the k-th real flight's file, and the height of its ceiling over the floor. slot_late is 1 if its
// take-off was the quick one.
const char *slot_real(int k, double *ceiling_m);
int slot_late(int k);

// Sets up a flight of the scenario, complete but for the user's request. ceiling: false for the open deck.
MUST_CHECK done_t slot_setup(setup_t *setup, uint64_t seed, bool ceiling, double rise_m, why_t *why);

typedef struct {
  double t_s, gap_m; // propellers' plane to ceiling
} slot_point_t;

typedef struct {
  bool captured;
  double median_m;  // gap, of the captured samples; NaN: none
  double closest_m; // gap, of all samples
  double lift_s;    // from motors on to SLOT_LIFT_M above rest; NaN: never
} slot_seen_t;

// Judges a track. start_s: motors on. BAD_INPUT: fewer than two points. FAILED: no memory.
MUST_CHECK done_t slot_judge(const slot_point_t *point, int n, double start_s, slot_seen_t *seen, why_t *why);

// Judges a motion-capture CSV (t, x, y, z of the marker, which is 3 mm below the propellers). BAD_INPUT: as
// csv_open, a missing column, or too many rows.
MUST_CHECK done_t slot_judge_file(const char *path, double ceiling_m, slot_seen_t *seen, why_t *why);

MUST_CHECK done_t slot_judge_flight(const flown_t *flown, const model_t *model, slot_seen_t *seen,
                                    why_t *why);

#endif
