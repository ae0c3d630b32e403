// test_slot.c - the hover in a gap of 71 mm, simulated and real.
#include "flight/slot_many.h"
#include "rig/test.h"

#include <stdio.h>

#define SEEDS (test_long() ? 40 : 20)
#define FEW   16 // where the mean counts

// The table flights of labels.csv. fit: the top's clearance was fitted on this one; else it is judged on it.
static const struct {
  const char *file;
  double ceiling_m;
  bool captured, fit;
} flight[] = {
    {"20240823_17_35_08.csv", 0.8206, true, true},   {"20240823_17_42_02.csv", 0.8206, true, false},
    {"20240823_17_47_21.csv", 0.8349, false, false}, {"20240823_19_27_09.csv", 0.8349, false, false},
    {"20240823_19_37_29.csv", 0.8349, true, true},   {"20240827_18_45_10.csv", 0.8349, false, false},
    {"20240827_18_46_05.csv", 0.8349, true, false},  {"20240827_18_48_44.csv", 0.8349, false, false},
    {"20240827_18_49_29.csv", 0.8349, true, true},   {"20240827_18_56_52.csv", 0.8349, false, false},
};
#define FLIGHTS (sizeof flight / sizeof *flight)

static bool judge_real(const char *file, double ceiling_m, slot_seen_t *seen) {
  char path[512];
  why_t why;
  snprintf(path, sizeof path, "%s/ceiling_gap/%s", test_data_dir(), file);
  return CHECK_OK(slot_judge_file(path, ceiling_m, seen, &why));
}

TEST(slot_real_flights_are_judged_as_labelled) {
  if (!test_data_dir()) SKIP("no measured data");
  for (unsigned i = 0; i < FLIGHTS; i++) {
    slot_seen_t seen;
    ROW("%s", flight[i].file);
    if (!judge_real(flight[i].file, flight[i].ceiling_m, &seen)) continue;
    CHECK(seen.captured == flight[i].captured);
    if (seen.captured)
      CHECK(seen.median_m > 0.0066 && seen.median_m < 0.0095);
    else
      CHECK(seen.closest_m >= 0.018);
  }
}

static slot_many_t fly(const char *effect, bool ceiling, double rise_m, int seeds) {
  const slot_case_t c = {FLY_STOCK_PID, effect, 0.0, ceiling, rise_m, seeds};
  slot_many_t m = {.flights = 0};
  why_t why;
  CHECK_OK(slot_fly_many(&c, &m, &why));
  CHECK(m.flights == seeds);
  return m;
}

TEST(slot_captures_the_stock_pid_in_some_flights) {
  const slot_many_t m = fly(NULL, true, SLOT_RISE_M, SEEDS);
  CHECK(10 * m.captured >= SEEDS && 10 * m.captured <= 9 * SEEDS);
  CHECK(m.low_m > 0.0066 - 0.003 && m.high_m < 0.0095 + 0.003);
  CHECK(m.free_m > 0.018 - 0.005);
  // 13.8 and 9.9 s in reality, from 3 and 5 flights that spread by 1 s.
  CHECK_NEAR(m.lift_s[0], 13.8, 1.5);
  CHECK_NEAR(m.lift_s[1], 9.9, 1.5);
}

TEST(slot_captures_more_the_heavier_the_vehicle_is) {
  int captured[2];
  for (int i = 0; i < 2; i++) {
    const slot_case_t c = {FLY_STOCK_PID, NULL, i == 0 ? 0.034 : 0.038, true, SLOT_RISE_M, FEW};
    slot_many_t m;
    why_t why;
    if (!CHECK_OK(slot_fly_many(&c, &m, &why))) return;
    captured[i] = m.captured;
    int sum = 0;
    for (int k = 0; k < SLOT_FLIGHTS; k++) sum += m.captured_as[k];
    CHECK(sum == m.captured && m.flights == FEW);
  }
  CHECK(captured[0] <= 3 && captured[1] >= 8);
}

TEST(slot_table_counts_the_real_flights_as_they_are_labelled) {
  if (!test_data_dir()) SKIP("no measured data");
  static const int captured_as[SLOT_FLIGHTS] = {0, 0, 1, 0, 1, 0, 1, 0};
  slot_many_t m;
  why_t why;
  if (!CHECK_OK(slot_real_many(test_data_dir(), &m, &why))) return;
  CHECK(m.flights == SLOT_FLIGHTS && m.captured == 3);
  for (int k = 0; k < SLOT_FLIGHTS; k++) CHECK(m.captured_as[k] == captured_as[k]);
  CHECK(m.low_m <= m.median_m && m.median_m <= m.high_m && m.free_m >= 0.018);
}

TEST(slot_captures_every_flight_where_the_ceiling_pulls_from_afar) {
  // 25 mm away, where the real flights still decide, these have 6 % where the square root has 3 %.
  static const char *const effect[] = {"ceiling:form=exponential,Ca=0.44,Cb=1.8",
                                       "ceiling:form=cheeseman-bennett"};
  for (int i = 0; i < 2; i++) {
    ROW("%s", effect[i]);
    const int seeds = test_long() ? FEW : FEW / 2;
    CHECK(fly(effect[i], true, SLOT_RISE_M, seeds).captured >= seeds - 1);
  }
}

TEST(slot_top_is_as_high_as_on_flights_that_were_not_fitted) {
  if (!test_data_dir()) SKIP("no measured data");
  why_t why;
  setup_t setup;
  if (!CHECK_OK(slot_setup(&setup, 1, true, SLOT_RISE_M, &why))) return;
  for (unsigned i = 0; i < FLIGHTS; i++) {
    slot_seen_t seen;
    ROW("%s", flight[i].file);
    if (!flight[i].captured || !judge_real(flight[i].file, flight[i].ceiling_m, &seen)) continue;
    CHECK_NEAR(setup.model.frame.top_above_rotor_m, seen.median_m, flight[i].fit ? 2e-4 : 3e-3);
  }
}

TEST(slot_open_deck_flights_lift_off_and_overshoot_as_the_real_ones) {
  if (!test_data_dir()) SKIP("no measured data");
  static const struct {
    const char *file;
    double rise_m;
    int late; // take-off of 1.6 s
  } row[] = {
      {"20240827_16_23_24.csv", 0.10, 1}, {"20240823_17_25_20.csv", 0.02, 0},
      {"20240827_16_38_21.csv", 0.05, 1}, {"20240827_16_41_48.csv", 0.02, 1},
      {"20240823_16_23_49.csv", 0.04, 0},
  };
  for (unsigned i = 0; i < FEW_OR_ALL(row, 2); i++) {
    slot_seen_t seen;
    ROW("%s", row[i].file);
    if (!judge_real(row[i].file, 1.0, &seen)) continue;
    const slot_many_t m = fly(NULL, false, row[i].rise_m, FEW);
    CHECK_NEAR(m.lift_s[row[i].late], seen.lift_s, 1.0);
    // Height over rest; the ceiling above was given as 1 m. Simulated ones overshoot by 3 to 14 mm less.
    const double real_m = 1.0 - 0.7885 - 0.003 - seen.closest_m;
    CHECK_NEAR(m.peak_m, real_m, 0.015);
  }
}
