// test_other.c - tests of the exam's second plant by itself.
#include "exam/other/flight.h"
#include "rig/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// A vehicle of 0.1 kg without drags, with round numbers.
static nature_t plain(void) {
  nature_t n = {.mass_kg = 0.1, .inertia_kgm2 = {1e-4, 1.2e-4, 2e-4}, .ceiling_m = HUGE_VAL, .sag_V = 4.2};
  static const double x[] = {0.06, -0.06, -0.06, 0.06}, y[] = {-0.06, -0.06, 0.06, 0.06},
                      spin[] = {1, -1, 1, -1};
  for (int i = 0; i < 4; i++) n.x_m[i] = x[i], n.y_m[i] = y[i], n.spin[i] = spin[i], n.gain[i] = 1.0;
  n.radius_m = 0.04, n.k_Ns2 = 1e-7, n.torque_m = 0.01, n.lag_s = 0.04, n.most_radps = 3000.0;
  return n;
}

static void run(nature_flight_t *f, double span_s, double radps) {
  const double command[] = {radps, radps, radps, radps};
  for (int i = 0; i < lround(span_s / NATURE_STEP_S); i++) nature_step(f, command);
}

TEST(the_second_plant_hovers_where_thrust_is_weight) {
  const nature_t n = plain();
  nature_flight_t f;
  nature_start(&f, &n, vec(0.0, 0.0, 1.0));
  run(&f, 2.0, nature_hover_radps(&n));
  CHECK_NEAR(4.0 * n.k_Ns2 * pow(nature_hover_radps(&n), 2.0), n.mass_kg * NATURE_G_MPS2, 1e-12);
  CHECK_NEAR(f.s.pos_m.z, 1.0, 1e-9);
  CHECK_NEAR(f.force_b_N.z, n.mass_kg * NATURE_G_MPS2, 1e-9);
}

// In free fall, turning about all axes, energy and angular momentum are constant.
TEST(the_second_plant_keeps_its_energy_without_thrust) {
  const nature_t n = plain();
  nature_flight_t f;
  nature_start(&f, &n, vec(0.0, 0.0, 50.0));
  memset(f.s.rotor_radps, 0, sizeof f.s.rotor_radps);
  memset(f.late_radps, 0, sizeof f.late_radps);
  f.s.vel_mps = vec(1.0, -2.0, 3.0);
  f.s.rate_radps = vec(6.0, 1.0, -4.0);
  double before = 0.0, momentum = 0.0;
  for (int k = 0; k < 2; k++) {
    const vec_t v = f.s.vel_mps, r = f.s.rate_radps;
    const double *const J = n.inertia_kgm2;
    const double turning = 0.5 * (J[0] * r.x * r.x + J[1] * r.y * r.y + J[2] * r.z * r.z);
    const double energy = n.mass_kg * (NATURE_G_MPS2 * f.s.pos_m.z + 0.5 * vec_dot(v, v)) + turning;
    const double spin = vec_length(vec(J[0] * r.x, J[1] * r.y, J[2] * r.z));
    if (k) {
      CHECK_NEAR(energy / before, 1.0, 1e-6);
      CHECK_NEAR(spin / momentum, 1.0, 1e-5);
      CHECK_NEAR(v.z, 3.0 - 2.0 * NATURE_G_MPS2, 1e-9);
    }
    before = energy, momentum = spin;
    if (!k) run(&f, 2.0, 0.0);
  }
}

// Drag at the hubs: turning at w about x, a rotor at y climbs at w y. The moment is -k Om w sum(y^2) about x,
// and about z -k Om w sum(x^2 + y^2).
TEST(drag_at_the_hubs_damps_turning) {
  static const struct {
    const char *what;
    double hub_kg, climb_kg, J, sum_m2;
    int axis;
  } row[] = {{"roll, by the climb of each hub", 0.0, 2e-6, 1e-4, 4 * 0.0036, 0},
             {"yaw, by the way of each hub", 2e-6, 0.0, 2e-4, 8 * 0.0036, 2}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    nature_t n = plain();
    n.hub_kg = row[i].hub_kg, n.climb_kg = row[i].climb_kg;
    nature_flight_t f;
    nature_start(&f, &n, vec(0.0, 0.0, 50.0));
    f.s.rate_radps = row[i].axis ? vec(0.0, 0.0, 1.0) : vec(1.0, 0.0, 0.0);
    const double rate = (row[i].hub_kg + row[i].climb_kg) * nature_hover_radps(&n) * row[i].sum_m2 / row[i].J;
    run(&f, 0.05, nature_hover_radps(&n));
    CHECK_NEAR(row[i].axis ? f.s.rate_radps.z : f.s.rate_radps.x, exp(-rate * 0.05), 1e-4);
  }
}

