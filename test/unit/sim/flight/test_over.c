// test_over.c - a flight is over when its time is up, or when a state or a command is no number.
#include "flight/over.h"
#include "rig/test.h"

#include <math.h>

typedef struct {
  const char *text;
  double end_s, tick_s;
  long tick;
  bool broken;
  double motor_N;
  flight_over_t want;
} over_row_t;

static const over_row_t CASE[] = {
    {"before the first tick of a flight of no time it flies", 0.0, 0.002, 0, false, 0.0, FLIGHT_FLIES},
    {"after it its time is up", 0.0, 0.002, 1, false, 0.0, FLIGHT_TIME_UP},
    {"the tick at the plan's end is flown", 40.0, 0.002, 20000, false, 0.1, FLIGHT_FLIES},
    {"the one after it is not", 40.0, 0.002, 20001, false, 0.1, FLIGHT_TIME_UP},
    {"a plan's end is rounded to a tick", 0.7, 0.1, 7, false, 0.1, FLIGHT_FLIES},
    {"a body that broke ends it", 40.0, 0.002, 5, true, 0.1, FLIGHT_NOT_FINITE},
    {"a command that is no number ends it", 40.0, 0.002, 5, false, (double)NAN, FLIGHT_NOT_FINITE},
    {"an infinite command ends it", 40.0, 0.002, 5, false, HUGE_VAL, FLIGHT_NOT_FINITE},
    {"what broke at the last tick is told", 40.0, 0.002, 20001, true, 0.1, FLIGHT_NOT_FINITE},
};

TEST(flight_is_over_when_its_time_is_up_or_something_is_no_number) {
  for (size_t i = 0; i < sizeof CASE / sizeof *CASE; i++) {
    const over_row_t *row = &CASE[i];
    ROW("%s", row->text);
    const plan_t plan = {.end_s = row->end_s};
    const body_t body = {.broken = row->broken};
    const double motor_N[PILOT_MOTORS] = {0.1, 0.1, 0.1, row->motor_N};
    CHECK(flight_over(&plan, row->tick_s, row->tick, &body, motor_N) == row->want);
  }
}
