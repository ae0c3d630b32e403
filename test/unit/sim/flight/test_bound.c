// test_bound.c - the least height error that any controller could have: by hand where that can be done,
// beside the numbers of another program, and as a bound.
#include "flight/bound_plant.h"
#include "flight/scenario.h"
#include "rig/test.h"

static setup_t thesis(void) {
  setup_t setup;
  why_t why;
  CHECK_OK(setup_thesis(&setup, FLY_INDI_THEORY, &why));
  return setup;
}

static bound_plant_t below(double gap_m, bound_force_t force) {
  static setup_t setup;
  setup = thesis();
  return bound_plant(&setup.model, noise_find("real"), gap_m, force);
}

TEST(bound_takes_the_vehicle_and_the_level_for_what_they_are) {
  const bound_plant_t p = below(0.02, (bound_force_t){0});
  const double excess = 0.44 * exp(-80.0 * 0.02);
  CHECK_NEAR(p.stiffness_per_s2, 9.81 * 80.0 * excess / (1.0 + excess), 1e-4);
  CHECK_NEAR(p.tau_s, 0.08, 1e-12);
  CHECK_NEAR(p.delay_s, 0.004, 1e-12);
  CHECK_NEAR(p.room_mps2, 0.48 * (1.0 + excess) / 0.0329 - 9.81, 1e-9);
  CHECK_NEAR(p.down.sd_m, sqrt(0.0025 * 0.0025 + 1e-6 / 12.0), 1e-12);
  CHECK(p.down.period_ms == 25 && p.down.age_ms == 13);
  CHECK(!isfinite(p.up.sd_m));                             // nearer than its floor
  CHECK(isfinite(below(0.1, (bound_force_t){0}).up.sd_m)); // not there
  // Filtered white noise has 0.008 g: 30 Hz of 500 Hz is left of it.
  CHECK_NEAR(p.acc_mps2, 0.008 * 9.81 / sqrt(1.1107 * 2.0 * 30.0 / 1000.0), 0.005);
}

// An unstable pole and a range sensor alone: with P the variance after a sample of variance r,
//
//   1/P = 1/(P e) + 1/r,   e = exp(2 lambda period)   =>   P = r (1 - 1/e)
//
// of which exp(2 lambda t) is left t later; what is known of the stable part is all, in the end.
TEST(bound_knows_of_an_unstable_height_what_a_scalar_filter_does) {
  static const double lambda[] = {1.0, 4.0, 8.0, 12.0};
  for (int i = 0; i < 4; i++) {
    ROW("%g 1/s", lambda[i]);
    bound_plant_t p = below(0.02, (bound_force_t){0});
    p.stiffness_per_s2 = lambda[i] * lambda[i];
    p.acc_mps2 = HUGE_VAL;
    const double step = 2e-3 * lambda[i];
    double sum = 0.0;
    for (int ms = p.down.age_ms; ms < p.down.age_ms + p.down.period_ms; ms++) sum += exp(step * ms);
    const double after = p.down.sd_m * p.down.sd_m * (1.0 - exp(-step * p.down.period_ms));
    CHECK_NEAR(bound_of(&p).known_m, sqrt(after * sum / p.down.period_ms), 1e-7);
  }
}

// By a program that was written apart from this one, with a weight on the command instead of a limit.
TEST(bound_is_near_that_of_another_program) {
  static const struct {
    double gap_m, still_mm, walk_mm;
  } row[] = {{0.1, 0.33, 1.25}, {0.04, 1.15, 1.26}, {0.02, 0.83, 1.00}, {0.01, 0.56, 0.74}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%g m", row[i].gap_m);
    const bound_plant_t still = below(row[i].gap_m, (bound_force_t){0}),
                        walk = below(row[i].gap_m, (bound_force_t){.walk_mps2 = 0.1});
    CHECK_NEAR(1e3 * bound_of(&still).rms_m, row[i].still_mm,
               0.04); // near the ceiling the motors have more room
    CHECK_NEAR(1e3 * bound_of(&walk).rms_m, row[i].walk_mm, 0.03);
  }
}

