// test_gap_slow_errors.c - errors of the estimates that last, axis by axis (3_feedback/slow_errors.h).
#include "base/random.h"
#include "gap/3_feedback/slow_errors.h"
#include "rig/test.h"

#include <math.h>
#include <stdlib.h>

#define POINTS   6000
#define PERIOD_S 0.02

// A vehicle that stands still, whose place errs by axis for a while (first order) and from point to point.
static grid_t still_but_for_errors(grid_point_t *point, const double sd[3], double tau_s, double white) {
  random_t *const random = random_open(7);
  const double keep = exp(-PERIOD_S / tau_s);
  double slow[3] = {0.0};
  for (int j = 0; j < POINTS; j++) {
    point[j] = (grid_point_t){.t_s = j * PERIOD_S, .ok = true, .q_wb = {.w = 1.0}};
    double at[3];
    for (int i = 0; i < 3; i++) {
      slow[i] = keep * slow[i] + sd[i] * sqrt(1.0 - keep * keep) * random_normal(random);
      at[i] = slow[i] + white * random_normal(random);
    }
    point[j].seen_w_m = d3_of(at);
  }
  random_close(random);
  return (grid_t){
      .point = point, .n = POINTS, .period_s = PERIOD_S, .has_position = true, .has_velocity = true};
}

TEST(gap_tells_the_errors_of_a_height_from_those_of_a_place) {
  static const struct {
    const char *what;
    double sd[3], white;
  } row[] = {
      {"height three times better", {0.009, 0.009, 0.003}, 0.0},
      {"and white noise, which is not counted twice", {0.009, 0.006, 0.003}, 0.002},
      {"nothing lasts", {0.0, 0.0, 0.0}, 0.002},
  };
  grid_point_t *const point = malloc(POINTS * sizeof *point);
  if (!point) abort();
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    const double w = row[i].white;
    const grid_t g = still_but_for_errors(point, row[i].sd, 0.08, w);
    const white_error_t white = {.pos_m = {w, w, w}};
    slow_t pos, vel, angle;
    slow_errors(&g, &white, &pos, &vel, &angle);
    for (int k = 0; k < 3; k++) {
      CHECK_NEAR(pos.sd[k], row[i].sd[k], 0.1 * row[i].sd[k] + 3e-4);
      if (row[i].sd[k] > 0.0) CHECK_NEAR(pos.tau_s[k], 0.08, 0.02);
      CHECK(vel.sd[k] == 0.0 && angle.sd[k] == 0.0); // the log has neither
    }
  }
  free(point);
}
