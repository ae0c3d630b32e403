// recorder.c - what the uSD deck can write of a flight.
#include "recorder.h"

#include "eventtrigger.h"
#include "glue.h"
#include "usddeck.h"
#include <string.h>

EVENTTRIGGER(indiCall)
EVENTTRIGGER(indiState)
EVENTTRIGGER(indiSet)

// Compares bit by bit: NaN is logged as it came, too.
static bool differs(const void *a, const void *b, size_t size) {
  return memcmp(a, b, size) != 0;
}
#define DIFFERS(a, b) differs(&(a), &(b), sizeof(a))

static bool state_changed(const recording_t *r, const flight_in_t *in) {
  return DIFFERS(r->pos_w_m, in->pos_w_m) || DIFFERS(r->vel_w_mps, in->vel_w_mps) ||
         DIFFERS(r->q_wb, in->q_wb) || DIFFERS(r->range_m, in->range_m) ||
         DIFFERS(r->range_age_s, in->range_age_s) || DIFFERS(r->down_m, in->down_m) ||
         r->no_lesson != in->no_lesson || r->tunes_written != r->tunes ||
         r->setpoint.vel_in_body != in->setpoint.vel_in_body;
}

static void write_state(recording_t *r, const flight_in_t *in) {
  r->pos_w_m = in->pos_w_m;
  r->vel_w_mps = in->vel_w_mps;
  r->q_wb = in->q_wb;
  r->range_m = in->range_m;
  r->range_age_s = in->range_age_s;
  r->down_m = in->down_m;
  r->no_lesson = in->no_lesson;
  r->tunes_written = r->tunes;
  r->state++;
  eventTrigger(&eventTrigger_indiState);
}

static void write_set(recording_t *r, const flight_in_t *in) {
  r->setpoint = in->setpoint;
  r->set++;
  eventTrigger(&eventTrigger_indiSet);
}

void recorder_call(void) {
  recording_t *const r = &GLUE.recorder;
  const flight_in_t *const in = &GLUE.in;
  if (r->calls < UINT32_MAX) r->calls++;
  const bool writes = usddeckLoggingEnabled();
  if (writes) {
    r->stale = r->stale || r->calls % RECORDER_ANEW_MS == 0;
    const bool anew =
        !r->wrote || (r->stale && GLUE.flight.due == 0); // only a call in which no loop ran has the time
    r->stale = r->stale && !anew;
    if (anew || state_changed(r, in)) write_state(r, in);
    // Different padding bytes between its fields cost a row, no more.
    if (anew || DIFFERS(r->setpoint, in->setpoint)) write_set(r, in);
    eventTrigger(&eventTrigger_indiCall);
  }
  r->wrote = writes;
}