TEST(bound_uses_what_the_motors_have_and_no_more) {
  const bound_plant_t p = below(0.02, (bound_force_t){.gust_mps2 = 0.1, .gust_tau_s = 0.3});
  const bound_t b = bound_of(&p);
  CHECK_NEAR(3.0 * b.command_mps2, p.room_mps2, 0.01 * p.room_mps2);
  CHECK(b.rms_m > b.known_m);
}

typedef void (*change_t)(bound_plant_t *p);
static void slower(bound_plant_t *p) {
  p->tau_s *= 1.3;
}
static void later(bound_plant_t *p) {
  p->delay_s += 0.01;
}
static void noisier(bound_plant_t *p) {
  p->acc_mps2 *= 2.0;
}
static void coarser(bound_plant_t *p) {
  p->down.sd_m *= 2.0;
}
static void older(bound_plant_t *p) {
  p->down.age_ms += 40;
}
static void tighter(bound_plant_t *p) {
  p->room_mps2 *= 0.3;
}
static void windier(bound_plant_t *p) {
  p->force.gust_mps2 *= 2.0;
}

TEST(bound_grows_with_everything_that_makes_flight_harder) {
  static const struct {
    const char *what;
    change_t change;
  } row[] = {{"motors", slower}, {"delay", later},  {"accelerometer", noisier}, {"range", coarser},
             {"age", older},     {"room", tighter}, {"gusts", windier}};
  const bound_plant_t usual = below(0.02, (bound_force_t){.gust_mps2 = 0.1, .gust_tau_s = 0.3});
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    bound_plant_t harder = usual;
    row[i].change(&harder);
    CHECK(bound_of(&harder).rms_m > 1.005 * bound_of(&usual).rms_m);
  }
}

TEST(bound_without_noise_and_force_is_nothing) {
  bound_plant_t p = below(0.02, (bound_force_t){0});
  p.acc_mps2 = p.down.sd_m = 0.0;
  CHECK_NEAR(bound_of(&p).rms_m, 0.0, 1e-9);
}

TEST(bound_of_gusts_lies_between_those_of_the_calmest_and_the_worst_flight) {
  const setup_t setup = thesis();
  const noise_t *const flown = noise_find("flown");
  const bound_plant_t calm = below(0.02, (bound_force_t){.gust_mps2 = 0.05, .gust_tau_s = 0.3}),
                      worst = below(0.02, (bound_force_t){.gust_mps2 = 0.15, .gust_tau_s = 0.3});
  const double rms_m = bound_of_gusts(&setup.model, flown, 0.02).rms_m;
  CHECK(rms_m > bound_of(&calm).rms_m && rms_m < bound_of(&worst).rms_m);
  noise_t none = *flown;
  none.vary.gust_min_mps2 = none.vary.gust_max_mps2 = 0.0;
  const bound_plant_t still = below(0.02, (bound_force_t){0});
  CHECK_NEAR(bound_of_gusts(&setup.model, &none, 0.02).rms_m, bound_of(&still).rms_m, 1e-9);
}

TEST(nobody_flies_better_than_the_bound) {
  static const fly_kind_t kind[] = {FLY_INDI_THEORY, FLY_STOCK_PID};
  for (int i = 0; i < 2; i++) {
    ROW("%s", fly_name[kind[i]]);
    setup_t setup = thesis();
    setup.kind = kind[i];
    const request_t request = {.integrate = INTEGRATE_RK4, .seed = 5, .kind = &kind[i]};
    why_t why;
    CHECK_OK(setup_apply(&setup, &request, &why));
    setup_ladder(&setup, (const double[]){0.1}, 1, 10.0);
    setup.plan.end_s = 30.0;
    flown_t flown;
    if (!CHECK_OK(setup_fly(&setup, &flown, &why))) continue;
    const bound_plant_t p = below(0.1, (bound_force_t){0});
    CHECK(flown.segment[0].sd_mm > 1e3 * bound_of(&p).rms_m);
    flown_free(&flown);
  }
}
