// test_learning_flight.c - the curve learned in simulated learning flights at noise N1, and flying with it,
// and the sweeps of the thesis's appendix B.
#include "flight/training.h"
#include "rig/flights.h"
#include "rig/share.h"
#include "rig/bells.h"
#include "rig/test.h"

#include <math.h>
#include <string.h>

#define SEEDS      10
#define SEEDS_LONG 200

// A learning flight from the weights `from`, in a plant whose ceiling has the coefficients ca, cb.
static setup_t learning_setup(const rbf_weights_t *from, double ca, double cb, uint64_t seed) {
  setup_t setup = flights_appendix_a(FLY_INDI_LIVE, 8.0f, 0.3f, true);
  setup.learn_from = *from;
  setup.model.fx[0].p[0] = ca;
  setup.model.fx[0].p[1] = cb;
  setup.plan.vertical_noise = vertical_noise_levels[1];
  setup.plan.seed = seed;
  setup_close_ladder(&setup);
  return setup;
}

static rbf_weights_t learn(const setup_t *setup) {
  flown_t flown;
  why_t why;
  if (!CHECK_OK(setup_fly(setup, &flown, &why))) return (rbf_weights_t){{0.0f}};
  CHECK(flown.outcome.contacts == 0);
  const rbf_weights_t w = flown.weights;
  flown_free(&flown);
  return w;
}

// Hovers 40 s at the gap with these weights; arrives from 4 cm.
static int contacts_at(const rbf_weights_t *w, const setup_t *learned, double gap_m) {
  setup_t setup = *learned;
  setup.kind = FLY_INDI_RBF;
  setup.flight.curve.mode = CURVE_FIXED;
  setup.flight.curve.fixed = *w;
  setup.plan.way[0] = (waypoint_t){0.0, 0.46};
  setup.plan.way[1] = (waypoint_t){10.0, 0.5 - gap_m};
  setup.plan.n_way = 2;
  setup.plan.end_s = 50.0;
  setup.plan.start_z_m = 0.40;
  setup.plan.start_thrust_N = 0.032 * 9.81;
  int contacts;
  flights_last(&setup, &contacts);
  return contacts;
}

static const rbf_weights_t ONES = {{1.0f}};

TEST(learning_flight_finds_the_curve_where_it_has_been) {
  const int seeds = test_long() ? SEEDS_LONG : SEEDS;
  int close = 0, low = 0;
  double sum = 0.0;
  for (int i = 0; i < seeds; i++) {
    const uint64_t seed = share_seed(1) + (uint64_t)i;
    ROW("seed %d", (int)seed);
    const setup_t setup = learning_setup(&ONES, 0.44, 1.8, seed);
    const rbf_weights_t w = learn(&setup);
    const misfit_t m = training_misfit(&w, &setup.model, 0.02, 0.10);
    close += m.rms < 0.003 && m.max < 0.012;    // what was promised
    low += m.at_1cm < 0.0 && m.peak_m <= 0.016; // nearer than it has been the curve is too low
    sum += m.rms;
  }
  ROW("%d flights", seeds);
  CHECK_SHARE(close, seeds, 0.9); // 190 of 200 were
  CHECK_SHARE(low, seeds, 0.98);
  // The prototype's mean, 0.3e-3 for its own few flights; ours scatter by 0.74e-3, of which 3.3 are one in a
  // thousand.
  CHECK_NEAR(sum / seeds, 0.0012, 0.0003 + 3.3 * 0.00074 / sqrt(seeds));
}

TEST(curve_learned_from_nothing_is_no_guide_nearer_than_it_was_learned) {
  int touched = 0;
  for (uint64_t seed = 1; seed <= SEEDS; seed++) {
    const setup_t setup = learning_setup(&ONES, 0.44, 1.8, seed);
    const rbf_weights_t w = learn(&setup);
    touched += contacts_at(&w, &setup, 0.012) > 0;
  }
  CHECK(touched == SEEDS);
}

