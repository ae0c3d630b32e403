// test_gap_excluded.c - stage 2: signs of the vehicle file that the turning in a log contradicts.
#include "exam/flights.h"
#include "gap/2_predict/excluded.h"
#include "rig/test.h"

#include <stdlib.h>
#include <string.h>

// A flight in which nothing is hidden, by a vehicle file with these spins; and the gyro about z shakes.
static done_t look(const double spin[ROTORS], double shakes_radps, set_t *set, why_t *why) {
  model_t vehicle;
  gap_flight_t flight;
  grid_t *const grid = calloc(2, sizeof *grid);
  *set = (set_t){.n_grid = 0};
  TRY(exam_vehicle(&vehicle, why));
  TRY(exam_fly(&(exam_flight_t){.truth = &vehicle, .seed = 24001}, &flight, why));
  for (int i = 0; i < flight.n; i++)
    flight.v[SIG_GZ][i] += shakes_radps * (i % 7 < 3 ? 1.0 : -1.0) * (i % 11 - 5);
  memcpy(vehicle.frame.rotor_spin, spin, sizeof vehicle.frame.rotor_spin);
  TRY(grid_make(&grid[0], &flight, 0, flight.n, &vehicle, why));
  TRY(set_make(set, grid, 1, why));
  const done_t status = excluded_find(set, &vehicle, why);
  gap_flight_free(&flight);
  return status;
}

#define OTHER "(it follows with the other sign of `spin` in the vehicle file)"

TEST(gap_says_that_the_spins_have_the_other_sign) {
  static const struct {
    const char *what;
    double spin[ROTORS], shakes_radps;
    bool excluded, other;
    const char *want; // null: read
  } row[] = {
      {"as it is", {1.0, -1.0, 1.0, -1.0}, 0.0, false, false, NULL},
      {"as it is, in noise", {1.0, -1.0, 1.0, -1.0}, 0.3, false, false, NULL},
      {"as it is, in so much noise that nothing is sure", {1.0, -1.0, 1.0, -1.0}, 8.0, false, false, NULL},
      {"the other sign", {-1.0, 1.0, -1.0, 1.0}, 0.0, false, true, OTHER},
      {"the other sign, in noise", {-1.0, 1.0, -1.0, 1.0}, 0.3, true, true, NULL},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    set_t set;
    why_t why = {""};
    CHECK_STATUS(row[i].want ? BAD_INPUT : DONE, look(row[i].spin, row[i].shakes_radps, &set, &why));
    CHECK(set.spins_other == row[i].other);
    if (!row[i].want) CHECK(set.excluded[CH_WZ] == row[i].excluded);
    if (!row[i].want || !strstr(why.text, row[i].want)) CHECK_TEXT(why.text, row[i].want ? row[i].want : "");
    set_free(&set);
  }
}
