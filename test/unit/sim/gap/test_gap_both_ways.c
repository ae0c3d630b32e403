// test_gap_both_ways.c - a scale of the turning, and commands that a log misses.
#include "gap/5_infer/both_ways.h"
#include "rig/test.h"

#include "base/constants.h"
#include "base/random.h"
#include <math.h>
#include <stdlib.h>

#define ROWS 800

typedef struct {
  double k, missed, noise; // sd of what the prediction and the gyro have of their own; the turning has 1
  double back;             // so many times the gyro's noise control commands against it
  double slow;             // sd of a moment that control cancels: it is predicted, and nothing turns
  double manoeuvre;        // for half of every hundred rows it turns by up to so much, and not otherwise
  double fast, k_fast;     // sd of what it turns besides, of which so much more is predicted
} turning_t;

static both_t rows_of(const turning_t *t, uint64_t seed, double *by_least_squares) {
  bool follows[ROWS];
  double measured[ROWS], residual[ROWS], left[ROWS], room[ROWS], slow = 0.0;
  random_t *const r = random_open(seed);
  if (!r) abort();
  for (int i = 0; i < ROWS; i++) {
    const double turns =
        t->manoeuvre > 0.0 ? t->manoeuvre * fmax(sin(2.0 * PI / 100.0 * i), 0.0) : random_normal(r);
    slow = 0.98 * slow + 0.2 * t->slow * random_normal(r);
    const double missed = t->missed * random_normal(r), noise = t->noise * random_normal(r);
    const double fast = t->fast * random_normal(r);
    const double predicted =
        (1.0 + t->k) * turns + (1.0 + t->k_fast) * fast + missed - t->back * noise + slow;
    follows[i] = i > 0;
    measured[i] = turns + fast + noise;
    residual[i] = measured[i] - predicted;
  }
  random_close(r);
  const rows_t rows = {.n = ROWS, .follows = follows};
  const both_t b = both_ways_of(&rows, measured, residual, 0.1, left, room);
  *by_least_squares = b.pp / b.yp - 1.0;
  return b;
}

TEST(gap_takes_for_inertia_only_what_measured_by_predicted_and_predicted_by_measured_both_say) {
  static const struct {
    const char *what;
    turning_t t;
    bool agree;
  } row[] = {
      {"half as much again", {0.5, .noise = 0.0}, true},
      {"the same, a gyro's noise", {0.5, .noise = 0.2}, true},
      {"the same, some commands missed", {0.5, .missed = 0.7, .noise = 0.2}, true},
      {"the same, and a moment that control cancels", {0.5, .missed = 0.2, .slow = 3.0}, true},
      {"the same in slow manoeuvres, a gyro's noise", {0.5, .noise = 0.2, .manoeuvre = 3.0}, true},
      {"a third less", {-0.33, .noise = 0.0}, true},
      {"the same, a gyro's noise", {-0.33, .noise = 0.2}, true},
      {"the same, half of the commands missed", {-0.33, .missed = 0.7}, false},
      {"half as much, and a gyro's noise of which half could be made", {-0.5, .noise = 0.7}, false},
      {"nothing, a gyro's noise that is fed back", {0.0, .noise = 0.5, .back = 1.0}, false},
      {"the same, as much missed as told", {0.5, .missed = 1.5}, false}, // 0.5 to 2
      {"nothing", {0.0, .noise = 0.0}, false},
      {"nothing, a gyro's noise", {0.0, .noise = 0.3}, false},
      {"nothing, half of the commands missed", {0.0, .missed = 0.7}, false},
      {"nothing, most of them missed", {0.0, .missed = 1.4, .noise = 0.2}, false},
      {"nothing, and a moment that control cancels", {0.0, .noise = 0.1, .slow = 3.0}, false},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    double k;
    const both_t b = rows_of(&row[i].t, 1 + i, &k);
    const double agreed = both_ways_agree(&b, k, 0.05), least = both_ways_least(&b);
    CHECK((agreed != 0.0) == row[i].agree);
    if (row[i].agree) CHECK_NEAR(agreed, row[i].t.k, 0.1);
    CHECK(least == fmax(agreed, 0.0));
  }
}

