// setup.h - everything that one flight needs: model, controller, plan; and what a person changes of it.
#ifndef SIM_FLIGHT_SETUP_H
#define SIM_FLIGHT_SETUP_H

#include "flight/loop.h"
#include "flight/params.h"
#include "flight/segments.h"
#include "pilots/param_spec.h"
#include "pilots/pid.h"
#include "sense/noise6.h"

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

// The name on the command line; a null pointer for what cannot be asked for.
extern const char *const fly_name[FLY_COUNT];

typedef struct {
  model_t model;
  flight_param_t flight;
  rbf_weights_t learn_from; // what a learning flight starts with
  pid_param_t pid;
  double period_s; // of the controller
  fly_kind_t kind;
  plan_t plan;
} setup_t;

#define REQUEST_MAX 128

struct usd_deck;

// What the command line asks for, over what the scenario brings.
typedef struct {
  const fly_kind_t *kind; // null: the scenario's
  const model_t *vehicle; // null: the scenario's
  // Null: the scenario's. noise acts on the vertical axis, noise6 in six degrees of freedom.
  const noise_t *noise;
  const noise6_t *noise6;
  noise6_t noise6_changed; // where it points to if the command line changes a level
  fx_use_t effect[FX_MAX];
  int n_effect;
  bool no_effects; // first switches off what the scenario has
  param_set_t set[REQUEST_MAX];
  int n_set;
  bool log;             // keeps the app's logs, in six degrees of freedom
  bool log_calls;       // with log: the app's logs of every call, and nothing else; six degrees of freedom
  bool log_500_Hz;      // six degrees of freedom: a sample every 2 ms instead of 10
  struct usd_deck *usd; // on board, six degrees of freedom; null: none
  uint64_t seed;
  integrate_kind_t integrate;
} request_t;

// What is asked for, over the scenario's model, parameters, start of learning and controller.
// BAD_INPUT: too many effects, or parameters that contradict each other.
MUST_CHECK done_t request_apply(const request_t *request, model_t *model, flight_param_t *flight,
                                rbf_weights_t *learn_from, fly_kind_t *kind, why_t *why);

// BAD_INPUT: too many effects, or parameters that contradict each other.
MUST_CHECK done_t setup_apply(setup_t *setup, const request_t *request, why_t *why);

// A flight that was flown.
typedef struct {
  plan_t plan;
  record_t record;
  outcome_t outcome;
  segment_t segment[WAYPOINTS_MAX];
  int n_segment;
  rbf_weights_t weights;  // at the end of the flight, where the flight code flew
  flight_param_t shipped; // what ships with that controller: what record.param is held against
} flown_t;

// FAILED: as loop_fly. BAD_INPUT: a filter that the controller's rate does not allow, or
// FLY_INDI_LEARNED where there is no ceiling to learn from. Free what was flown; on error nothing was.
MUST_CHECK done_t setup_fly(const setup_t *setup, flown_t *flown, why_t *why);

void flown_free(flown_t *flown);

// The parameters of one that flies are kept with what it did, and what ships beside them: every default, but
// for what the controller's name stands for, the curve's mode, where it learns from nothing 1 + 0, and where
// it has learned, what it learned. FAILED: no memory.
MUST_CHECK done_t setup_keep_params(fly_kind_t kind, const flight_param_t *flies, flown_t *flown, why_t *why);

// Hover 20 cm below the ceiling, then 10, 8, 6, 4, 2 cm, 10 s each (thesis section 5.3).
void setup_learning_ladder(plan_t *plan, double ceiling_m);

#endif
