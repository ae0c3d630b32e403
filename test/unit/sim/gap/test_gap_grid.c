// test_gap_grid.c - points of a grid: every signal of a point is of one and the same instant.
#include "body/body.h"
#include "gap/2_predict/grid.h"
#include "rig/test.h"
#include "vehicle/model_file.h"

#include <math.h>
#include <stdlib.h>

#define MOST       1000
#define TURN_RADPS 2.0

// Turns about z and climbs; a quaternion and its opposite take turns, as some estimators have it.
static void fly(gap_flight_t *f, double rate_Hz, double v[SIG_COUNT][MOST], double t_s[MOST]) {
  static const signal_id_t has[] = {SIG_X,  SIG_Y,  SIG_Z,  SIG_VX, SIG_VY, SIG_VZ, SIG_QW,
                                    SIG_QX, SIG_QY, SIG_QZ, SIG_F1, SIG_F2, SIG_F3, SIG_F4};
  *f = (gap_flight_t){.n = (int)(2.0 * rate_Hz), .rate_Hz = rate_Hz, .t_s = t_s};
  for (unsigned i = 0; i < sizeof has / sizeof *has; i++) f->v[has[i]] = v[has[i]];
  for (int i = 0; i < f->n; i++) {
    const double t = t_s[i] = i / rate_Hz, way = i % 3 == 1 ? -1.0 : 1.0;
    v[SIG_Z][i] = 0.5 + 0.1 * t;
    v[SIG_VZ][i] = 0.1;
    v[SIG_QW][i] = way * cos(0.5 * TURN_RADPS * t);
    v[SIG_QZ][i] = way * sin(0.5 * TURN_RADPS * t);
    for (int k = 0; k < ROTORS; k++) v[SIG_F1 + k][i] = 0.08;
  }
}

TEST(gap_points_have_attitude_and_place_of_one_instant_at_every_rate) {
  static const double rate_Hz[] = {50.0, 96.0, 100.0, 125.0, 160.0, 240.0, 500.0};
  static double v[SIG_COUNT][MOST], t_s[MOST];
  model_t vehicle;
  why_t why;
  CHECK_OK(model_builtin("cf21_legacy", &vehicle, &why));
  for (unsigned i = 0; i < sizeof rate_Hz / sizeof *rate_Hz; i++) {
    ROW("%g Hz", rate_Hz[i]);
    gap_flight_t flight;
    grid_t g;
    fly(&flight, rate_Hz[i], v, t_s);
    CHECK_OK(grid_make(&g, &flight, 0, flight.n, &vehicle, &why));
    CHECK(g.n > 50);
    for (int j = 0; j < g.n; j++) {
      const grid_point_t *const p = &g.point[j];
      const axes_t axes = axes_of(p->q_wb);
      CHECK_NEAR(remainder(atan2(axes.x.y, axes.x.x) - TURN_RADPS * p->t_s, 6.283185307179586), 0.0, 1e-9);
      CHECK_NEAR(p->pos_w_m.z - body_rest_z_m(&vehicle), 0.5 + 0.1 * p->t_s, 1e-9);
    }
    grid_free(&g);
  }
}

// Hovers at half a metre; from 1 to 1.03 s something pushes it, or turns it about x.
typedef struct {
  double rate_Hz, clear_m; // of any part of it from a ceiling; below 0: from the floor
  double push_g, turn_radps2;
  double off_m; // its centre of mass lies so far aside: rotors hold it that give more on one side
  bool plus;    // its rotors lie on its axes
} pushed_t;

