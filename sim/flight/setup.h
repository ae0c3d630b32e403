// setup.h - everything that one flight needs: model, controller, plan; what the command line changes of it;
// and the flight's result.
#ifndef SIM_FLIGHT_SETUP_H
#define SIM_FLIGHT_SETUP_H

#include "flight/loop.h"
#include "flight/params.h"
#include "flight/segments.h"
#include "pilots/air_garage.h"
#include "pilots/param_spec.h"
#include "pilots/pid.h"

typedef enum {
  FLY_INDI,         // standard INDI: no ceiling term
  FLY_INDI_THEORY,  // ceiling term from 1 + ca exp(-cb zc)
  FLY_INDI_RBF,     // from the fixed weights ceil.w1..w7
  FLY_INDI_LEARNED, // from weights learned in a learning flight before, then frozen
  FLY_INDI_LIVE,    // from the weights while they are being learned: the learning flight itself
  FLY_PID,          // thesis section 4.2; on the vertical axis
  FLY_PID_FF,
  FLY_STOCK_PID, // the firmware's, in six degrees of freedom; so the next two
  FLY_STOCK_INDI,
  FLY_AIR_GARAGE, // the stock PID, its thrust divided by a ground and ceiling ratio
  FLY_COUNT
} fly_kind_t;

// The name on the command line; a null pointer for a kind that cannot be asked for.
extern const char *const fly_name[FLY_COUNT];

#define REQUEST_MAX 128

struct usd_deck;

// What the command line asks for; overrides what the scenario brings.
typedef struct {
  const fly_kind_t *kind; // null: the scenario's
  bool thesis_law;        // param_thesis() before `set`
  const model_t *vehicle; // null: the scenario's
  const noise_t *noise;   // null: the scenario's; so the next
  const vertical_noise_t *vertical_noise;
  noise_t noise_changed; // where `noise` points to if the command line changes a level
  fx_use_t effect[FX_MAX];
  int n_effect;
  bool no_effects; // switches off what the scenario has; what the vehicle has stays
  param_set_t set[REQUEST_MAX];
  int n_set;
  bool log;             // keeps the app's logs, in six degrees of freedom
  bool log_calls;       // with log: the app's logs of every call, and nothing else; six degrees of freedom
  bool log_500_Hz;      // six degrees of freedom: a sample every 2 ms instead of 10
  struct usd_deck *usd; // deck on board, six degrees of freedom; null: none
  uint64_t seed;
  integrate_kind_t integrate;
} request_t;

typedef struct {
  model_t model;
  flight_param_t flight;
  rbf_weights_t learn_from; // weights that a learning flight starts with
  bool floor_learned;       // flight.ground's weights were learned in an earlier flight
  fly_kind_t kind;
  pid_param_t pid;
  stock_pid_param_t stock_pid;
  air_garage_param_t air_garage; // infinitely far ceiling: the model's is used, counted from the propellers
  plan_t plan;
  const request_t *request; // parameters of the app, and whether its logs are kept; null: neither
} setup_t;

// The thesis's experiments: a Crazyflie 2.1 with both decks under a ceiling at 0.5 m whose effect is
// 1 + 0.44 exp(-80 zc) at every rotor; sensors as bad as the real ones; the flight code as it ships.
// BAD_INPUT: a fault of the build, not of the user.
MUST_CHECK done_t setup_thesis(setup_t *setup, fly_kind_t kind, why_t *why);

// Applies the request to the scenario's setup. The firmware's controllers get the propellers of the vehicle.
// BAD_INPUT: too many effects, parameters that contradict each other, or something that cannot fly, act or be
// logged in this scenario; for the firmware's controllers, parameters or propellers that they do not know.
MUST_CHECK done_t setup_apply(setup_t *setup, const request_t *request, why_t *why);

// ceil.blindMax for the thesis's flights, which stay below the range sensor's floor for longer than the guard
// of the shipped set allows.
#define SETUP_BLIND_S 60.0f

// Plans waypoints at these gaps below the ceiling, hold_s each. In six degrees of freedom the flight begins
// with a take-off and a hover at the first, and gaps count from the controller's estimate of the ceiling; a
// controller that has none is told where the ceiling is.
void setup_ladder(setup_t *setup, const double *gap_m, int n, double hold_s);

// The ladder of the close flight and of the learning flight (thesis section 5.3): 20 cm, then 10 to 2 cm in
// steps of 2 cm, 10 s each.
void setup_close_ladder(setup_t *setup);

// A flight that was flown.
typedef struct {
  plan_t plan;
  record_t record;
  outcome_t outcome;
  segment_t segment[WAYPOINTS_MAX];
  int n_segment;
  // At the end of the flight, where the flight code flew.
  rbf_weights_t weights, ground_weights;
  flight_param_t shipped; // what ships with that controller, to compare record.param with
} flown_t;

// Flies the setup. Errors as loop_fly; BAD_INPUT also for a filter that the controller's rate does not allow,
// and for FLY_INDI_LEARNED where there is no ceiling to learn from. After an error there is nothing to free;
// else free *flown.
MUST_CHECK done_t setup_fly(const setup_t *setup, flown_t *flown, why_t *why);

void flown_free(flown_t *flown);

#endif
