// test_drawn.c - what a level of noise draws for each flight: every row moves what it says and nothing else,
// within its range, the same for the same seed; and levels that draw nothing fly as they always did.
#include "flight/drawn.h"
#include "flight/scenario.h"
#include "rig/test.h"
#include "rig/vehicle6.h"

#include <string.h>

#define SEEDS 4000

static drawn_t drawn(const vary_t *vary, uint64_t seed) {
  drawn_t d;
  why_t why;
  CHECK_OK(drawn_of(vary, seed, &d, &why));
  return d;
}

static double flown_says(const char *key) {
  for (int i = 0; i < noise_field_count; i++)
    if (strcmp(noise_fields[i].name, key) == 0) return noise_get(noise_find("flown"), &noise_fields[i]);
  ROW("no row %s", key);
  CHECK(false);
  return (double)NAN;
}

static const drawn_field_t *field_of(const char *name) {
  for (int i = 0; i < drawn_field_count; i++)
    if (strcmp(drawn_fields[i].name, name) == 0) return &drawn_fields[i];
  ROW("no number %s", name);
  CHECK(false);
  return drawn_fields;
}

// Least, greatest, mean and spread of one number over many flights.
typedef struct {
  double least, most, mean, sd;
} span_t;

static span_t span_of(const char *name, const vary_t *vary) {
  span_t s = {HUGE_VAL, -HUGE_VAL, 0.0, 0.0};
  for (uint64_t seed = 0; seed < SEEDS; seed++) {
    const drawn_t d = drawn(vary, seed);
    const double value = drawn_get(&d, field_of(name));
    s.least = fmin(s.least, value);
    s.most = fmax(s.most, value);
    s.mean += value / SEEDS;
    s.sd += value * value / SEEDS;
  }
  s.sd = sqrt(s.sd - s.mean * s.mean);
  return s;
}

static const struct {
  const char *name;
  double least, most;
} EVEN[] = {
    {"gust_mps2", 0.05, 0.15},
    {"mass", -0.03, 0.03},
    {"thrust", -0.05, 0.05},
    {"rotor", -0.02, 0.02},
    {"rotor_number", 1.0, 4.0},
    {"lag", -0.15, 0.15},
    {"delay_s", 0.0, 0.006},
    {"up_scale", -0.01, 0.01},
    {"up_offset_m", -0.003, 0.003},
    {"down_scale", -0.01, 0.01},
    {"down_offset_m", -0.003, 0.003},
    {"curve_a", -0.3, 0.3},
    {"curve_b", -0.2, 0.2},
    {"top_m", -0.001, 0.002},
    {"mount_x_rad", -0.5 * RAD_PER_DEG, 0.5 * RAD_PER_DEG},
    {"mount_y_rad", -0.5 * RAD_PER_DEG, 0.5 * RAD_PER_DEG},
};

TEST(drawn_numbers_fill_their_ranges_evenly) {
  for (unsigned i = 0; i < sizeof EVEN / sizeof *EVEN; i++) {
    ROW("%s", EVEN[i].name);
    const span_t s = span_of(EVEN[i].name, &noise_find("flown")->vary);
    const double width = EVEN[i].most - EVEN[i].least;
    const bool whole = strcmp(EVEN[i].name, "rotor_number") == 0; // four values: the spread is sqrt(15 / 12)
    CHECK(s.least >= EVEN[i].least && s.least < EVEN[i].least + 0.005 * width);
    CHECK(s.most <= EVEN[i].most && s.most > EVEN[i].most - 0.005 * width);
    CHECK_NEAR(s.mean, 0.5 * (EVEN[i].least + EVEN[i].most), 0.03 * width); // 0.0046 of its sd
    CHECK_NEAR(s.sd, whole ? sqrt(1.25) : width / sqrt(12.0), 0.01 * width);
  }
  for (int axis = 0; axis < 3; axis++) {
    static const char *const name[] = {"acc_bias_x_mps2", "acc_bias_y_mps2", "acc_bias_z_mps2"};
    ROW("%s", name[axis]);
    const span_t s = span_of(name[axis], &noise_find("flown")->vary);
    CHECK_NEAR(s.mean, 0.0, 0.004);
    CHECK_NEAR(s.sd, 0.05, 0.002);
    CHECK(s.most > 0.12 && s.least < -0.12); // normal, not even
  }
}

