// test_ladder.c - the ladder below a ceiling, and what is logged of the ceiling's height.
#include "flight/setup.h"
#include "rig/test.h"

#include <math.h>
#include <string.h>

static bool fly(int hold, flown_t *flown) {
  setup_t setup;
  why_t why;
  const request_t request = {.seed = 1, .integrate = INTEGRATE_RK4};
  if (!CHECK_OK(setup_thesis(&setup, FLY_INDI_THEORY, &why))) return false;
  if (!CHECK_OK(setup_apply(&setup, &request, &why))) return false;
  const double gap_m[] = {0.25, 0.10};
  setup_ladder(&setup, gap_m, 2, 10.0);
  setup.flight.hold = hold;
  return CHECK_OK(setup_fly(&setup, flown, &why));
}

TEST(setup_ladder_counts_from_the_estimated_ceiling_and_from_20_cm_on_from_the_latched_one) {
  for (int hold = 0; hold < 2; hold++) {
    ROW("ceil.hold %d", hold);
    flown_t flown;
    if (!fly(hold, &flown)) return;
    const record_t *r = &flown.record;
    double low_m = HUGE_VAL, high_m = -HUGE_VAL, off_m = 0.0, gap_off_m = 0.0;
    for (int i = 0; i < r->n; i++) {
      const sample_t *s = &r->sample[i];
      if (s->t_s < 15.0) continue; // 10 cm below from 12 s on
      low_m = fmin(low_m, s->thoughts.ceiling_z_m);
      high_m = fmax(high_m, s->thoughts.ceiling_z_m);
      off_m = fmax(off_m, fabs(s->thoughts.ceiling_z_m - s->sense.z_m - s->thoughts.zc_m));
      const double gap_m = s->thoughts.ceiling_z_m - s->setpoint_z_m;
      gap_off_m = fmax(gap_off_m, fabs(gap_m - 0.10));
    }
    CHECK_NEAR(0.5 * (low_m + high_m), 0.47, 0.01); // of the rotors, from their height at rest
    CHECK(hold ? high_m == low_m : high_m > low_m + 1e-4);
    if (!hold) CHECK_NEAR(off_m, 0.0, 3e-3); // the estimate is some milliseconds older than the log
    CHECK_NEAR(gap_off_m, 0.0, hold ? 1e-9 : 2e-3);
    flown_free(&flown);
  }
}

// A mass that an effect makes nothing of: the body cannot be opened, after the app was.
TEST(setup_leaves_nothing_to_free_of_a_flight_that_failed) {
  static const fly_kind_t kind[] = {FLY_INDI_THEORY, FLY_INDI_LEARNED, FLY_STOCK_PID};
  for (unsigned i = 0; i < sizeof kind / sizeof *kind; i++) {
    ROW("%s", fly_name[kind[i]]);
    setup_t setup;
    flown_t flown;
    why_t why = {""};
    if (!CHECK_OK(setup_thesis(&setup, kind[i], &why))) return;
    setup.model.frame.inertia_kgm2[1] = 0.0;
    CHECK_STATUS(BAD_INPUT, setup_fly(&setup, &flown, &why));
    CHECK(strstr(why.text, "such a vehicle cannot fly") != NULL);
    const record_t *const r = &flown.record;
    CHECK(!r->sample && !r->app && !r->param);
  }
}
