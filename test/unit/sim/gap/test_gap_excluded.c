// test_gap_excluded.c - stage 2: signs of the vehicle file that the turning in a log contradicts.
#include "exam/flights.h"
#include "gap/2_predict/excluded.h"
#include "rig/test.h"

#include <math.h>
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

// The rotors of the vehicle file lie to one side. Where the thrust comes and goes, it turns the model more
// than attitude control does.
TEST(gap_leaves_out_no_turning_for_a_centre_of_mass_that_is_elsewhere) {
  static const struct {
    const char *what;
    double off_m, lifts, turns; // shares of the commands that come and go, of all and about x
    bool excluded;
  } row[] = {{"where the file has it", 0.0, 0.06, 0.0, false},
             {"20 mm to one side", 0.02, 0.06, 0.0, false},
             {"commands that the vehicle did not get", 0.0, 0.0, 0.05, true},
             {"both", 0.02, 0.06, 0.05, true}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    model_t vehicle;
    gap_flight_t flight;
    why_t why;
    grid_t *const grid = calloc(2, sizeof *grid);
    set_t set = {.n_grid = 0};
    CHECK_OK(exam_vehicle(&vehicle, &why));
    const exam_flight_t job = {.truth = &vehicle, .hover_only = true, .seed = 24001};
    CHECK_OK(exam_fly(&job, &flight, &why));
    for (int k = 0; k < flight.n * ROTORS; k++) {
      const int at = k / ROTORS, motor = k % ROTORS;
      const double turns = row[i].turns * (at / 20 * 7 % 11 - 5),
                   lifts = row[i].lifts * (at / 20 * 4 % 13 - 6);
      flight.v[SIG_M1 + motor][at] *= 1.0 + lifts + copysign(turns, turns * vehicle.frame.rotor_y_m[motor]);
    }
    for (int k = 0; k < ROTORS; k++) vehicle.frame.rotor_y_m[k] += row[i].off_m;
    CHECK_OK(grid_make(&grid[0], &flight, 0, flight.n, &vehicle, &why));
    CHECK_OK(set_make(&set, grid, 1, &why));
    CHECK_OK(excluded_find(&set, &vehicle, &why));
    CHECK(set.excluded[CH_WX] == row[i].excluded);
    set_free(&set);
    gap_flight_free(&flight);
  }
}
