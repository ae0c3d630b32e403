// bench.c - how fast the closed loop runs, as ratios to real time on one core, and how a diagnosis grows.
// Prints, never judges.
#include "base/cpu_time.h"
#include "base/lane.h"
#include "base/made.h"
#include "base/threads.h"
#include "bench_gap.h"
#include "body/body.h"
#include "flight/scenario.h"
#include "flight/setup.h"
#include "flight/together.h"
#include "vehicle/model_file.h"

#include <stdio.h>
#include <string.h>

#define RUNS     7
#define FLIGHT_S 600.0
#define TICK_S   0.002
#define CALLS    200000

typedef struct {
  const char *what;
  integrate_kind_t integrate;
  int noise;
} row_t;

// A ten-minute flight to and fro between 10 cm and 4 cm under the ceiling, learning all the way.
static done_t factor(const row_t *row, double *best, why_t *why) {
  setup_t setup;
  TRY(scenario_appendix_a_setup(&setup, FLY_INDI_LIVE, why));
  const request_t request = {
      .integrate = row->integrate, .vertical_noise = &vertical_noise_levels[row->noise], .seed = 1};
  TRY(setup_apply(&setup, &request, why));
  setup.plan.n_way = WAYPOINTS_MAX;
  setup.plan.end_s = FLIGHT_S;
  for (int i = 0; i < WAYPOINTS_MAX; i++)
    setup.plan.way[i] = (waypoint_t){FLIGHT_S / WAYPOINTS_MAX * i, i % 2 ? 0.46 : 0.40};
  *best = 0.0;
  for (int run = 0; run < RUNS; run++) {
    flown_t flown;
    TRY(setup_fly(&setup, &flown, why));
    if (flown.outcome.realtime_factor > *best) *best = flown.outcome.realtime_factor;
    flown_free(&flown);
  }
  return DONE;
}

// Six degrees of freedom at 2 cm below a ceiling, with drag; level, so that a control law of one line holds
// it there.
static done_t six(integrate_kind_t kind, double *derivative_ns, double *factor, why_t *why) {
  static body_t b;
  model_t m;
  TRY(model_builtin("cf21_legacy", &m, why));
  const fx_use_t ceiling = fx_use(fx_find("ceiling"));
  TRY(model_add_fx(&m, &ceiling, why));
  m.ceiling_m = 1.0;
  const double z_m = 0.98 - body_rotor_z_m(&m), f = 0.25 * m.mass_kg * G_MPS2;
  const body_start_t start = {.pos_w_m = {0.0, 0.0, z_m}, .thrust_N = {f, f, f, f}};
  if (body_open(&b, &m, kind, TICK_S, &start) != DONE) return error_failed(why, "out of memory");
  double t_s = cpu_time_s(), y[RIGID_N], dydt[RIGID_N] = {0.0};
  memcpy(y, b.y, sizeof y);
  for (int i = 0; i < CALLS; i++) {
    y[RIGID_POS_M + 2] = z_m + 1e-9 * dydt[RIGID_VEL_MPS + 2]; // so that no call can be optimised away
    body_derivative(&b, 0, y, dydt);
  }
  *derivative_ns = 1e9 * (cpu_time_s() - t_s) / CALLS;
  t_s = cpu_time_s();
  for (int i = 0; i < CALLS; i++) {
    const double c = 0.92 * f * (1.0 + 12.0 * (z_m - b.y[RIGID_POS_M + 2]) - 2.0 * b.y[RIGID_VEL_MPS + 2]);
    const double command_N[ROTORS] = {c, c, c, c};
    body_tick(&b, command_N, TICK_S);
  }
  *factor = cpu_time_factor(CALLS * TICK_S, t_s);
  if (b.ceiling_contacts > 0) fprintf(stderr, "bench: the ceiling was touched\n");
  body_close(&b);
  return DONE;
}

static done_t bench_six(why_t *why) {
  static const char *const name[] = {"SUNDIALS ERKStep 2 ms", "Runge-Kutta by hand 2 ms"};
  double best_ns = 1e9;
  for (int k = INTEGRATE_SUNDIALS; k <= INTEGRATE_RK4; k++) {
    double best = 0.0, ns = 0.0, factor = 0.0;
    for (int run = 0; run < RUNS; run++) {
      TRY(six((integrate_kind_t)k, &ns, &factor, why));
      if (ns < best_ns) best_ns = ns;
      if (factor > best) best = factor;
    }
    printf("six degrees of freedom, plant alone, %-23s %7.0f x real time (best of %d)\n", name[k], best,
           RUNS);
  }
  printf("%-60s %7.0f ns (best of %d)\n", "  its right-hand side: 4 rotors, ceiling, drag, gyroscopic",
         best_ns, 2 * RUNS);
  return DONE;
}

// The upward range sensor fails for 0.3 s of every 2 s.
static void fail_range(void *context, const body_t *truth, pilot_in_t *in) {
  (void)context;
  if (fmod(truth->t_s, 2.0) < 0.3) in->range_m = (double)NAN;
}

typedef struct {
  const char *what;
  integrate_kind_t integrate;
  fly_kind_t kind;
  bool faults;
} loop_row_t;

// The complete loop: body, real sensors, estimator and the whole flight code, in the thesis's test flight.
// The request must outlive the setup.
static done_t loop_setup(const loop_row_t *row, request_t *request, setup_t *setup, why_t *why) {
  static const double gap_m[] = {0.20, 0.09, 0.05, 0.03};
  *request = (request_t){.integrate = row->integrate, .seed = 1};
  if (row->faults) {
    request->noise = noise_find("flown");
    request->effect[request->n_effect++] = fx_use(fx_find("motor_damage"));
  }
  TRY(setup_thesis(setup, row->kind, why));
  TRY(setup_apply(setup, request, why));
  setup->flight.guard.blind_max_s = SETUP_BLIND_S;
  setup_ladder(setup, gap_m, 4, 10.0);
  if (row->faults) setup->plan.edit = fail_range;
  return DONE;
}

