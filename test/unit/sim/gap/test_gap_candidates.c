// test_gap_candidates.c - what every effect tells the workflow of itself: what it needs to be looked for,
// where it shows, and what tells it from its rivals.
#include "gap/4_candidates/candidates.h"
#include "gap/5_infer/unknown.h"
#include "rig/gap_rows.h"
#include "rig/test.h"
#include "vehicle/model_file.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// A log that has everything, in a room with a ceiling and a wall.
typedef struct {
  gap_flight_t flight;
  grid_t grid;
  set_t set;
  model_t model;
} log_t;

static void log_make(log_t *l) {
  why_t why;
  *l = (log_t){.flight = {.rate_Hz = 500.0}};
  CHECK_OK(model_builtin("cf21_legacy", &l->model, &why));
  l->model.ceiling_m = l->model.wall_y_m = 0.5;
  l->grid = (grid_t){.flight = &l->flight,
                     .has_attitude = true,
                     .has_rates = true,
                     .has_force = true,
                     .has_velocity = true,
                     .has_position = true,
                     .has_vbat = true,
                     .has_moments = true};
  l->set = (set_t){.grid = &l->grid, .n_grid = 1, .range = {.n = 1000}};
}

typedef void (*lose_t)(log_t *l);
static void ceiling(log_t *l) {
  l->model.ceiling_m = HUGE_VAL;
}
static void wall(log_t *l) {
  l->model.wall_y_m = HUGE_VAL;
}
static void place(log_t *l) {
  l->grid.has_position = false;
}
static void range(log_t *l) {
  l->set.range.n = 0;
}
static void voltage(log_t *l) {
  l->grid.has_vbat = false;
}
static void speed(log_t *l) {
  l->grid.has_velocity = false;
}
static void attitude(log_t *l) {
  l->grid.has_attitude = false;
}
static void made_acceleration(log_t *l) {
  l->grid.acceleration_made = true;
}
static void quickness(log_t *l) {
  l->flight.rate_Hz = 50.0;
}
static void turning(log_t *l) {
  l->grid.has_rates = false;
}
static void force_and_turning(log_t *l) {
  l->grid.has_force = l->grid.has_rates = false;
}

// What is known of effects by name. One that is new is held by what it says that it needs.
#define OF_A_RANGE " tof_bias tof_floor tof_latency "
#define OF_THE_VEHICLE                                                                                       \
  " accel_bias battery_sag body_drag ceiling ceiling_rpm cg_offset climb_inflow delay flapping ground "      \
  "gyroscopic imu_misalignment inertia mass motor_damage motor_lag rotor_drag sidewall thrust_curve "        \
  "thrust_scale torque_ratio translational_lift wind "

static bool is_among(const char *names, const char *name) {
  char word[100];
  snprintf(word, sizeof word, " %s ", name);
  return strstr(names, word) != NULL;
}

// The effects that can no longer be looked for when something is lost.
TEST(gap_looks_for_an_effect_where_the_log_has_what_it_needs) {
  static const struct {
    const char *what;
    lose_t lose;
    int needs; // of them one at least
    const char *effects;
  } row[] = {
      {"nothing", NULL, 0, ""},
      {"ceiling", ceiling, FX_NEEDS_CEILING, " ceiling ceiling_rpm "},
      {"wall", wall, FX_NEEDS_WALL, " sidewall "},
      {"position", place, FX_NEEDS_POSITION | FX_NEEDS_RANGE,
       " ceiling ceiling_rpm ground sidewall" OF_A_RANGE},
      {"range", range, FX_NEEDS_RANGE, OF_A_RANGE},
      {"voltage", voltage, FX_NEEDS_VOLTAGE, " battery_sag "},
      {"velocity", speed, FX_NEEDS_VELOCITY,
       " body_drag climb_inflow flapping rotor_drag sidewall translational_lift "},
      {"attitude", attitude, FX_NEEDS_ATTITUDE, " wind "},
      {"acceleration", made_acceleration, FX_NEEDS_ACCELERATION, " accel_bias imu_misalignment "},
      {"a quick log, which they do not need", quickness, 0, ""},
      {"turning", turning, FX_NEEDS_TURNING, " motor_tilt "},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    log_t l;
    log_make(&l);
    if (row[i].lose) row[i].lose(&l);
    for (int k = 0; k < fx_count; k++) {
      const fx_t *const fx = fx_table[k];
      const bool lost = candidates_obstacle(fx, &l.model, &l.set) != NULL;
      ROW("without %s: %s", row[i].what, fx->name);
      CHECK(lost == (fx->n_size == 0 || (fx->needs & row[i].needs)));
      if (is_among(OF_A_RANGE OF_THE_VEHICLE, fx->name)) CHECK(lost == is_among(row[i].effects, fx->name));
    }
  }
}