TEST(drawn_numbers_are_those_of_the_seed) {
  const vary_t *const vary = &noise_find("flown")->vary;
  const drawn_t one = drawn(vary, 1), again = drawn(vary, 1), other = drawn(vary, 2);
  for (int i = 0; i < drawn_field_count; i++) {
    ROW("%s", drawn_fields[i].name);
    CHECK(drawn_get(&one, &drawn_fields[i]) == drawn_get(&again, &drawn_fields[i]));
    if (strcmp(drawn_fields[i].name, "rotor_number") != 0)
      CHECK(drawn_get(&one, &drawn_fields[i]) != drawn_get(&other, &drawn_fields[i]));
  }
}

// Each row of the table that begins with "vary.": what of a flight it moves.
static const struct {
  const char *key, *moves[3];
} ROWS[] = {
    {"vary.gust.min", {"gust_mps2"}},
    {"vary.gust.max", {"gust_mps2"}},
    {"vary.mass", {"mass"}},
    {"vary.thrust", {"thrust"}},
    {"vary.rotor", {"rotor"}},
    {"vary.lag", {"lag"}},
    {"vary.delay", {"delay_s"}},
    {"vary.bias", {"acc_bias_x_mps2", "acc_bias_y_mps2", "acc_bias_z_mps2"}},
    {"vary.scale", {"up_scale", "down_scale"}},
    {"vary.offset", {"up_offset_m", "down_offset_m"}},
    {"vary.Ca", {"curve_a"}},
    {"vary.Cb", {"curve_b"}},
    {"vary.top.min", {"top_m"}},
    {"vary.top.max", {"top_m"}},
    {"vary.mount", {"mount_x_rad", "mount_y_rad"}},
};

static bool moved(unsigned row, const char *name) {
  for (int i = 0; i < 3 && ROWS[row].moves[i]; i++)
    if (strcmp(ROWS[row].moves[i], name) == 0) return true;
  return false;
}

TEST(each_row_moves_what_it_says_and_no_other) {
  const noise_t flown = *noise_find("flown");
  for (unsigned i = 0; i < sizeof ROWS / sizeof *ROWS; i++) {
    noise_t changed = flown;
    CHECK(noise_set(&changed, ROWS[i].key, 0.5 * flown_says(ROWS[i].key)));
    const drawn_t was = drawn(&flown.vary, 11), is = drawn(&changed.vary, 11);
    for (int k = 0; k < drawn_field_count; k++) {
      ROW("%s, %s", ROWS[i].key, drawn_fields[k].name);
      const bool same = drawn_get(&was, &drawn_fields[k]) == drawn_get(&is, &drawn_fields[k]);
      CHECK(same == !moved(i, drawn_fields[k].name));
    }
  }
}

TEST(each_row_that_varies_is_tried_here) {
  unsigned n = 0;
  for (int i = 0; i < noise_field_count; i++) {
    const char *const name = noise_fields[i].name;
    if (strncmp(name, "vary.", 5) != 0 || strcmp(name, "vary.gust.tau") == 0) continue;
    ROW("%s", name);
    if (CHECK(n < sizeof ROWS / sizeof *ROWS)) CHECK_TEXT(name, ROWS[n].key);
    n++;
  }
  CHECK(n == sizeof ROWS / sizeof *ROWS);
}

static model_t vehicle_of(const drawn_t *d) {
  model_t m = vehicle6(0.5);
  vehicle6_add(&m, "ceiling");
  why_t why;
  CHECK_OK(drawn_vehicle(d, &m, &why));
  return m;
}

