// glue.h - the app's one state: what the firmware's parameters and logs point into.
//
// On the vehicle there is one. The host flies many at once: sim/crazyflie says which one this thread flies,
// and turns the addresses of parameters and logs into that one's.
#ifndef FIRMWARE_GLUE_H
#define FIRMWARE_GLUE_H

#include "flight/flight.h"
#include "flight/flyable.h"
#include "range_up.h"

typedef struct {
  flight_param_t tuned; // as the parameters are written, one by one and at any time
  flight_param_t flown; // the last set that passed its checks as a whole; its weights are the committed ones
  flight_param_t candidate; // a set that has passed them and waits for the next tick, if `ready`
  uint8_t shadow;           // ceil.shadow: 1: the stock controller flies, this one computes and logs
  uint8_t commit;           // ceil.commit: COMMIT_*, 0 when done
  uint8_t commit_asked;     // what of it belongs to the candidate
  volatile uint8_t ready;
  uint8_t decks;         // DECK_*
  uint32_t sets_refused; // parameter sets that failed their checks
  uint32_t commits, commits_refused;
  bool learning;
  float stock_share; // of the stock controller in what is commanded: 0, 1, or on the way
  struct {
    int16_t roll, pitch, yaw;
  } stock; // what it commanded last
  range_up_t range;
  flyable_t flyable;
  flight_in_t in;
  flight_t flight;
} glue_t;

enum { COMMIT_TYPED = 1, COMMIT_LEARNED = 2 };
enum { DECK_FLOW = 1, DECK_MULTIRANGER = 2 };

// Parameters that are the app's own: X(name in group ceil, type, field of glue_t, largest, what it does).
#define APP_PARAMS(X)                                                                                        \
  X(commit, PARAM_UINT8, commit, 2,                                                                          \
    "1 takes ceil.w1..w7 at once, 2 the learned rls.w1..w7; refused while learning; 0 when done")            \
  X(shadow, PARAM_UINT8, shadow, 1, "1: the stock controller flies, this one computes and logs")

extern glue_t glue_static;

#ifndef GLUE
#define GLUE glue_static
#endif

#endif
