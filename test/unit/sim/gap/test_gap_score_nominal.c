// test_gap_score_nominal.c - what nominal flights make of a number.
#include "gap/5_infer/score.h"
#include "rig/test.h"

// A height with errors makes a ground effect too small in every nominal flight: no error that could be taken
// for one.
TEST(gap_score_takes_no_bias_against_a_size_for_what_could_be_one) {
  static const struct {
    const char *what;
    double least, value[4], left[4];
  } row[] = {
      {"too small, of a size that is positive", 0.0, {-1.3, -0.9, -1.1, -0.7}, {-0.3, 0.1, -0.1, 0.3}},
      {"too large", 0.0, {1.3, 0.9, 1.1, 0.7}, {1.3, 0.9, 1.1, 0.7}},
      {"of a size of either sign", -5.0, {-1.3, -0.9, -1.1, -0.7}, {-1.3, -0.9, -1.1, -0.7}},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    const candidate_t c = {.least = {row[i].least}};
    double value[4];
    ROW("%s", row[i].what);
    for (int k = 0; k < 4; k++) value[k] = row[i].value[k];
    score_made(&c, 0, value, 4);
    for (int k = 0; k < 4; k++) CHECK_NEAR(value[k], row[i].left[k], 1e-12);
  }
}

// Its number is noise, as large as the flight holds little of it: eight times as far off where it holds a
// 64th. What feedback makes is the same in all.
TEST(gap_score_counts_a_nominal_flight_by_what_it_holds_of_a_number) {
  static const struct {
    const char *what;
    double value[3], holds[3], want, plain;
  } row[] = {{"noise", {1.0, -1.0, 8.0}, {64.0, 64.0, 1.0}, 1.2200, 4.6904},
             {"feedback", {0.5, 0.5, 0.5}, {64.0, 9.0, 1.0}, 0.5, 0.5},
             {"nobody came there", {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, 0.0, 0.0}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    CHECK_NEAR(score_rms(row[i].value, row[i].holds, 3), row[i].want, 1e-3);
    CHECK_NEAR(score_rms(row[i].value, NULL, 3), row[i].plain, 1e-3);
  }
}