static done_t bench_loop(why_t *why) {
  static const loop_row_t rows[] = {
      {"SUNDIALS ERKStep 2 ms", INTEGRATE_SUNDIALS, FLY_INDI_RBF, false},
      {"Runge-Kutta by hand 2 ms", INTEGRATE_RK4, FLY_INDI_RBF, false},
      {"the same, learning live", INTEGRATE_RK4, FLY_INDI_LIVE, false},
      {"and with faults", INTEGRATE_RK4, FLY_INDI_LIVE, true},
  };
  for (unsigned i = 0; i < sizeof rows / sizeof *rows; i++) {
    request_t request;
    setup_t setup;
    TRY(loop_setup(&rows[i], &request, &setup, why));
    double best = 0.0;
    for (int run = 0; run < RUNS; run++) {
      flown_t flown;
      TRY(setup_fly(&setup, &flown, why));
      best = fmax(best, flown.outcome.realtime_factor);
      flown_free(&flown);
    }
    printf("six degrees of freedom, complete loop, %-24s %5.0f x real time (best of %d)\n", rows[i].what,
           best, RUNS);
  }
  return DONE;
}

#define ABREAST 16 // flights, with seeds that count up

typedef struct {
  setup_t setup[ABREAST];
  done_t status;
  why_t why;
} abreast_flights_t;

static void fly_one(void *self, int i) {
  abreast_flights_t *const f = self;
  flown_t flown;
  why_t why;
  const done_t status = setup_fly(&f->setup[i], &flown, &why);
  if (status == DONE) flown_free(&flown);
  if (status == DONE || f->status != DONE) return;
  f->status = status;
  f->why = why;
}

// The same loop: flights that one core flies side by side, compared with the same flights one by one.
static done_t bench_abreast(why_t *why) {
  static const loop_row_t rows[] = {
      {"SUNDIALS ERKStep 2 ms", INTEGRATE_SUNDIALS, FLY_INDI_RBF, false},
      {"Runge-Kutta by hand 2 ms", INTEGRATE_RK4, FLY_INDI_RBF, false},
  };
  for (unsigned i = 0; i < sizeof rows / sizeof *rows; i++) {
    request_t request;
    abreast_flights_t f = {.status = DONE};
    for (int k = 0; k < ABREAST; k++) {
      TRY(loop_setup(&rows[i], &request, &f.setup[k], why));
      f.setup[k].plan.seed = 1 + (uint64_t)k;
    }
    const double flown_s = ABREAST * f.setup[0].plan.end_s;
    double one = 0.0, side = 0.0;
    for (int run = 0; run < RUNS; run++) {
      double t_s = cpu_time_s();
      for (int k = 0; k < ABREAST; k++) fly_one(&f, k);
      one = fmax(one, cpu_time_factor(flown_s, t_s));
      t_s = cpu_time_s();
      (void)together(ABREAST, fly_one, &f);
      side = fmax(side, cpu_time_factor(flown_s, t_s));
    }
    *why = f.why;
    if (f.status != DONE) return f.status;
    printf("  eight side by side (%d bits), %-27s %7.0f x real time (%.2f of one by one, best of %d)\n",
           lane_bits(), rows[i].what, side, side / one, RUNS);
  }
  return DONE;
}

static done_t one_by_one(why_t *why) {
  static const row_t rows[] = {
      {"closed loop, learning, noise, SUNDIALS ERKStep 2 ms", INTEGRATE_SUNDIALS, 1},
      {"closed loop, learning, no noise, SUNDIALS ERKStep 2 ms", INTEGRATE_SUNDIALS, 0},
      {"closed loop, learning, noise, Runge-Kutta by hand 2 ms", INTEGRATE_RK4, 1},
      {"closed loop, learning, no noise, Runge-Kutta by hand 2 ms", INTEGRATE_RK4, 0},
      {"closed loop, learning, noise, SUNDIALS order 5 adaptive", INTEGRATE_REFERENCE, 1},
  };
  for (unsigned i = 0; i < sizeof rows / sizeof *rows; i++) {
    double best;
    TRY(factor(&rows[i], &best, why));
    printf("%-60s %7.0f x real time (best of %d)\n", rows[i].what, best, RUNS);
    fflush(stdout);
  }
  return DONE;
}

static done_t loops(why_t *why) {
  TRY(bench_loop(why));
  return bench_abreast(why);
}

static done_t all(why_t *why) {
  TRY(one_by_one(why));
  TRY(bench_six(why));
  TRY(loops(why));
  return bench_gap(why);
}

int main(int argc, char **argv) {
  const char *const word = argc == 2 ? argv[1] : "";
  why_t why;
  threads_sleep(argv);
  if (strcmp(word, "--version") == 0) {
    made_version("bench");
    return 0;
  }
  if (strcmp(word, "loop") == 0) return error_exit("bench", loops(&why), &why);
  if (strcmp(word, "gap") == 0) return error_exit("bench", bench_gap(&why), &why);
  if (argc > 1) {
    const char *const allowed = "%s: allowed: bench, bench loop, bench gap, or bench --version";
    return error_exit("bench", error_set(&why, allowed, argv[argc - 1]), &why);
  }
  return error_exit("bench", all(&why), &why);
}