TEST(gap_looks_for_nothing_but_a_range_s_errors_where_the_log_has_neither_force_nor_turning) {
  log_t l;
  log_make(&l);
  force_and_turning(&l);
  for (int k = 0; k < fx_count; k++) {
    const fx_t *const fx = fx_table[k];
    const bool looks = candidates_obstacle(fx, &l.model, &l.set) == NULL;
    ROW("%s", fx->name);
    CHECK(looks == (fx->n_size > 0 && (fx->needs & FX_NEEDS_RANGE)));
    if (is_among(OF_A_RANGE OF_THE_VEHICLE, fx->name)) CHECK(looks == is_among(OF_A_RANGE, fx->name));
  }
}

static bool is_coordinate(const char *name) {
  for (int i = 0; i < COORDINATES; i++)
    if (strcmp(coordinate_name(i), name) == 0) return true;
  return false;
}

static bool is_channel(const char *name) {
  for (int i = 0; i < CHANNELS; i++)
    if (strcmp(gap_channel[i], name) == 0) return true;
  return false;
}

TEST(every_effect_shows_over_coordinates_and_in_a_channel_that_there_are) {
  for (int i = 0; i < fx_count; i++) {
    const fx_t *const fx = fx_table[i];
    ROW("%s", fx->name);
    for (int k = 0; k < 2; k++) CHECK(!fx->over[k] || is_coordinate(fx->over[k]));
    CHECK(!fx->in || is_channel(fx->in));
  }
}

TEST(every_pair_of_effects_says_once_how_to_tell_them_apart) {
  int pairs = 0;
  for (int i = 0; i < fx_count; i++)
    for (int k = 0; k < FX_APART_MAX && fx_table[i]->apart[k].rival; k++, pairs++) {
      const fx_t *const fx = fx_table[i], *const rival = fx_find(fx->apart[k].rival);
      ROW("%s, %s", fx->name, fx->apart[k].rival);
      if (!CHECK(rival && rival != fx)) continue;
      CHECK(fx_apart(fx, rival) == fx->apart[k].fly && fx_apart(rival, fx) == fx->apart[k].fly);
    }
  CHECK(pairs > 40);
  CHECK(fx_apart(fx_find("ceiling"), fx_find("wind")) == NULL);
}

TEST(what_is_typical_of_a_number_accelerates_a_large_vehicle_as_it_does_a_crazyflie) {
  // Four times the lengths, 64 times the mass: inertia 1024 times, kf 256 times, a hover at half the speed.
  static const struct {
    fx_grows_t how;
    double times;
  } row[] = {{FX_SAME, 1.0},
             {FX_BY_MASS, 64.0},
             {FX_BY_INERTIA, 1024.0},
             {FX_BY_MASS_PER_SPEED, 128.0},
             {FX_BY_ARM, 4.0},
             {FX_BY_INERTIA_PER_SPEED, 2048.0},
             {FX_BY_PER_WEIGHT, 1 / 64.0}};
  const model_t like = {.mass_kg = 0.0329, .rotor_radius_m = 0.02355};
  model_t large = {.mass_kg = 64.0 * 0.0329, .rotor_radius_m = 4.0 * 0.02355};
  large.frame = model_frame_like_crazyflie(&large);
  model_t small = like;
  small.frame = model_frame_like_crazyflie(&like);
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%d", (int)row[i].how);
    CHECK_NEAR(model_grows(&small, row[i].how), 1.0, 1e-12);
    CHECK_NEAR(model_grows(&large, row[i].how), row[i].times, 1e-9 * row[i].times);
  }
}

// Three radii off a decay of 0.2 per radius would else do a hundred times what one of 1.8 does.
TEST(gap_takes_decays_of_typical_size_as_equally_strong_one_radius_off) {
  candidates_t c;
  why_t why;
  log_t l;
  log_make(&l);
  CHECK_OK(candidates_make(&c, &l.model, &l.set, &why));
  const double radius_m = l.model.rotor_radius_m;
  const fx_place_t near = {radius_m, radius_m, radius_m};
  int decays = 0;
  for (int i = 0; i < c.n; i++) {
    fx_use_t use = c.candidate[i].use, typical = fx_use(use.fx);
    if (!use.fx->excess) continue;
    ROW("%s %g", use.fx->name, use.p[1]);
    use.p[0] = c.candidate[i].typical[0];
    CHECK_NEAR(use.fx->excess(&use, &near), typical.fx->excess(&typical, &near), 1e-9);
    decays++;
  }
  CHECK(decays == 36); // nine of each kind of ceiling and ground, of these three inverse squares
  candidates_free(&c);
}

