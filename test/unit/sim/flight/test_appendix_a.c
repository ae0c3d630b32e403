// test_appendix_a.c - the thesis's one-dimensional flights, flown by the flight code.
#include "rig/flights.h"
#include "rig/test.h"

#define OVERSHOOT_TOL_MM 0.05
#define T90_TOL_S        0.02
#define NEVER            ((double)NAN)

typedef struct {
  const char *what;
  fly_kind_t kind;
  float lead_s;
  float share; // of the excess ratio that the controller believes
  bool ceiling;
} case_t;

static setup_t setup_of(const case_t *c, float cutoff_Hz) {
  setup_t setup = flights_appendix_a(c->kind, cutoff_Hz, c->lead_s, c->ceiling);
  setup.flight.curve.ca *= c->share;
  return setup;
}

TEST(appendix_a_unfiltered_flights_are_those_of_the_thesis) {
  static const struct {
    case_t c;
    double overshoot_mm;
    int peaks;
    double t90_s, settle_s;
  } row[] = {
      {{"A.4 no ceiling", FLY_INDI, 0.0f, 1.0f, false}, 0.00, 0, 2.01, 3.23},
      {{"A.5 standard", FLY_INDI, 0.0f, 1.0f, true}, 5.47, 7, 1.54, 6.92},
      {{"A.6 theory K_v .01", FLY_INDI_THEORY, 0.01f, 1.0f, true}, 3.72, 5, 1.58, 4.40},
      {{"scale only", FLY_INDI_THEORY, 0.0f, 1.0f, true}, 8.80, 13, 1.53, 15.4},
      {{"A.8 K_v .3", FLY_INDI_THEORY, 0.3f, 1.0f, true}, 0.00, 0, 4.27, 9.77},
      {{"A.9 K_v 1", FLY_INDI_THEORY, 1.0f, 1.0f, true}, 0.00, 0, 10.92, NEVER},
      {{"A.10 OLS RBF", FLY_INDI_RBF, 0.3f, 1.0f, true}, 0.00, 0, 4.60, 10.55},
      {{"A.12 underestimated", FLY_INDI_THEORY, 0.3f, 0.5f, true}, 0.00, 0, 2.82, 5.70},
      {{"A.14 overestimated", FLY_INDI_THEORY, 0.3f, 1.5f, true}, 0.00, 0, 5.69, 13.77},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].c.what);
    const setup_t setup = setup_of(&row[i].c, 0.0f);
    int contacts;
    const segment_t last = flights_last(&setup, &contacts);
    CHECK_NEAR(last.overshoot_mm, row[i].overshoot_mm, OVERSHOOT_TOL_MM);
    CHECK(last.peaks == row[i].peaks);
    CHECK_NEAR(last.t90_s, row[i].t90_s, T90_TOL_S);
    CHECK(contacts == 0);
    if (isnan(row[i].settle_s))
      CHECK(isnan(last.settle_1mm_s));
    else
      CHECK_NEAR(last.settle_1mm_s, row[i].settle_s, 0.05); // printed to three digits
  }
}

TEST(appendix_a_filtered_flights_are_those_of_the_prototype) {
  static const struct {
    case_t c;
    bool contact;
    double t90_s;
  } row[] = {
      {{"A.4 no ceiling", FLY_INDI, 0.0f, 1.0f, false}, false, 2.01},
      {{"A.5 standard", FLY_INDI, 0.0f, 1.0f, true}, true, NEVER},
      {{"A.6 theory K_v .01", FLY_INDI_THEORY, 0.01f, 1.0f, true}, true, NEVER},
      {{"scale only", FLY_INDI_THEORY, 0.0f, 1.0f, true}, true, NEVER},
      {{"A.8 K_v .3", FLY_INDI_THEORY, 0.3f, 1.0f, true}, false, 4.00},
      {{"A.9 K_v 1", FLY_INDI_THEORY, 1.0f, 1.0f, true}, false, 10.66},
      {{"A.10 OLS RBF", FLY_INDI_RBF, 0.3f, 1.0f, true}, false, 4.33},
      {{"A.12 underestimated", FLY_INDI_THEORY, 0.3f, 0.5f, true}, false, 2.55},
      {{"A.14 overestimated", FLY_INDI_THEORY, 0.3f, 1.5f, true}, false, 5.43},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].c.what);
    const setup_t setup = setup_of(&row[i].c, 8.0f);
    int contacts;
    const segment_t last = flights_last(&setup, &contacts);
    CHECK((contacts > 0) == row[i].contact);
    if (row[i].contact) continue;
    CHECK_NEAR(last.overshoot_mm, 0.0, OVERSHOOT_TOL_MM);
    CHECK_NEAR(last.t90_s, row[i].t90_s, T90_TOL_S);
  }
}

