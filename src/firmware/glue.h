// glue.h - the app's whole state, into which the firmware's parameters and logs point.
//
// The vehicle has one. The host flies many at once: sim/crazyflie says which one this thread flies, and maps
// the addresses of parameters and logs to it.
#ifndef FIRMWARE_GLUE_H
#define FIRMWARE_GLUE_H

#include "flight/flight.h"
#include "flight/flyable.h"
#include "range_up.h"

enum { PUT_BACK_WORDS = (sizeof(flight_param_t) / sizeof(float) + 31) / 32 }; // a bit for each row

// State of radio.c.
typedef struct {
  bool descends;
  uint32_t since_ms, fed_ms; // begin of the descent; when this app last fed the watchdog
} radio_t;

// State of recorder.c: what the uSD deck was given last.
typedef struct {
  uint32_t calls;     // since the controller was selected; stops at its largest
  uint8_t state, set; // count the rows of each event; wrap
  uint8_t tunes;      // sets of parameters taken since the selection; wraps
  bool wrote;         // the deck took the last call
  bool stale;         // estimate and set point are due to be written anew
  // As they were last written.
  uint8_t no_lesson, tunes_written;
  float range_m, range_age_s, down_m;
  v3_t pos_w_m, vel_w_mps;
  quat_t q_wb;
  flight_setpoint_t setpoint;
} recording_t;

typedef struct {
  uint8_t shadow;       // ceil.shadow: 1: the stock controller flies, this one computes and logs
  uint8_t commit;       // ceil.commit: COMMIT_*, 0 when done
  uint8_t commit_asked; // the commit that belongs to the candidate
  volatile uint8_t ready;
  uint8_t notifying;     // the client is being notified: writes are not the client's now
  uint8_t weights_mixed; // at the start the stored weights did not belong together
  uint32_t weights_sum;  // ceil.wSum: checksum stored with the weights, which shows that they are one set
  uint32_t sum_flown;    // its value for the weights that fly
  uint32_t sum_default;  // sum_of() the table's weights
  uint8_t started;
  uint32_t put_back[PUT_BACK_WORDS]; // rows of params_table whose value was refused, as bits
  uint8_t decks;                     // DECK_*
  uint8_t not_flown;                 // NOT_FLOWN_*, since the controller was selected
  uint32_t sets_refused;             // parameter sets that failed their checks
  uint32_t commits, commits_refused;
  bool learning;
  bool ground_starts; // its learner restarts with the committed weights in a tick to come
  bool could_fly;     // supervisorCanFly() in the last call
  float stock_share;  // of the stock controller in the command: 0, 1, or while fading between
  struct {
    int16_t roll, pitch, yaw;
  } stock; // the stock controller's last command
  range_up_t range;
  float down_mm;     // of the downward range sensor, as last read
  uint8_t down_same; // reads since then with the same value
  flyable_t flyable;
  recording_t recorder;
  radio_t radio;
  flight_in_t in;
  flight_t flight;
  // Last, so that one instruction can address the others.
  flight_param_t tuned; // as the parameters are written, one by one and at any time
  flight_param_t flown; // the last set that passed its checks as a whole; its weights are the committed ones
  flight_param_t candidate; // if `ready`: a set that has passed its checks and waits for the next tick
} glue_t;

enum { COMMIT_TYPED = 1, COMMIT_LEARNED = 2 };
enum { DECK_FLOW = 1, DECK_MULTIRANGER = 2 };
// Set points, or parts of them, that this controller does not fly.
enum { NOT_FLOWN_RATES = 1, NOT_FLOWN_QUAT = 2, NOT_FLOWN_TURN = 4 };

// Parameters that are the app's own: X(name in group ceil, type, field of glue_t, default, largest, what it
// does). A vehicle on which nothing else was set flies the stock controller.
#define APP_PARAMS(X)                                                                                        \
  X(commit, PARAM_UINT8, commit, 0, 2,                                                                       \
    "1 takes the weights w1..w7 of ceil and ground at once, 2 the learned ones; refused while learning; 0 "  \
    "when done")                                                                                             \
  X(shadow, PARAM_UINT8 | PARAM_PERSISTENT, shadow, 1, 1,                                                    \
    "1: the stock controller flies, this one computes and logs")

extern glue_t glue_static;

#ifndef GLUE
#define GLUE glue_static
#endif

#endif