static double first_climb_mps2(const model_t *m) {
  const body_start_t start = vehicle6_start(m, 0.2, 1.0);
  body_t b;
  if (!CHECK_OK(body_open(&b, m, INTEGRATE_RK4, TICK_S, &start))) return (double)NAN;
  const double acc_mps2 = body_specific_force_b_mps2(&b).z - 9.81;
  body_close(&b);
  return acc_mps2;
}

TEST(a_drawn_vehicle_is_the_files_vehicle_but_for_what_was_drawn) {
  const drawn_t none = {.rotor_number = 1.0};
  const model_t file = vehicle_of(&none);
  model_t m = vehicle_of(&(drawn_t){.rotor_number = 1.0, .mass = 0.1});
  CHECK_NEAR(m.mass_kg, 1.1 * MASS_KG, 1e-15);
  CHECK_NEAR(first_climb_mps2(&m), 9.81 * (1.0 / 1.1 - 1.0), 1e-9);
  m = vehicle_of(&(drawn_t){.rotor_number = 1.0, .lag = -0.1});
  CHECK_NEAR(m.motor_tau_s, 0.9 * file.motor_tau_s, 1e-15);
  m = vehicle_of(&(drawn_t){.rotor_number = 1.0, .delay_s = 0.004});
  CHECK_NEAR(m.frame.motor_delay_s, file.frame.motor_delay_s + 0.004, 1e-15);
  m = vehicle_of(&(drawn_t){.rotor_number = 1.0, .top_m = 0.002});
  CHECK_NEAR(m.frame.top_above_rotor_m, file.frame.top_above_rotor_m + 0.002, 1e-15);
  m = vehicle_of(&(drawn_t){.rotor_number = 1.0, .thrust = 0.05});
  CHECK_NEAR(first_climb_mps2(&m), 9.81 * 0.05, 1e-6); // and what the ceiling does, 30 cm away
  m = vehicle_of(&(drawn_t){.rotor_number = 1.0, .curve_a = 0.3, .curve_b = -0.2});
  const fx_place_t place = {0.02, HUGE_VAL, RADIUS_M};
  CHECK_NEAR(model_thrust_ratio(&m, &place), 1.0 + 1.3 * 0.44 * exp(-0.8 * 1.8 * 0.02 / RADIUS_M), 1e-12);
}

TEST(a_drawn_rotor_turns_the_vehicle) {
  // Front right, back right, back left, front left: which way a stronger one rolls and pitches.
  static const double roll[] = {-1.0, -1.0, 1.0, 1.0}, pitch[] = {-1.0, 1.0, 1.0, -1.0};
  for (int i = 0; i < ROTORS; i++) {
    ROW("rotor %d", i + 1);
    const model_t m = vehicle_of(&(drawn_t){.rotor_number = i + 1.0, .rotor = 0.02});
    const body_start_t start = vehicle6_start(&m, 0.2, 1.0);
    body_t b;
    if (!CHECK_OK(body_open(&b, &m, INTEGRATE_RK4, TICK_S, &start))) continue;
    const d3_t turns = vehicle6_angular_acc_b_radps2(&b);
    const double most = 0.02 * 0.25 * WEIGHT_N * fabs(m.frame.rotor_y_m[0]) / m.frame.inertia_kgm2[0];
    CHECK_NEAR(turns.x, roll[i] * most, 1e-6 * most);
    CHECK_NEAR(turns.y, pitch[i] * most, 1e-6 * most);
    CHECK_NEAR(turns.z,
               -0.02 * 0.25 * WEIGHT_N * m.frame.torque_ratio_m * m.frame.rotor_spin[i] /
                   m.frame.inertia_kgm2[2],
               1e-9);
    body_close(&b);
  }
}