// After one lag the rotor speed has gone 63 % of a step, also behind a delay; without a lag it follows at
// once.
TEST(the_second_plants_rotors_lag_in_speed) {
  static const double lag_s[] = {0.02, 0.06, 0.0}, delay_s[] = {0.0, 0.01, 0.0};
  for (int i = 0; i < 3; i++) {
    ROW("lag %g s", lag_s[i]);
    nature_t n = plain();
    n.lag_s = lag_s[i], n.delay_s = delay_s[i];
    nature_flight_t f;
    nature_start(&f, &n, vec(0.0, 0.0, 50.0));
    const double from = nature_hover_radps(&n);
    run(&f, lag_s[i] + delay_s[i] + (lag_s[i] > 0.0 ? 0.0 : NATURE_STEP_S), from + 200.0);
    CHECK_NEAR((f.s.rotor_radps[0] - from) / 200.0, lag_s[i] > 0.0 ? 1.0 - exp(-1.0) : 1.0, 2e-3);
  }
}

static nature_flight_t after_hiding(const char *name, double times) {
  static nature_t n;
  dishonest_t senses = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, 0.0, 0.0};
  n = plain();
  const double hover = nature_hover_radps(&n);
  hide_effect(hide_number(name), times, 0.1, &n, &senses);
  nature_flight_t f;
  nature_start(&f, &n, vec(0.0, 0.0, 1.0));
  f.volt = 3.6;
  f.s.vel_mps = vec(1.0, 0.0, 0.5);
  for (int i = 0; i < 4; i++) f.s.rotor_radps[i] = hover;
  run(&f, NATURE_STEP_S, hover);
  return f;
}

// Typical sizes are shares of the weight, or mass times an acceleration.
TEST(what_is_hidden_in_the_second_plant_has_the_size_that_is_said) {
  static const struct {
    const char *name;
    double x, z; // specific force that it adds, m/s2, at 1 m/s forward, 0.5 m/s up and 3.6 V
  } row[] = {{"mass", 0.0, -9.81 * (1.0 - 1.0 / 1.1)},
             {"thrust_scale", 0.0, -0.981},
             {"rotor_drag", -0.5, 0.0},
             {"climb_inflow", 0.0, -0.38},
             {"body_drag", -0.1341, -0.0604},
             {"translational_lift", 0.0, 0.18},
             {"battery_sag", 0.0, -9.81 * 1.2 * (1.0 - 3.6 / 3.84)}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].name);
    const nature_flight_t f = after_hiding(row[i].name, 2.0);
    CHECK_NEAR(f.force_b_N.x / f.nature->mass_kg, row[i].x, 0.003);
    CHECK_NEAR(f.force_b_N.z / f.nature->mass_kg - NATURE_G_MPS2, row[i].z, 0.003);
  }
}

static char *log_of(uint64_t seed, uint64_t flight, bool *flew) {
  dice_t d = {seed};
  other_job_t job = other_job(&d);
  job.truth = job.known;
  job.span_s = 15.0, job.seed = flight;
  FILE *const file = tmpfile();
  felt_t felt = {0.0, 0.0, 0.0};
  *flew = file && other_fly(&job, file, &felt);
  const long size = file ? ftell(file) : 0;
  char *const text = calloc((size_t)size + 1, 1);
  if (file) rewind(file);
  if (file && text) CHECK(fread(text, 1, (size_t)size, file) == (size_t)size);
  if (file) fclose(file);
  return text;
}

TEST(the_second_plant_flies_vehicles_of_all_sizes_and_a_seed_gives_one_log) {
  for (uint64_t seed = 1; seed <= 6; seed++) {
    ROW("seed %d", (int)seed);
    bool flew[3];
    char *const text[] = {log_of(seed, 1, &flew[0]), log_of(seed, 1, &flew[1]), log_of(seed, 2, &flew[2])};
    CHECK(flew[0] && flew[1] && flew[2]);
    CHECK(text[0] && text[1] && text[2] && strlen(text[0]) > 10000);
    CHECK(strcmp(text[0], text[1]) == 0 && strcmp(text[0], text[2]) != 0);
    for (int i = 0; i < 3; i++) free(text[i]);
  }
}

// Cell `column` of the log's row, the last one: -1.
static double cell(const char *log, int row, int column) {
  const char *at = log;
  for (int i = 0; row >= 0 && i <= row; i++) at = strchr(at, '\n') + 1;
  if (row < 0)
    for (const char *next = at; (next = strchr(next, '\n')) && next[1];) at = ++next;
  for (int k = 0; k < column; k++) at = strchr(at, ',') + 1;
  return strtod(at, NULL);
}

