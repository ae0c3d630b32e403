// group.h - eight flights that are flown at once; internal to flight/together.h.
#ifndef SIM_FLIGHT_GROUP_H
#define SIM_FLIGHT_GROUP_H

#include "body/abreast.h"
#include "flight/loop_parts.h"
#include "flight/woven.h"

typedef struct {
  flight_loop_t *f;
  record_t *record;
  bool *finite;
  why_t *why;
  done_t status;
} job_t;

typedef struct group group_t;

// When a flight last parted from the others, and how long and until when it rests (flies by itself).
typedef struct {
  uint32_t parted_ms, rest_ms, back_ms;
} apart_t;

typedef struct {
  group_t *g;
  int k;
} place_t;

struct group {
  woven_t woven;
  abreast_t *bodies;
  job_t *job[LANES];
  unsigned fly;     // lanes that hold a flight, a bit each
  unsigned sensed;  // of these, those whose sensors and estimator are in lanes; the others will return
  unsigned vehicle; // of `fly`, those whose pilot is in lanes
  unsigned out;     // those whose pilot flies by itself for now, and will return
  unsigned edited;  // those with plan_t.edit or pilot_t.around
  unsigned mocap;   // those with motion capture
  unsigned keeps;   // those whose pilot keeps a log
  unsigned looked;  // those with pilot_t.around,
  const pilot_around_t *around; // the same for all of them
  uint32_t ms;
  // Members of flight_loop_t that are kept here in flight, because most ticks need no others.
  long tick, until; // until: before this tick no flight has a set point due or ends
  int every[LANES];
  double up_min[LANES], gap_min_m[LANES];
  random_t *random[LANES];                   // null: no flight
  apart_t apart[LANES], apart_sensed[LANES]; // of pilots; of sensors and estimators
  place_t place[LANES];
  pilot_in_t told[LANES]; // what edited pilots get
  long together;          // milliseconds that pilots flew in lanes
  union {
    glue_t app;
    flight_loop_t flight;
  } nobody; // stands for the flight of an empty lane
};

// Declares name[LANES]: the address of something of flight k for lanes in `of`, of `nobody` for others.
#define OF_EACH(name, of, something)                                                                         \
  void *name[LANES];                                                                                         \
  for (int k = 0; k < LANES; k++) name[k] = (of) >> k & 1 ? (void *)(something) : (void *)&g->nobody

#define EACH(k, of)                                                                                          \
  for (int k = 0; k < LANES; k++)                                                                            \
    if ((of) >> k & 1)

// Brings the body_t of these flights up to date, which lag behind in lanes.
void group_settle(group_t *g, unsigned of);

// A flight that parts repeats the milliseconds since the last copy, up to 32 and 16 on average (SINCE of
// lanes_state.cpp). If it parts again within APART_SOON_MS of its last rest, it rests for APART_REST_MS and
// on to the next copy. Where that goes on (it is down, or handed over, and the others fly), each rest is
// twice as long, up to half a second, after which another try costs little.
#define APART_SOON_MS     32
#define APART_REST_MS     16
#define APART_REST_MAX_MS 512
#define APART_NEVER       ((apart_t){.parted_ms = 0u - APART_SOON_MS - 1})
// Notes that a flight parted at ms. True if it has to rest.
bool group_parts(apart_t *a, uint32_t ms);
// True if its rest is over at ms.
bool group_rested(const apart_t *a, uint32_t ms);

// Marks the pilot of flight k as in lanes from the first millisecond on, if it can be.
void group_begin_vehicle(group_t *g, int k);
// Runs a millisecond of all sensors and estimators.
void group_sense(group_t *g);
// Runs a millisecond of all pilots.
void group_pilots(group_t *g);

#endif