TEST(appendix_a_oscillation_has_the_printed_extrema) {
  const setup_t setup = flights_appendix_a(FLY_INDI, 0.0f, 0.0f, true);
  flown_t flown;
  why_t why;
  if (!CHECK_OK(setup_fly(&setup, &flown, &why))) return;
  static const struct {
    double t_s, error_mm;
  } row[] = {{2.57, 5.47}, {3.80, -3.96}, {5.29, 2.02}, {6.61, -1.30}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("extremum %u", i);
    const sample_t *at = &flown.record.sample[(int)lround((20.0 + row[i].t_s) / 0.01)];
    CHECK_NEAR(1e3 * (at->z_m - 0.48), row[i].error_mm, 0.02);
  }
  flown_free(&flown);
}

TEST(appendix_a_steps_far_from_the_ceiling_do_not_feel_it) {
  const setup_t with = flights_appendix_a(FLY_INDI, 0.0f, 0.0f, true);
  const setup_t without = flights_appendix_a(FLY_INDI, 0.0f, 0.0f, false);
  flown_t a, b;
  why_t why;
  if (!CHECK_OK(setup_fly(&with, &a, &why)) || !CHECK_OK(setup_fly(&without, &b, &why))) return;
  for (int i = 0; i < 2; i++) {
    ROW("step %d", i);
    CHECK_NEAR(a.segment[i].overshoot_mm, 0.0, OVERSHOOT_TOL_MM);
    CHECK_NEAR(a.segment[i].t90_s, b.segment[i].t90_s, 0.03);
  }
  flown_free(&a);
  flown_free(&b);
}

TEST(lead_time_beyond_a_threshold_removes_overshoot_and_contact) {
  static const struct {
    float cutoff_Hz, lead_s;
    double overshoot_mm;
  } row[] = {{0.0f, 0.03f, 0.69}, {0.0f, 0.05f, 0.0}, {8.0f, 0.0625f, 0.39}, {8.0f, 0.08f, 0.0}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%g Hz, K_v %g", (double)row[i].cutoff_Hz, (double)row[i].lead_s);
    const setup_t setup = flights_appendix_a(FLY_INDI_THEORY, row[i].cutoff_Hz, row[i].lead_s, true);
    CHECK_NEAR(flights_last(&setup, NULL).overshoot_mm, row[i].overshoot_mm, OVERSHOOT_TOL_MM);
  }
  int contacts;
  const setup_t filtered = flights_appendix_a(FLY_INDI_THEORY, 8.0f, 0.03f, true);
  flights_last(&filtered, &contacts);
  CHECK(contacts == 0);
}

TEST(standard_controller_holds_24_mm_and_loses_22_mm_at_8_hz) {
  static const struct {
    int gap_mm;
    bool holds;
  } row[] = {{30, true}, {24, true}, {22, false}, {20, false}};
  for (unsigned i = 0; i < 2 * sizeof row / sizeof *row; i++) {
    const unsigned k = i / 2;
    ROW("gap %d mm at %d ms", row[k].gap_mm, i % 2 ? 2 : 10);
    setup_t setup = flights_appendix_a(FLY_INDI, 8.0f, 0.0f, true);
    setup.plan.period_s = i % 2 ? 0.002 : 0.01;
    setup.plan.way[0] = (waypoint_t){0.0, 0.43};
    setup.plan.way[1] = (waypoint_t){5.0, 0.5 - 1e-3 * row[k].gap_mm};
    setup.plan.n_way = 2;
    setup.plan.end_s = 25.0;
    setup.plan.start_z_m = 0.43;
    setup.plan.start_thrust_N = 0.032 * 9.81;
    int contacts;
    flights_last(&setup, &contacts);
    CHECK((contacts == 0) == row[k].holds);
  }
}