TEST(a_ladder_of_the_second_plant_stands_climbs_and_lands) {
  dice_t d = {3};
  other_job_t job = other_job(&d);
  job.truth = job.known;
  job.ladder = true, job.span_s = 26.0, job.seed = 1;
  job.habits.every = 5, job.habits.means = false;
  FILE *const file = tmpfile();
  felt_t felt = {0.0, 0.0, 0.0};
  CHECK(file && other_fly(&job, file, &felt));
  char log[2000000];
  rewind(file);
  log[fread(log, 1, sizeof log - 1, file)] = '\0';
  fclose(file);
  enum { Z = 3, AZ = 13, M1 = 17 };
  CHECK_NEAR(cell(log, 100, Z), job.known.rest_m, 0.02);
  CHECK_NEAR(cell(log, 100, AZ), NATURE_G_MPS2, 1.0); // the floor carries it
  CHECK(cell(log, 100, M1) == 0.0 && cell(log, -1, M1) == 0.0);
  CHECK_NEAR(cell(log, 1300, Z), 0.9 * hide_stretch(&job.known), 0.1); // its top, in the middle of the flight
  CHECK_NEAR(cell(log, -1, Z), job.known.rest_m, 0.02);
}

// The exam draws a set again if its flights did not meet what is hidden: nobody could find it.
TEST(the_second_plant_counts_how_long_what_no_library_has_is_felt) {
  static const struct {
    const char *what;
    strange_kind_t strange;
    double at[3], x_m, z_m; // where the vehicle hovers
    double share;           // of the flight
  } row[] = {
      {"at the place", STRANGE_PLACE, {1.0, 0.0, 0.5}, 1.0, 1.0, 1.0},
      {"where half of it is felt", STRANGE_PLACE, {1.0, 0.0, 0.5}, 1.4, 1.0, 1.0}, // exp(-0.64)
      {"beside it", STRANGE_PLACE, {1.0, 0.0, 0.5}, 1.5, 1.0, 0.0},                // exp(-1)
      {"above a layer", STRANGE_LAYER, {1.0, 0.0, 0.2}, 0.0, 1.3, 0.0},
      {"out of the corner", STRANGE_CORNER, {0.5, -0.5, 0.0}, 0.0, 1.0, 0.0},
      {"a pulse in each half second", STRANGE_PULSES, {0.5, 0.0, 0.1}, 0.0, 1.0, 0.2},
      {"a shake, but where it turns", STRANGE_SHAKE, {2.0, 0.0, 0.0}, 0.0, 1.0, 2.0 / 3.0},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    nature_t n = plain();
    nature_flight_t f;
    n.strange = row[i].strange;
    n.strange_N = 1e-9 * n.mass_kg; // so weak that the vehicle stays where it is
    memcpy(n.strange_at, row[i].at, sizeof n.strange_at);
    nature_start(&f, &n, vec(row[i].x_m, 0.0, row[i].z_m));
    run(&f, 1.0, nature_hover_radps(&n));
    CHECK_NEAR(f.felt_s, row[i].share, 0.01);
  }
}

// Take-off and landing meet the ground, the steps between them meet the ceiling.
TEST(the_second_plant_counts_how_long_a_surface_that_the_file_lacks_is_felt) {
  static const struct {
    const char *what;
    double ground, ceiling, known; // shares
    bool feels_ground, feels_ceiling;
  } row[] = {{"nothing", 0.0, 0.0, 0.0, false, false},
             {"a ground", 1.0, 0.0, 0.0, true, false},
             {"a ground of no size", 0.01, 0.0, 0.0, false, false},
             {"a ceiling", 0.0, 0.2, 0.0, false, true},
             {"a ceiling that the file has", 0.0, 0.2, 0.2, false, false},
             {"one of which it has too little", 0.0, 0.2, 0.15, false, true}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    dice_t d = {1};
    other_job_t job = other_job(&d);
    hide_prepare(hide_number("ceiling"), &d, &job.known);
    job.known.ceiling_m0 = 4.0 * job.known.radius_m;
    job.known.ceiling_share = row[i].known;
    job.truth = job.known;
    job.truth.ceiling_share = row[i].ceiling;
    job.truth.ground_share = row[i].ground;
    job.ladder = true, job.span_s = 26.0, job.seed = 1;
    FILE *const file = tmpfile();
    felt_t felt = {0.0, 0.0, 0.0};
    CHECK(file && other_fly(&job, file, &felt));
    CHECK((felt.ground_s > 0.5) == row[i].feels_ground && (felt.ceiling_s > 0.5) == row[i].feels_ceiling);
    CHECK((felt.ground_s > 0.0) == row[i].feels_ground && (felt.ceiling_s > 0.0) == row[i].feels_ceiling);
    if (file) fclose(file);
  }
}
