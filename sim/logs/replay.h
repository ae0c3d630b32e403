// replay.h - a recorded flight's inputs through the flight code: does it command what was logged?
//
// The log is one of two:
//   CSV  every call of the app, a row each, with its groups indiIn, indiSet (what the flight code was given),
//        indiRec and indi.m1..m4 (what it commanded): fly --log-rate 1000 writes it
//   uSD  the events indiCall, indiState and indiSet (src/firmware/recorder.h), logged by tools/usd/config.txt
//
// If the log begins with the call at which the controller was selected and has every call since, the history
// is known and the commands must be the same to the bit. After calls that are not in the log, or if it begins
// in mid flight, they may differ, because filters, ceiling, lesson and the guard's memory are not those of
// the flight. Those calls are counted apart, with how far off they are while the filters settle and after.
// Missing calls are skipped as missed ones are in flight.
//
// The parameters are the same for the whole flight; the log tells where others were taken.
#ifndef SIM_LOGS_REPLAY_H
#define SIM_LOGS_REPLAY_H

#include "base/error.h"
#include "flight/params.h"

// 1 s: eight periods of the filter, 8 Hz. The bias observer, 1 rad/s, still remembers a third: up to 0.25 mN.
#define REPLAY_SETTLE_CALLS 1000

typedef struct {
  long calls;      // replayed
  long differ;     // a motor's command is not the logged one, bit for bit
  long first_line; // of the log that differs; 0: none
  double worst_N;  // largest difference of a motor
} replay_part_t;

typedef struct {
  replay_part_t known;             // calls with a known history
  replay_part_t settling, settled; // without: up to REPLAY_SETTLE_CALLS after the loss, and later
  uint32_t first_call;             // of the log, since the controller was selected; 0: it does not say
  long missing;                    // calls missing between two that were replayed
  long torn;                       // rows whose two stamps differ; they are not used, even if they are calls
  long incomplete;  // calls whose state or set point is not in the log; between two that were, also in
                    // `missing`
  long tuned_line;  // where other parameters were taken first; 0: nowhere
  char damage[400]; // of the file, behind its last row; empty: none
} replay_t;

// BAD_INPUT: no such log, a column is missing or not a number, no call. BAD_INPUT too: as flight_init.
MUST_CHECK done_t replay_fly(const char *path, const flight_param_t *param, replay_t *result, why_t *why);

// All three.
replay_part_t replay_all(const replay_t *r);

#endif
