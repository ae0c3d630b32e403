// recorder.h - what the uSD deck can write of a flight, so that it can be flown again on the desk (fly
// --replay).
//
// The deck takes 20 variables an event (tools/usd/config.txt says which) and copies them while the event is
// triggered, here in the stabilizer's own task: nothing changes between two variables of a row.
//
//   indiCall   every call: gyro, accelerometer, what was applied and what is commanded
//   indiState  the estimate and the range sample, in a call in which they changed
//   indiSet    the set point, likewise (one of its modes has no room there and stands in indiState)
//
// A row for which the card's buffer has no room is lost, and nothing in the file says so. Hence every call
// carries its number and those of the state and the set that it flew, and all three are written anew every
// 100 calls or few more: what is lost is seen, and is lost for a tenth of a second at most. Each row has its
// stamp at both ends, should someone have it written from another task.
#ifndef FIRMWARE_RECORDER_H
#define FIRMWARE_RECORDER_H

#include "flight/flight.h"

#define RECORDER_ANEW_MS 100

typedef struct {
  uint32_t calls;     // since the controller was selected; stops at its largest
  uint8_t state, set; // count the rows of each event; wrap
  uint8_t tunes;      // sets of parameters taken since the selection; wraps
  bool wrote;         // the deck took the last call
  bool stale;         // estimate and set point are due to be written anew
  // As they were last written.
  uint8_t no_lesson, tunes_told;
  float range_m, range_age_s;
  v3_t pos_w_m, vel_w_mps;
  quat_t q_wb;
  flight_setpoint_t setpoint;
} recording_t;

// At the end of a call of the app.
void recorder_call(void);

#endif