TEST(an_effect_of_the_file_is_one_candidate_whose_numbers_are_differences) {
  log_t l;
  candidates_t c;
  why_t why;
  log_make(&l);
  fx_use_t drag = fx_use(fx_find("rotor_drag"));
  drag.p[0] = 2e-6, drag.p[1] = 0.0;
  CHECK_OK(model_add_fx(&l.model, &drag, &why));
  CHECK_OK(candidates_make(&c, &l.model, &l.set, &why));
  int found = 0;
  for (int i = 0; i < c.n; i++) {
    const candidate_t *const own = &c.candidate[i];
    CHECK(own->in_file == (own->use.fx == drag.fx));
    if (!own->in_file) continue;
    found++;
    CHECK_NEAR(own->use.p[0], 0.0, 0.0);
    CHECK_NEAR(own->use.p[1], 0.0, 0.0);     // the kind is the file's
    CHECK_NEAR(own->least[0], -2e-6, 1e-18); // all of it
    fx_use_t half = own->use;
    half.p[0] = -1e-6;
    CHECK_NEAR(effect_whole(&l.model, &half).p[0], 1e-6, 1e-18);
  }
  CHECK(found == 1);
  candidates_free(&c);
}

// Nothing that is tried in shapes has numbers apart: which of them would go with which is not said.
TEST(every_effect_with_numbers_apart_has_a_name_for_them_and_no_other_shapes) {
  for (int i = 0; i < fx_count; i++) {
    ROW("%s", fx_table[i]->name);
    CHECK(!fx_table[i]->size_apart == !fx_table[i]->apart_name &&
          fx_table[i]->size_apart < fx_table[i]->n_size + 1);
    CHECK(!fx_table[i]->size_apart || (!fx_table[i]->n_shape && !fx_table[i]->surface));
  }
}

// An accelerometer's error along z is alike more mass, those along x and y are alike wind.
TEST(numbers_that_have_other_rivals_are_a_candidate_of_their_own) {
  log_t l;
  candidates_t c;
  why_t why;
  model_t m;
  chosen_t chosen = {.n = 0};
  int level = -1, upright = -1, lifts = 0;
  log_make(&l);
  CHECK_OK(candidates_make(&c, &l.model, &l.set, &why));
  for (int i = 0; i < c.n; i++) {
    const candidate_t *const own = &c.candidate[i];
    if (own->use.fx != fx_find("accel_bias")) {
      CHECK(own->use.fx->size_apart || (own->from == 0 && own->to == own->n));
      lifts += own->from == 2; // of a wind, in no kind
      continue;
    }
    *(own->from == 0 ? &level : &upright) = i;
  }
  if (!CHECK(level >= 0 && upright >= 0 && lifts == 1)) {
    candidates_free(&c);
    return;
  }
  const candidate_t *const a = &c.candidate[level], *const b = &c.candidate[upright];
  CHECK(a->to == 2 && b->from == 2 && b->to == 3);
  CHECK(!candidates_exclude(a, b) && candidates_exclude(a, a));
  CHECK_TEXT(candidate_name(a), "accel_bias");
  CHECK_TEXT(candidate_name(b), "accel_bias z");
  CHECK(candidates_of(&c, level) == 1 && candidates_of(&c, upright) == 1);
  fx_use_resize(chosen_take(&chosen, &c, level), 0, 0.3);
  fx_use_resize(chosen_take(&chosen, &c, upright), 2, -0.2);
  CHECK_OK(chosen_model(&chosen, &l.model, &m, &why));
  const fx_use_t *const both = model_fx(&m, a->use.fx);
  CHECK(m.n_fx == l.model.n_fx + 1 && both->p[0] == 0.3 && both->p[1] == 0.0 && both->p[2] == -0.2);
  candidates_free(&c);
}

// A choice of one name, or of none.
static chosen_t choice_of(const candidates_t *c, const char *name, double size, double shape) {
  chosen_t chosen = {.n = 0};
  for (int i = 0; i < c->n && name; i++) {
    const fx_t *const fx = c->candidate[i].use.fx;
    if (strcmp(fx->name, name) != 0) continue;
    fx_use_t *const use = chosen_take(&chosen, c, i);
    fx_use_resize(use, 0, size);
    if (c->candidate[i].n_shape) use->p[fx->shape_param] = shape;
    break;
  }
  CHECK(chosen.n == (name ? 1 : 0));
  return chosen;
}

