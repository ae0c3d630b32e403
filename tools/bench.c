// bench.c - how fast the closed loop runs, as ratios to real time on one core. Prints, never judges.
#include "scenario/scenario.h"

#include <stdio.h>

#define RUNS     7
#define FLIGHT_S 600.0

typedef struct {
  const char *what;
  integrate_kind_t integrate;
  int noise;
} row_t;

// A ten-minute flight to and fro between 10 cm and 4 cm under the ceiling, learning all the way.
static status_t factor(const row_t *row, double *best, why_t *why) {
  setup_t setup;
  TRY(scenario_appendix_a_setup(&setup, FLY_INDI_LIVE, why));
  const request_t request = {.integrate = row->integrate, .noise = &noise_levels[row->noise], .seed = 1};
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
  return ST_OK;
}

int main(void) {
  static const row_t rows[] = {
      {"closed loop, learning, noise, SUNDIALS ERKStep 2 ms", INTEGRATE_SUNDIALS, 1},
      {"closed loop, learning, no noise, SUNDIALS ERKStep 2 ms", INTEGRATE_SUNDIALS, 0},
      {"closed loop, learning, noise, Runge-Kutta by hand 2 ms", INTEGRATE_RK4, 1},
      {"closed loop, learning, no noise, Runge-Kutta by hand 2 ms", INTEGRATE_RK4, 0},
      {"closed loop, learning, noise, SUNDIALS order 5 adaptive", INTEGRATE_REFERENCE, 1},
  };
  for (unsigned i = 0; i < sizeof rows / sizeof *rows; i++) {
    why_t why;
    double best;
    const status_t status = factor(&rows[i], &best, &why);
    if (status != ST_OK) return error_exit("bench", status, &why);
    printf("%-60s %7.0f x real time (best of %d)\n", rows[i].what, best, RUNS);
    fflush(stdout);
  }
  return 0;
}
