// test_woven.c - who looks at a flight in lanes is told what has changed.
#include "flight/lanes_blocks.h"
#include "flight/woven.h"
#include "pilots/pilot_flight.h"
#include "rig/test.h"

#include <stdlib.h>

#define LANE 3

static const pilot_part_t latched[] = {
    {offsetof(glue_t, flight.guard.latched), offsetof(glue_t, flight.guard.latched) + sizeof(unsigned)}};
static const pilot_around_t around = {latched, 1, NULL};

// What the lane has of it, with nobody at home.
static void become(woven_t *w, const glue_t *app, unsigned reasons) {
  glue_t *const other = malloc(sizeof *other);
  if (!other) abort();
  *other = *app;
  other->flight.guard.latched = reasons;
  woven_put(w, LANES_app, LANE, other);
  free(other);
}

// The lane of a flight that is by itself flies on with what it has; what it came to there was remembered, and
// of a vehicle that came to the same in its first millisecond back nothing was told.
TEST(woven_tells_of_a_flight_that_is_back_what_its_lane_was_meanwhile) {
  pilot_flight_t *const p = calloc(1, sizeof *p);
  flight_loop_t *const f = calloc(1, sizeof *f);
  glue_t *const spare = calloc(1, sizeof *spare); // of lanes that nobody looks at
  void *nobody[LANES], *app[LANES];
  flight_param_t param;
  pilot_t pilot;
  woven_t w;
  if (!p || !f || !spare) abort();
  for (int k = 0; k < LANES; k++) nobody[k] = app[k] = spare;
  params_default(&param);
  CHECK_OK(pilot_flight_init(p, &param, NULL, &pilot));
  glue_t *const home = app[LANE] = &pilot.vehicle->app;
  f->pilot = &pilot;
  if (woven_open(&w)) {
    woven_look(&w, &around);
    woven_begin_vehicle(&w, LANE, pilot.vehicle);
    woven_get_looked(&w, app);
    become(&w, home, 2u);
    woven_get_looked(&w, nobody); // it is by itself
    CHECK(home->flight.guard.latched == 0u);
    woven_vehicle_back(&w, LANE, f);
    become(&w, home, 2u);
    woven_get_looked(&w, app);
    CHECK(home->flight.guard.latched == 2u);
    woven_close(&w);
  }
  free(spare);
  free(f);
  free(p);
}
