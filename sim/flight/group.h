// group.h - eight flights that are flown at once: the inside of flight/together.h.
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

// When a flight parted from the others last; it is by itself so long, until then.
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
  unsigned fly;     // lanes in which a flight is, a bit each
  unsigned sensed;  // of these, those whose sensors and estimator are in lanes; the others' will be again
  unsigned vehicle; // of these, those whose pilot is in lanes, too
  unsigned out;     // those whose pilot will be, and flies by itself meanwhile
  unsigned edited;  // those with somebody between sensors and pilot
  unsigned mocap;   // those that motion capture sees
  unsigned keeps;   // those whose pilot keeps its log
  unsigned looked;  // and those at whose state somebody looks,
  const pilot_around_t *around; // this one
  uint32_t ms;
  // What of flight_loop_t is kept here while they fly, for most ticks need nothing else of it.
  long tick, until; // until: before that tick nobody has an order due, or is over
  int every[LANES];
  double up_min[LANES], gap_min_m[LANES];
  random_t *random[LANES]; // of those that fly
  apart_t apart[LANES], apart_sensed[LANES];
  place_t place[LANES];
  pilot_in_t told[LANES]; // edited
  long together;
  union {
    glue_t app;
    flight_loop_t flight;
  } nobody; // what is woven of lanes in which nobody is
};

// Of each lane in `of` the address of something of its flight, of the others that of nobody.
#define OF_EACH(name, of, something)                                                                         \
  void *name[LANES];                                                                                         \
  for (int k = 0; k < LANES; k++) name[k] = (of) >> k & 1 ? (void *)(something) : (void *)&g->nobody

#define EACH(k, of)                                                                                          \
  for (int k = 0; k < LANES; k++)                                                                            \
    if ((of) >> k & 1)

// The bodies' own numbers.
void group_settle(group_t *g, unsigned of);

// Who parts does up to 16 ms again and 8 on average, as far back as the last copy is (lanes_state.cpp). Who
// parts a second time within two copies flies by itself until the next; where that goes on (it is down, or
// handed over, and the others fly), twice as long each time, to half a second, after which a try costs
// little.
#define APART_SOON_MS     32
#define APART_REST_MS     16
#define APART_REST_MAX_MS 512
#define APART_NEVER       ((apart_t){.parted_ms = 0u - APART_SOON_MS - 1})
// A flight parts: whether it stays by itself.
bool group_parts(apart_t *a, uint32_t ms);
// Whether it may come back.
bool group_rested(const apart_t *a, uint32_t ms);

// Whose pilot can be in lanes is, from the first millisecond on.
void group_begin_vehicle(group_t *g, int k);
// A millisecond of all sensors and estimators.
void group_sense(group_t *g);
// A millisecond of all pilots.
void group_pilots(group_t *g);

#endif