TEST(drawn_gusts_push_as_hard_and_as_long_as_they_say) {
  const drawn_t d = {.rotor_number = 1.0, .gust_mps2 = 0.1, .gust_tau_s = 0.3};
  const model_t m = vehicle_of(&d);
  body_start_t start = vehicle6_start(&m, 0.2, 1.0);
  start.held = true; // the wind blows all the same
  start.seed = 5;
  body_t b;
  if (!CHECK_OK(body_open(&b, &m, INTEGRATE_RK4, TICK_S, &start))) return;
  const int n = 300000, later = 150; // 0.3 s: by then a gust has fallen to 1/e
  double sum2 = 0.0, along = 0.0, past[150] = {0.0};
  for (int i = 0; i < n; i++) {
    vehicle6_fly(&b, 1.0, 1);
    const double push = b.plant.force_w_N.z / m.mass_kg;
    sum2 += push * push / n;
    along += push * past[i % later] / n;
    past[i % later] = push;
  }
  CHECK_NEAR(sqrt(sum2), 0.1, 0.005);
  CHECK_NEAR(along / sum2, exp(-1.0), 0.06);
  body_close(&b);
}

TEST(a_wind_that_has_gusts_keeps_them_and_one_that_has_none_gets_them) {
  for (int i = 0; i < 2; i++) {
    model_t m = vehicle6(0.5);
    fx_use_t *const wind = vehicle6_add(&m, "wind");
    wind->p[0] = 0.01;
    wind->p[3] = i == 0 ? 0.02 : 0.0;
    wind->p[4] = 1.5;
    why_t why;
    CHECK_OK(drawn_vehicle(&(drawn_t){.rotor_number = 1.0, .gust_mps2 = 0.1, .gust_tau_s = 0.3}, &m, &why));
    CHECK(m.n_fx == 1);
    CHECK_NEAR(m.fx[0].p[0], 0.01, 0.0);
    CHECK_NEAR(m.fx[0].p[3], i == 0 ? 0.02 : 0.1 * MASS_KG, 1e-12);
    CHECK_NEAR(m.fx[0].p[4], i == 0 ? 1.5 : 0.3, 0.0);
  }
}

TEST(drawn_sensors_add_to_what_the_level_says) {
  noise_t n = *noise_find("real");
  CHECK(noise_set(&n, "acc.bias.z", 0.1) && noise_set(&n, "mount.y", 0.01) &&
        noise_set(&n, "down.scale", 0.02) && noise_set(&n, "up.offset", -0.001));
  const noise_t before = n;
  const drawn_t d = {.acc_bias_b_mps2 = {1.0, 2.0, 3.0},
                     .mount_x_rad = 0.1,
                     .mount_y_rad = 0.2,
                     .up_scale = 0.01,
                     .up_offset_m = 0.003,
                     .down_scale = -0.01,
                     .down_offset_m = 0.002};
  drawn_sense(&d, &n);
  CHECK_NEAR(n.imu.acc_bias_b_mps2.x, 1.0, 0.0);
  CHECK_NEAR(n.imu.acc_bias_b_mps2.y, 2.0, 0.0);
  CHECK_NEAR(n.imu.acc_bias_b_mps2.z, 3.1, 1e-15);
  CHECK_NEAR(n.imu.mount_rad.x, 0.1, 0.0);
  CHECK_NEAR(n.imu.mount_rad.y, 0.21, 1e-15);
  CHECK_NEAR(n.range.up_scale, 0.01, 0.0);
  CHECK_NEAR(n.range.up_offset_m, 0.002, 1e-15);
  CHECK_NEAR(n.range.down_scale, 0.01, 1e-15);
  CHECK_NEAR(n.range.down_offset_m, 0.002, 0.0);
  CHECK(n.range.up_m == before.range.up_m && n.imu.acc_z_mps2 == before.imu.acc_z_mps2);
}

// --- in flight --------------------------------------------------------------------------------------------

static flown_t fly(const noise_t *noise, fly_kind_t kind, double end_s, uint64_t seed) {
  const request_t request = {.integrate = INTEGRATE_RK4, .seed = seed, .noise = noise};
  setup_t setup;
  flown_t flown = {.n_segment = 0};
  why_t why;
  CHECK_OK(setup_thesis(&setup, kind, &why));
  CHECK_OK(setup_apply(&setup, &request, &why));
  setup.plan.take_off_s = 1.0;
  setup.plan.way[0] = (waypoint_t){0.0, 0.3};
  setup.plan.n_way = 1;
  setup.plan.end_s = end_s;
  CHECK_OK(setup_fly(&setup, &flown, &why));
  return flown;
}