static void hover(gap_flight_t *f, const pushed_t *how, const model_t *m, double v[SIG_COUNT][MOST],
                  double t_s[MOST]) {
  static const signal_id_t more[] = {SIG_AX, SIG_AY, SIG_AZ, SIG_GX, SIG_GY, SIG_GZ};
  const double weight_N = m->mass_kg * G_MPS2;
  double rate_radps = 0.0;
  fly(f, how->rate_Hz, v, t_s);
  for (unsigned i = 0; i < sizeof more / sizeof *more; i++) f->v[more[i]] = v[more[i]];
  for (int i = 0; i < f->n; i++) {
    const bool pushed = t_s[i] > 0.9999 && t_s[i] < 1.0301;
    if (pushed) rate_radps += how->turn_radps2 / how->rate_Hz;
    v[SIG_Z][i] = how->clear_m < 0.0 ? -how->clear_m : 0.5;
    v[SIG_VZ][i] = 0.0, v[SIG_QW][i] = 1.0, v[SIG_QZ][i] = 0.0;
    v[SIG_AX][i] = v[SIG_AY][i] = v[SIG_GY][i] = v[SIG_GZ][i] = 0.0;
    v[SIG_AZ][i] = (1.0 + (pushed ? how->push_g : 0.0)) * G_MPS2;
    v[SIG_GX][i] = rate_radps;
    for (int k = 0; k < ROTORS; k++) {
      const double y_m = m->frame.rotor_y_m[k];
      v[SIG_F1 + k][i] = 0.25 * weight_N * (1.0 + (y_m != 0.0 ? how->off_m / y_m : 0.0));
    }
  }
}

static void turn_to_plus(frame_t *f) {
  static const double x[ROTORS] = {0.04, 0.0, -0.04, 0.0}, y[ROTORS] = {0.0, -0.04, 0.0, 0.04};
  for (int k = 0; k < ROTORS; k++) f->rotor_x_m[k] = x[k], f->rotor_y_m[k] = y[k];
}

// Of its points so many are left out; told: at the ceiling, where it lies.
static int left_out(const pushed_t *how, int *told) {
  static double v[SIG_COUNT][MOST], t_s[MOST];
  model_t vehicle;
  why_t why;
  gap_flight_t flight;
  grid_t g;
  int out = 0;
  CHECK_OK(model_builtin("cf21_legacy", &vehicle, &why));
  if (how->plus) turn_to_plus(&vehicle.frame);
  hover(&flight, how, &vehicle, v, t_s);
  for (int again = 0; again < 2; again++) { // once to see how high it reaches
    if (!again) vehicle.ceiling_m = 0.7;
    CHECK_OK(grid_make(&g, &flight, 0, flight.n, &vehicle, &why));
    if (!again && how->clear_m > 0.0) vehicle.ceiling_m += how->clear_m - g.point[0].clear_m;
    for (int j = 0; again && j < g.n; j++) out += !g.point[j].ok;
    *told = g.bumps;
    CHECK(!g.bumps || fabs(g.bump_s - (how->clear_m < 0.01 ? 0.5 : 1.0)) < 0.03);
    grid_free(&g);
  }
  return out;
}

// Ground and ceiling effects give a third of the weight. An edge that touches turns it more than it lifts it;
// of rows that miss commands a turn says nothing. What turns it all the time is no bump.
TEST(gap_leaves_out_points_at_which_something_solid_pushes) {
  static const struct {
    const char *what;
    pushed_t how;
    bool left_out, told;
  } row[] = {
      {"a ceiling that pushes back", {500.0, 0.025, -0.7, 0.0, 0.0, false}, true, true},
      {"the same at 100 Hz", {100.0, 0.025, -0.7, 0.0, 0.0, false}, true, true},
      {"the same further off", {500.0, 0.035, -0.7, 0.0, 0.0, false}, false, false},
      {"a ceiling that pulls", {500.0, 0.02, 0.35, 0.0, 0.0, false}, false, false},
      {"a floor that it lands on", {500.0, -0.02, 0.7, 0.0, 0.0, false}, true, false},
      {"an edge that touches", {500.0, 0.025, -0.1, 100.0, 0.0, false}, true, true},
      {"the same further off", {500.0, 0.035, -0.1, 100.0, 0.0, false}, false, false},
      {"a gust that turns it", {500.0, 0.02, 0.0, 50.0, 0.0, false}, false, false},
      {"rows that miss commands", {100.0, 0.02, -0.1, 100.0, 0.0, false}, false, false},
      {"a centre of mass aside", {500.0, 0.02, 0.0, 0.0, 0.006, false}, false, false},
      {"rotors on its axes", {500.0, 0.02, 0.0, 30.0, 0.0, true}, false, false},
      {"rotors on its axes, and an edge", {500.0, 0.02, -0.1, 150.0, 0.0, true}, true, true},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s, %g Hz", row[i].what, row[i].how.rate_Hz);
    int told;
    const int out = left_out(&row[i].how, &told);
    CHECK(row[i].left_out ? out >= 1 && out <= 4 : out == 0);
    CHECK(told == (row[i].told ? out : 0));
  }
}