TEST(gap_takes_no_inertia_within_two_standard_errors) {
  double k;
  const both_t b = rows_of(&(turning_t){0.5, .missed = 0.05}, 1, &k);
  CHECK(both_ways_agree(&b, k, 0.24) > 0.0);
  CHECK(both_ways_agree(&b, k, 0.26) == 0.0);
  CHECK(both_ways_agree(&b, 0.2, 0.05) == 0.0); // the rows themselves say 0.5
  CHECK(both_ways_agree(&b, 0.45, 0.001) > 0.0 &&
        both_ways_agree(&b, 0.4, 0.001) == 0.0); // 2 % of 1.45, twice
  CHECK(both_ways_agree(&b, -0.5, 0.05) == 0.0);
  const both_t less = rows_of(&(turning_t){-0.33, .missed = 0.05}, 1, &k);
  CHECK(both_ways_agree(&less, k, 0.05) < -0.3 && both_ways_agree(&less, -0.1, 0.05) == 0.0);
  CHECK(both_ways_agree(&less, 0.33, 0.05) == 0.0);
  CHECK(both_ways_agree(&(both_t){0}, 0.5, 0.05) == 0.0 && both_ways_least(&(both_t){0}) == 0.0);
  const both_t few = {.yy = 100.0, .pp = 160.0, .yp = 120.0, .n = 40}; // 0.2 +- 0.1, and half of 0.13
  CHECK(both_ways_least(&few) == 0.0);
  CHECK(both_ways_least(&(both_t){.yy = 100.0, .pp = 160.0, .yp = 120.0, .n = 400}) > 0.19);
}

// A log that went in step with an outer loop: 0.8 by slow turning, 0.3 by fast, was told as 0.46 for sure.
TEST(gap_takes_for_no_inertia_what_slow_and_fast_turning_say_otherwise) {
  static const struct {
    const char *what;
    turning_t t;
    bool one;
  } row[] = {
      {"one number", {0.5, .manoeuvre = 3.0, .fast = 0.5, .k_fast = 0.5}, true},
      {"the same, some commands missed",
       {0.5, .missed = 0.3, .manoeuvre = 3.0, .fast = 0.5, .k_fast = 0.5},
       true},
      {"the same, a gyro's noise", {0.5, .noise = 0.2, .manoeuvre = 3.0, .fast = 0.5, .k_fast = 0.5}, true},
      {"the same, and a slow moment that control cancels",
       {0.5, .missed = 0.2, .slow = 1.0, .manoeuvre = 3.0, .fast = 0.5, .k_fast = 0.5},
       true},
      {"two, nearer than what is named", {0.5, .manoeuvre = 3.0, .fast = 0.5, .k_fast = 0.49}, true},
      {"two", {0.8, .manoeuvre = 3.0, .fast = 1.0, .k_fast = 0.3}, false},
      {"two, some commands missed",
       {0.8, .missed = 0.1, .manoeuvre = 3.0, .fast = 1.0, .k_fast = 0.3},
       false},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    double k;
    const both_t b = rows_of(&row[i].t, 40 + i, &k);
    CHECK(b.apart == !row[i].one);
    CHECK((both_ways_least(&b) > 0.0) == row[i].one);
  }
}

TEST(gap_takes_for_no_inertia_what_another_axis_contradicts) {
  double k;
  both_t b = rows_of(&(turning_t){0.5, .missed = 0.05}, 1, &k), other = b, nothing = {.n = 0};
  other.apart = true;
  const scaled_t told = {k, 0.05}, none = {0.0, 0.0};
  CHECK(both_ways_stand((both_t[]){b, b, b}, (scaled_t[]){told, told, told}));
  CHECK(
      both_ways_stand((both_t[]){nothing, nothing, b}, (scaled_t[]){told, told, told})); // one axis is enough
  CHECK(!both_ways_stand((both_t[]){b, other, b}, (scaled_t[]){told, told, told}));
  CHECK(both_ways_stand((both_t[]){b, other, b}, (scaled_t[]){told, none, told})); // of which nothing is told
  CHECK(both_ways_stand((both_t[]){b, other, b}, (scaled_t[]){told, {0.05, 0.03}, told}));
  CHECK(!both_ways_stand((both_t[]){b, other, b}, (scaled_t[]){told, {0.07, 0.03}, told}));
  CHECK(!both_ways_stand((both_t[]){nothing, nothing, nothing}, (scaled_t[]){told, told, told}));
}