static bool same_bits(const flown_t *a, const flown_t *b) {
  if (a->record.n != b->record.n || a->record.n == 0) return false;
  for (int i = 0; i < a->record.n; i++) {
    const sample_t *x = &a->record.sample[i], *y = &b->record.sample[i];
    if (x->z_m != y->z_m || x->acc_b_mps2.z != y->acc_b_mps2.z || x->gyro_b_radps.x != y->gyro_b_radps.x ||
        x->pos_w_m.x != y->pos_w_m.x || x->motor_N[2] != y->motor_N[2])
      return false;
  }
  return true;
}

TEST(flown_without_what_it_draws_is_real_to_the_bit) {
  noise_t nothing = *noise_find("flown");
  for (int i = 0; i < noise_field_count; i++)
    if (strncmp(noise_fields[i].name, "vary.", 5) == 0 && noise_fields[i].min <= 0.0)
      CHECK(noise_set(&nothing, noise_fields[i].name, 0.0));
  static const fly_kind_t kind[] = {FLY_INDI_THEORY, FLY_STOCK_PID, FLY_STOCK_INDI};
  for (unsigned i = 0; i < sizeof kind / sizeof *kind; i++) {
    ROW("%s", fly_name[kind[i]]);
    flown_t real = fly(noise_find("real"), kind[i], 4.0, 9), bare = fly(&nothing, kind[i], 4.0, 9),
            all = fly(noise_find("flown"), kind[i], 4.0, 9);
    CHECK(same_bits(&real, &bare));
    CHECK(!same_bits(&real, &all));
    flown_free(&real);
    flown_free(&bare);
    flown_free(&all);
  }
}

// As the stock PID, in which nothing is tuned, flew at these levels before there was another.
TEST(quiet_and_real_keep_their_flights) {
  static const struct {
    const char *level;
    double z_m, x_m;
  } row[] = {{"quiet", 0.293749421530, 0.0}, {"real", 0.293498499703, 0.000420765169}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].level);
    flown_t f = fly(noise_find(row[i].level), FLY_STOCK_PID, 3.0, 9);
    const sample_t *const last = &f.record.sample[f.record.n - 1];
    CHECK_NEAR(last->z_m, row[i].z_m, 1e-9); // the last digits of a C library's exp are its own
    CHECK_NEAR(last->pos_w_m.x, row[i].x_m, 1e-9);
    flown_free(&f);
  }
}

TEST(each_row_is_felt_in_flight) {
  for (unsigned i = 0; i < sizeof ROWS / sizeof *ROWS; i++) {
    ROW("%s", ROWS[i].key);
    noise_t one = *noise_find("real");
    const double value = flown_says(ROWS[i].key);
    CHECK(noise_set(&one, ROWS[i].key, value));
    flown_t real = fly(noise_find("real"), FLY_STOCK_PID, 3.0, 9), with = fly(&one, FLY_STOCK_PID, 3.0, 9);
    // The body's top is felt at contact alone.
    CHECK(same_bits(&real, &with) == (strncmp(ROWS[i].key, "vary.top", 8) == 0));
    flown_free(&real);
    flown_free(&with);
  }
}

TEST(the_same_seed_draws_the_same_whoever_flies) {
  flown_t one = fly(noise_find("flown"), FLY_STOCK_PID, 1.5, 3),
          two = fly(noise_find("flown"), FLY_INDI, 1.5, 3);
  for (int i = 0; i < drawn_field_count; i++) {
    ROW("%s", drawn_fields[i].name);
    CHECK(drawn_get(&one.outcome.drawn, &drawn_fields[i]) == drawn_get(&two.outcome.drawn, &drawn_fields[i]));
  }
  CHECK(one.outcome.drawn.mass != 0.0);
  flown_free(&one);
  flown_free(&two);
}