TEST(curve_learned_from_theory_can_be_flown_nearer_than_it_was_learned) {
  static const struct {
    const char *what;
    double ca, cb;
  } plant[] = {{"theory", 0.44, 1.8}, {"strong", 0.6, 1.8}, {"weak", 0.25, 1.8}, {"wide", 0.44, 1.35}};
  const rbf_weights_t theory = bells_golden_weights();
  const uint64_t seeds = test_long() ? SEEDS : 3;
  for (unsigned i = 0; i < sizeof plant / sizeof *plant; i++) {
    for (uint64_t seed = 1; seed <= seeds; seed++) {
      ROW("%s plant, seed %d", plant[i].what, (int)seed);
      setup_t setup = learning_setup(&theory, plant[i].ca, plant[i].cb, seed);
      setup.flight.curve.clip = 1; // as shipped: the rising tail at 10 cm takes damping away
      const rbf_weights_t w = learn(&setup);
      CHECK(contacts_at(&w, &setup, 0.012) == 0);
      CHECK(contacts_at(&w, &setup, 0.008) == 0);
    }
  }
}

static cJSON *fits_of(const char *scenario, result_t *result) {
  why_t why;
  const request_t request = {.integrate = INTEGRATE_RK4, .seed = 3};
  if (!CHECK_OK(result_init(result, &why))) return NULL;
  CHECK_OK(scenario_find(scenario)->run(&request, result, &why));
  return cJSON_GetObjectItem(result->json, "fits");
}

static double number(const cJSON *row, const char *key) {
  return cJSON_GetObjectItem(row, key)->valuedouble;
}

TEST(rls_sweep_depends_on_lambda_over_p0_alone_and_ends_alike) {
  result_t result;
  const cJSON *fits = fits_of("rls-sweep", &result);
  if (!CHECK(cJSON_GetArraySize(fits) == 7)) return;
  const cJSON *a = cJSON_GetArrayItem(fits, 1), *b = cJSON_GetArrayItem(fits, 5); // (0.1, 1) and (0.5, 5)
  for (int i = 1; i <= 7; i++) {
    char w[24];
    snprintf(w, sizeof w, "w%d", i);
    ROW("%s", w);
    CHECK_NEAR(number(a, w), number(b, w), 1e-4); // in float, over thousands of samples
  }
  for (int i = 0; i < 4; i++) { // claim 19: lambda 0.01, 0.1, 0.5, 1 end alike where the flight was
    ROW("lambda %g", number(cJSON_GetArrayItem(fits, i), "lambda"));
    CHECK(number(cJSON_GetArrayItem(fits, i), "rms") < 0.003);
  }
  result_free(&result);
}

TEST(ols_sweep_carries_the_ratio_of_2_cm_back_down_when_it_averages_long) {
  result_t result;
  const cJSON *fits = fits_of("ols-sweep", &result);
  static const struct {
    double share, time_constant_s;
  } row[] = {{0.5, 0.014}, {0.25, 0.035}, {0.1, 0.095}, {0.01, 0.995}};
  if (!CHECK(cJSON_GetArraySize(fits) == 4)) return;
  double lines_apart = -5e-3; // the noise of the shortest average
  for (int i = 0; i < 4; i++) {
    const cJSON *fit = cJSON_GetArrayItem(fits, i);
    ROW("share %g", row[i].share);
    CHECK_NEAR(number(fit, "time_constant_s"), row[i].time_constant_s, 5e-4); // claim 24
    const double apart = number(fit, "down_4_8cm") - number(fit, "up_4_8cm");
    CHECK(apart > lines_apart);
    lines_apart = apart;
  }
  CHECK(lines_apart > 0.03); // of the 0.088 at 2 cm
  CHECK(number(cJSON_GetArrayItem(fits, 3), "rms") > 5.0 * number(cJSON_GetArrayItem(fits, 0), "rms"));
  result_free(&result);
}
