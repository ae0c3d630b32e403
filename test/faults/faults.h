// faults.h - flies the vehicle under a ceiling with one fault, measures the flight, and judges it.
#ifndef TEST_FAULTS_FAULTS_H
#define TEST_FAULTS_FAULTS_H

#include "base/random.h"
#include "body/body.h"
#include "flight/setup.h"
#include "pilots/pilot_flight.h"

#define FAULTS_CEILING_M 0.5
#define FAULTS_END_S     12.0
#define FAULTS_EVER      1e3
#define FAULTS_HOVER_S   1.5 // fault-free hover before any fault
#define FAULTS_ERRORS    1100
#define FAULTS_FIRST_MS  50 // five ticks of the outer loop; later the vehicle's own response comes back

typedef struct row row_t;

// Measurements of a flight. Times count from the onset of the fault.
typedef struct {
  double gap_min_m, end_gap_m, up_max_mps; // up: largest climb within 5 cm of the ceiling
  float error_m[FAULTS_ERRORS];            // of the gap, every 10 ms from the onset on
  int n;                                   // number of errors
  double seen_s, moved_s; // times: reason latched, 2 cm away from its place at the onset; -1: never
  double hover_N, over_N; // hover thrust before the fault; largest command above it after the hand-over
  long handed_ms;
  double onset_z_m, rise_m;           // rise within 300 ms
  double tilt_max_deg, tilt_late_deg; // largest tilt; largest from 2 s on
  double tilt_cut_deg;                // tilt when the motors stopped; -1: they did not
  double yaw_late_deg;                // largest yaw from 2 s on
  double wanted_N, step_max_N;        // wanted thrust and its largest change in 10 ms, within 1 s
  float first_N[FAULTS_FIRST_MS];     // wanted thrust, in each millisecond from the onset on
  double ahead_N;                     // largest |wanted thrust - what the motors give| within 1 s
  double pulse_N, smooth_N;           // largest excess of the 50 ms mean over hover during the fault
  double zc_error_m;                  // largest error of the known distance, from 0.5 s on
  double shake2_early, shake2_late;   // mean square of the tilt rates in the first and in the fifth second
  double kick_N, kick_usual_N;        // largest 1 ms change of a motor's force: to 0.2 s after it; before it
  double rise_max_m;                  // largest height above the wanted one, after the onset
  double full_s, full_max_s,
      full_total_s;     // at full thrust: near the ceiling without a break, now and at most; in total
  double ratio_end;     // thrust ratio that the controller uses at the end
  double weight_change; // largest relative change of a weight until 0.2 s after the fault
  bool weights_moved;   // a weight's bits changed when it must not
  double touched_s;     // first contact with the ceiling after the onset; -1: none
  bool bad, shadow_differs;
  uint64_t bits;  // hash of all commands
  unsigned early; // reasons latched before the onset
} flown_fault_t;

#define FAULTS_UNSEEN                                                                                        \
  {                                                                                                          \
    .gap_min_m = HUGE_VAL, .seen_s = -1.0, .moved_s = -1.0, .touched_s = -1.0, .over_N = -HUGE_VAL,          \
    .tilt_cut_deg = -1.0                                                                                     \
  }

typedef struct {
  const row_t *row;
  random_t *r;
  double onset_s, length_s, size;
  unsigned pick;
  pilot_flight_t pilot, shadow; // shadow: gets the same inputs, if with_shadow
  pilot_t inner, shadow_pilot;
  plan_t plan;
  model_t model;
  flight_param_t param;
  double t_s, kept;
  d3_t kept3;
  double goal_m; // commanded gap; changed by rows that move
  bool usual;    // flown without the fault
  bool skip, twice, with_shadow;
  bool frozen_weights, frozen_always; // the weights must not change now; at no time
  bool memory_broken;                 // the row broke the learner's memory at the onset
  double last_N[ROTORS];
  uint32_t step_off;
  rbf_weights_t weights, weights_before; // before the fault; before this millisecond
  // The last look of faults_watch.c.
  rls_t learner;
  bool learner_in_box, seen_tick, again;
  double tick_s, nearest_m, told_N, up;
  double tilt_cosine, late_cosine, yaw_sine, yaw_cosine; // of the largest angles
  flown_fault_t seen;
} case_t;

struct row {
  const char *name;
  char cls; // see the head of test_faults.c
  double gap_m, length_lo, length_hi, size_lo, size_hi;
  void (*edit)(case_t *c, pilot_in_t *in, double since_s); // every millisecond while the fault lasts
  unsigned reasons;                                        // at least one of them must be latched; 0: none
  double within_s;
  double promise;           // per cent of many that are kept; src/README.md lists those below 100
  void (*begin)(case_t *c); // before the flight
  const char *(*also)(const case_t *c, const flown_fault_t *usual); // the row's own criterion; null: kept
  double recover_s;                                                 // 0: 2 s
  bool same_bits; // every command is that of the flight without the fault
  bool touches;   // it is not promised that the ceiling is never touched
};

// The table, in four parts: what the pilot is told of motion; what it is told of the ceiling; the vehicle;
// what is asked for, and the pilot's own memory.
typedef struct {
  const row_t *row;
  int n;
} rows_t;

rows_t faults_of_motion(void);
rows_t faults_of_range(void);
rows_t faults_of_vehicle(void);
rows_t faults_of_state(void);
rows_t faults_of_patience(void); // a long flight, not in the table

// Flies the row's flight of that seed; without its fault if `usual`.
void faults_fly(case_t *c, const row_t *row, uint64_t seed, bool usual);

// Looks at the flight, every millisecond, before the pilot does.
void faults_watch(case_t *c, const body_t *truth);

// Returns the first criterion that the flight fails; null: none. usual: the flight of the same seed without
// the fault.
const char *faults_judge(const case_t *c, const flown_fault_t *usual);

// Prints the flight for people.
void faults_tell(const case_t *c, uint64_t seed, const char *failed, const flown_fault_t *usual);

// Mean and root mean square of the gap's error, from the time at which the flight must have recovered.
double faults_mean_m(const case_t *c, const flown_fault_t *f);
double faults_rms_m(const case_t *c, const flown_fault_t *f);
// Largest difference of the wanted thrust from the usual flight's in the first FAULTS_FIRST_MS.
double faults_added_N(const flown_fault_t *f, const flown_fault_t *usual);

// Returns the case's pilot, for a row that changes its memory or parameters, or that has it called more or
// less than once.
pilot_flight_t *faults_pilot(case_t *c);

// Changes to the model's effects, for the table.
void faults_set_fx(case_t *c, const char *name, int p, double value);
void faults_add_fx(case_t *c, const char *name);

#endif