// Points of a flight from one on, how clear of floor or ceiling they are, and whether they are left out.
typedef struct {
  int from;
  double clear_m; // NaN: its place is not known
  bool left_out;
} clear_row_t;

static void check_left_out(const clear_row_t *row, int n, bool floor, double *bump_s) {
  static double v[SIG_COUNT][MOST], t_s[MOST];
  model_t vehicle;
  why_t why;
  gap_flight_t flight;
  grid_t g;
  CHECK_OK(model_builtin("cf21_legacy", &vehicle, &why));
  hover(&flight, &(pushed_t){50.0, floor ? -0.5 : 1.0, 0.0, 0.0, 0.0, false}, &vehicle, v, t_s);
  vehicle.ceiling_m = floor ? 2.0 : 0.7;
  CHECK_OK(grid_make(&g, &flight, 0, flight.n, &vehicle, &why));
  const double way = floor ? 1.0 : -1.0, end_m = v[SIG_Z][0] - way * g.point[0].clear_m;
  grid_free(&g);
  for (int i = 0; i < n; i++)
    for (int j = row[i].from; j < flight.n; j++)
      v[SIG_Z][j] = isfinite(row[i].clear_m) ? end_m + way * row[i].clear_m : (double)NAN;
  CHECK_OK(grid_make(&g, &flight, 0, flight.n, &vehicle, &why));
  for (int i = 0; i < n; i++)
    for (int j = row[i].from; j < (i + 1 < n ? row[i + 1].from : flight.n); j++) {
      if (j == 55) continue; // half a second later
      ROW("point %d, %g m", j, row[i].clear_m);
      CHECK(isfinite(row[i].clear_m) ? fabs(g.point[j].clear_m - row[i].clear_m) < 1e-9
                                     : isnan(g.point[j].clear_m));
      CHECK(g.point[j].ok == !row[i].left_out);
    }
  *bump_s = g.bumps ? g.bump_s - g.point[0].t_s : -1.0;
  grid_free(&g);
}

// It rests there, and its place errs: in one go it touches at every point, but not for ever.
TEST(gap_leaves_out_a_rest_at_a_ceiling_whole) {
  static const clear_row_t row[] = {{0, 0.030, false},  {20, 0.012, false}, {21, 0.008, true},
                                    {22, 0.001, true},  {23, 0.006, true},  {24, 0.009, true},
                                    {25, 0.011, false}, {26, 0.006, true},  {30, 0.001, true},
                                    {31, 0.006, true},  {56, 0.006, false}, {98, 0.030, false}};
  double bump_s;
  check_left_out(row, sizeof row / sizeof *row, false, &bump_s);
  CHECK_NEAR(bump_s, 0.42, 1e-9);
}

// In between it flies low over the ground, and may touch it.
TEST(gap_leaves_out_a_landing_whole_and_of_a_low_flight_what_touches) {
  static const clear_row_t row[] = {{0, (double)NAN, true}, {1, 0.004, true},  {3, 0.008, true},
                                    {4, (double)NAN, true}, {5, 0.008, true},  {6, 0.02, false},
                                    {30, 0.008, false},     {33, 0.004, true}, {34, 0.008, false},
                                    {50, 0.02, false},      {95, 0.008, true}, {98, 0.004, true}};
  double bump_s;
  check_left_out(row, sizeof row / sizeof *row, true, &bump_s);
  CHECK_NEAR(bump_s, -1.0, 0.0);
}

// What pushes says so, where its place says that it is clear by 8 mm.
TEST(gap_leaves_out_what_lies_beside_a_push) {
  const pushed_t how = {50.0, 0.008, -0.7, 0.0, 0.0, false};
  int told;
  const int out = left_out(&how, &told);
  ROW("%d points", out);
  CHECK(out >= 50 && out <= 52 && told == out);
}