TEST(filter_decides_how_near_the_standard_controller_can_hover) {
  // The gap is one of a linear analysis, +-0.5 mm: one step further out holds, further in does not.
  static const struct {
    float cutoff_Hz, kp, kd;
    double limit_mm;
  } row[] = {{0.0f, 1, 5, 17.5}, {30.0f, 1, 5, 19.2}, {15.0f, 1, 5, 20.8}, {8.0f, 1, 5, 22.8},
             {0.0f, 2, 8, 10.8}, {30.0f, 2, 8, 12.8}, {15.0f, 2, 8, 14.2}, {8.0f, 2, 8, 16.5}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    for (int side = -1; side <= 1; side += 2) {
      ROW("%g Hz, gains %g %g, %s", (double)row[i].cutoff_Hz, (double)row[i].kp, (double)row[i].kd,
          side < 0 ? "nearer" : "farther");
      setup_t setup = flights_appendix_a(FLY_INDI, row[i].cutoff_Hz, 0.0f, true);
      setup.flight.pos.kp_z_per_s = row[i].kp;
      setup.flight.pos.kd_z_per_s = row[i].kd;
      const double gap_m = 1e-3 * (row[i].limit_mm + side);
      setup.plan.n_way = 2;
      setup.plan.end_s = 120.0;
      setup.plan.start_z_m = 0.5 - gap_m;
      setup.plan.start_thrust_N = 0.032 * 9.81 / (1.0 + 0.44 * exp(-80.0 * gap_m));
      // A kick of 0.1 mm, as small as the linear analysis wants it.
      setup.plan.way[0] = (waypoint_t){0.0, 0.5 - gap_m};
      setup.plan.way[1] = (waypoint_t){1.0, 0.5 - gap_m + 1e-4};
      const segment_t last = flights_last(&setup, NULL);
      CHECK((last.rms_mm < 0.05) == (side > 0));
    }
  }
}

TEST(order_of_the_thesis_models_holds_over_random_gains) {
  random_t *random = random_open(20210729);
  const int pairs = test_long() ? 60 : 10;
  int accepted = 0, ordered = 0;
  while (accepted < pairs) {
    const float kp = (float)random_uniform(random, 0.5, 4.0), kd = (float)random_uniform(random, 2.0, 14.0);
    const float cutoff_Hz = accepted % 2 ? (float)random_uniform(random, 6.0, 30.0) : 0.0f;
    static const case_t cases[] = {
        {"A4", FLY_INDI, 0.0f, 1.0f, false},        {"A5", FLY_INDI, 0.0f, 1.0f, true},
        {"A6", FLY_INDI_THEORY, 0.01f, 1.0f, true}, {"A8", FLY_INDI_THEORY, 0.3f, 1.0f, true},
        {"A9", FLY_INDI_THEORY, 1.0f, 1.0f, true},  {"A12", FLY_INDI_THEORY, 0.3f, 0.5f, true},
        {"A14", FLY_INDI_THEORY, 0.3f, 1.5f, true}};
    enum { A4, A5, A6, A8, A9, A12, A14, ALL };
    segment_t s[ALL];
    for (int i = 0; i < ALL; i++) {
      setup_t setup = setup_of(&cases[i], cutoff_Hz);
      setup.flight.pos.kp_z_per_s = kp;
      setup.flight.pos.kd_z_per_s = kd;
      setup.plan.end_s = 60.0; // slow gains need their time to 90 %
      s[i] = flights_last(&setup, NULL);
      if (i == A4 && s[A4].overshoot_mm > 0.05) break;
    }
    if (s[A4].overshoot_mm > 0.05) continue;
    accepted++;
    const double tol = 0.05; // an overshoot below this is none
    ordered += s[A5].overshoot_mm >= s[A6].overshoot_mm - tol &&
               s[A6].overshoot_mm >= s[A8].overshoot_mm - tol && s[A12].t90_s < s[A8].t90_s &&
               s[A8].t90_s < s[A14].t90_s && s[A4].t90_s < s[A8].t90_s && s[A8].t90_s < s[A9].t90_s;
  }
  random_close(random);
  CHECK(ordered >= (int)(0.95 * pairs)); // a prototype had 59 of 60 twice
}

TEST(gains_beyond_a_limit_overshoot_without_any_ceiling) {
  static const struct { float kd, kp_limit; } row[] = {{5.0f, 1.80f}, {8.0f, 3.05f}, {10.0f, 3.65f}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    for (int side = -1; side <= 1; side += 2) {
      ROW("kd %g, %s", (double)row[i].kd, side < 0 ? "below" : "above");
      setup_t setup = flights_appendix_a(FLY_INDI, 0.0f, 0.0f, false);
      setup.flight.pos.kd_z_per_s = row[i].kd;
      setup.flight.pos.kp_z_per_s = row[i].kp_limit + 0.1f * (float)side;
      CHECK((flights_last(&setup, NULL).overshoot_mm < 0.05) == (side < 0));
    }
  }
}
