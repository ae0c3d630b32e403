// test_gap_floor.c - stage 1: what z says while the vehicle stands before take-off.
#include "gap/1_read/flight.h"
#include "rig/scratch.h"
#include "rig/test.h"
#include "vehicle/model_file.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ROWS_HZ 100
#define FLIES_S 12.0
#define STRAY_M 0.1
#define UP_M    0.5 // so far above where it stood it flies

typedef struct {
  const char *what;
  double stands_m, stands_s;
  double moves_m; // up and down meanwhile, in all
  double told_m;  // NaN: the columns file does not say
  double want_m;  // what the height is less by
  const char *note;
  int stray;    // every so many rows z is STRAY_M off; 0: none
  bool unknown; // nobody knows the commands of the rows in which it seems to stand
} standing_t;

static const char TAKEN[] = "that is taken for the floor", SOMEWHERE[] = "on what, the log does not say";

static const standing_t row[] = {
    {"at 0", 0.0, 1.0, 0.0, (double)NAN, 0.0, NULL, 0, false},
    {"a marker above the feet", 0.054, 1.0, 0.001, (double)NAN, 0.054, TAKEN, 0, false},
    {"below 0", -0.03, 1.0, 0.001, (double)NAN, -0.03, TAKEN, 0, false},
    {"as near as an estimate is", 0.009, 1.0, 0.0, (double)NAN, 0.0, NULL, 0, false},
    {"further than an estimate is", 0.011, 1.0, 0.0, (double)NAN, 0.011, TAKEN, 0, false},
    {"at a height that the vehicle has", 0.13, 1.0, 0.0, (double)NAN, 0.13, TAKEN, 0, false},
    {"higher than the vehicle is wide: on something", 0.15, 1.0, 0.0, (double)NAN, 0.0, SOMEWHERE, 0, false},
    {"deeper than the vehicle is wide", -0.15, 1.0, 0.0, (double)NAN, 0.0, SOMEWHERE, 0, false},
    {"with a stray in twelve", 0.054, 1.0, 0.0, (double)NAN, 0.054, TAKEN, 12, false},
    {"with a stray in four", 0.054, 1.0, 0.0, (double)NAN, 0.0, NULL, 4, false},
    {"in flight, before the commands come", 0.054, 0.6, 0.0, (double)NAN, 0.0, NULL, 0, true},
    {"for a moment", 0.054, 0.45, 0.0, (double)NAN, 0.0, NULL, 0, false},
    {"for a little more than a moment", 0.054, 0.55, 0.0, (double)NAN, 0.054, TAKEN, 0, false},
    {"not at all", 0.054, 0.0, 0.0, (double)NAN, 0.0, NULL, 0, false},
    {"almost still", 0.054, 1.0, 0.009, (double)NAN, 0.054, TAKEN, 0, false},
    {"carried about", 0.054, 1.0, 0.011, (double)NAN, 0.0, NULL, 0, false},
    {"on something, as the columns file says", 0.054, 1.0, 0.0, 0.0, 0.0, NULL, 0, false},
    {"as the columns file says", 0.054, 1.0, 0.0, 0.05, 0.05, NULL, 0, false},
};

// Thrust of the motors' commands, and height: it stands, then it flies.
static const char *log_of(const standing_t *s) {
  const int stands = (int)(s->stands_s * ROWS_HZ + 0.5), n = stands + (int)(FLIES_S * ROWS_HZ);
  char *const text = malloc((size_t)(n + 1) * 80);
  size_t at = (size_t)sprintf(
      text, "timestamp,stateEstimate.z,ctrltarget.z,motor.m1,motor.m2,motor.m3,motor.m4,pm.vbat\n");
  for (int i = 0; i < n; i++) {
    const bool flies = i >= stands;
    const double stray_m = s->stray && i % s->stray == 0 ? STRAY_M : 0.0;
    const double z_m =
        s->stands_m + (flies ? UP_M + 1e-4 * (i % 7) : (i % 3 - 1) * 0.5 * s->moves_m + stray_m);
    const int pwm = flies ? 42000 + i % 5 * 100 : 0;
    at += (size_t)sprintf(text + at, "%d,%.5f,%.5f,", i * 1000 / ROWS_HZ, z_m, s->stands_m + UP_M);
    at += s->unknown && !flies
              ? (size_t)sprintf(text + at, ",,,,3.%d\n", 70 + i % 2)
              : (size_t)sprintf(text + at, "%d,%d,%d,%d,3.%d\n", pwm, pwm, pwm, pwm, 70 + i % 2);
  }
  const char *const path = scratch_file("stands.csv", text, -1);
  free(text);
  return path;
}

static const char *note_of(const gap_flight_t *f) {
  for (int i = 0; i < f->n_note; i++)
    if (strstr(f->note[i], "before take-off")) return f->note[i];
  return NULL;
}

TEST(gap_says_of_a_flight_above_the_ceiling_what_its_heights_count_from) {
  static const struct {
    double stands_m;
    const char *want;
  } at[] = {
      {0.0, "(ceiling_m = 0.2); allowed: below it"},
      {-0.03, "(ceiling_m = 0.2; heights count from -0.03 m, where it stood before take-off); allowed"}};
  for (int i = 0; i < 2; i++) {
    const standing_t s = {.stands_m = at[i].stands_m, .stands_s = 1.0};
    const columns_t columns = columns_crazyflie();
    model_t vehicle;
    gap_flight_t f;
    why_t why = {""};
    ROW("%g", s.stands_m);
    CHECK_OK(model_builtin("cf21_legacy", &vehicle, &why));
    vehicle.ceiling_m = 0.2;
    CHECK_STATUS(BAD_INPUT, gap_read(&f, log_of(&s), &columns, &vehicle, &why));
    CHECK(strstr(why.text, at[i].want) != NULL);
  }
}

TEST(gap_counts_heights_from_where_the_vehicle_stands_before_take_off) {
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    columns_t columns = columns_crazyflie();
    model_t vehicle;
    gap_flight_t f;
    why_t why = {""};
    columns.rest_height_m = row[i].told_m;
    CHECK_OK(model_builtin("cf21_legacy", &vehicle, &why));
    CHECK_OK(gap_read(&f, log_of(&row[i]), &columns, &vehicle, &why));
    CHECK_TEXT(why.text, "");
    if (f.n == 0) continue;
    CHECK_NEAR(f.v[SIG_Z][f.n - 50], row[i].stands_m + UP_M - row[i].want_m, 1e-3);
    CHECK_NEAR(f.v[SIG_SET_Z][f.n - 50], row[i].stands_m + UP_M - row[i].want_m, 1e-4);
    const char *const note = note_of(&f);
    CHECK(row[i].note ? note && strstr(note, row[i].note) : !note);
    gap_flight_free(&f);
  }
}