// Shapes that are tried lie at 0.2, 0.34, 0.6, .. of a ceiling.
TEST(what_was_flown_is_another_model_from_a_tenth_of_the_way_to_another_shape_on) {
  static const struct {
    const char *what, *flown, *found;
    double flown_size, found_size, flown_shape, found_shape;
    bool other;
  } row[] = {
      {"nothing, and nothing", NULL, NULL, 0, 0, 0, 0, false},
      {"a size alone is a straight line", "mass", "mass", 0.003, 0.006, 0, 0, false},
      {"it is not found again", "mass", NULL, 0.003, 0, 0, 0, true},
      {"a size that was not flown", NULL, "mass", 0, 0.003, 0, 0, false},
      {"a shape that was not flown", NULL, "ceiling", 0, 0.4, 0, 0.34, true},
      {"the same shape", "ceiling", "ceiling", 0.4, 0.8, 0.34, 0.34, false},
      {"9 % of the way to the next", "ceiling", "ceiling", 0.4, 0.4, 0.21, 0.2226, false},
      {"11 %", "ceiling", "ceiling", 0.4, 0.4, 0.21, 0.2254, true},
      {"11 %, back", "ceiling", "ceiling", 0.4, 0.4, 0.2254, 0.21, true},
      {"9 % of a delay", "delay", "delay", 0.0109, 0.01, 0, 0, false},
      {"11 %", "delay", "delay", 0.0111, 0.01, 0, 0, true},
      {"a delay that was not flown", NULL, "delay", 0, 0.01, 0, 0, true},
  };
  log_t l;
  candidates_t c;
  why_t why;
  log_make(&l);
  CHECK_OK(candidates_make(&c, &l.model, &l.set, &why));
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    const chosen_t flown = choice_of(&c, row[i].flown, row[i].flown_size, row[i].flown_shape);
    const chosen_t found = choice_of(&c, row[i].found, row[i].found_size, row[i].found_shape);
    CHECK(chosen_other(&c, &flown, &found) == row[i].other);
  }
  candidates_free(&c);
}

TEST(gap_knows_which_scales_of_the_thrust_the_turning_alone_would_tell) {
  static const struct {
    const char *effect;
    bool forces, alone;
  } row[] = {{"thrust_scale", false, true}, {"thrust_curve", false, true}, {"battery_sag", false, true},
             {"thrust_scale", true, false}, {"inertia", false, false},     {"motor_damage", false, false},
             {"cg_offset", false, false},   {"delay", false, false}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    gap_rows_t g;
    ROW("%s, %s forces", row[i].effect, row[i].forces ? "with" : "without");
    gap_rows_make(&g, 3);
    g.grid.has_force = row[i].forces;
    CHECK(candidates_by_turning(fx_find(row[i].effect), &g.set) == row[i].alone);
    gap_rows_free(&g);
  }
}

// A map of a battery of three cells is of a voltage about 12 V, whatever it is now.
TEST(gap_the_voltage_of_a_map_is_looked_for_where_the_battery_s_cells_have_it) {
  static const struct {
    double vbat_V, cells;
  } rows[] = {{3.2, 1.0},  {4.35, 1.0}, {6.9, 2.0},  {8.4, 2.0},  {9.9, 3.0},
              {12.6, 3.0}, {14.0, 4.0}, {16.8, 4.0}, {21.6, 6.0}, {25.2, 6.0}};
  const fx_t *const fx = fx_find("battery_sag");
  for (unsigned i = 0; i < sizeof rows / sizeof *rows; i++) {
    ROW("%.2f V", rows[i].vbat_V);
    log_t log;
    candidates_t c;
    why_t why;
    grid_point_t point = {.vbat_V = rows[i].vbat_V};
    double least = HUGE_VAL, most = 0.0;
    log_make(&log);
    log.grid.point = &point;
    log.grid.n = 1;
    CHECK_OK(candidates_make(&c, &log.model, &log.set, &why));
    for (int k = 0; k < c.n; k++) {
      if (c.candidate[k].use.fx != fx) continue;
      least = fmin(least, c.candidate[k].use.p[fx->shape_param]);
      most = fmax(most, c.candidate[k].use.p[fx->shape_param]);
    }
    CHECK_NEAR(least, 3.7 * rows[i].cells, 1e-9);
    CHECK_NEAR(most, 4.2 * rows[i].cells, 1e-9);
    candidates_free(&c);
  }
}

TEST(what_is_barred_is_barred_in_every_kind_but_not_another_rotor) {
  static const char *const row[] = {"thrust_slope", "ceiling", "accel_bias", "motor_damage"};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i]);
    log_t l;
    candidates_t c;
    why_t why;
    log_make(&l);
    CHECK_OK(candidates_make(&c, &l.model, &l.set, &why));
    int first = 0, barred = 0;
    while (strcmp(c.candidate[first].use.fx->name, row[i]) != 0) first++;
    candidates_bar(&c, first);
    for (int k = 0; k < c.n; k++) barred += c.candidate[k].barred;
    CHECK(barred == (i == 3 ? 1 : candidates_of(&c, first)) && c.candidate[first].barred);
    candidates_free(&c);
  }
}
