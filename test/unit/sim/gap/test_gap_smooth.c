// test_gap_smooth.c - places and velocities of a log, without what of their errors lasts for a moment.
#include "base/random.h"
#include "gap/2_predict/grid.h"
#include "rig/test.h"

#include <math.h>
#include <stdlib.h>

#define POINTS   3000 // a minute
#define PERIOD_S 0.02
#define TURN     2.0 // rad/s, on a circle of half a metre
#define RADIUS_M 0.5

// On the circle, level, and seen as it is.
static grid_point_t on_circle(double t_s) {
  const double a = TURN * t_s, v = TURN * RADIUS_M;
  const d3_t pos = d3(RADIUS_M * cos(a), RADIUS_M * sin(a), 1.0), vel = d3(-v * sin(a), v * cos(a), 0.0);
  return (grid_point_t){.t_s = t_s, .ok = true, .pos_w_m = pos, .vel_w_mps = vel, .seen_w_m = pos};
}

static grid_t circle(void) {
  grid_t g = {.period_s = PERIOD_S,
              .n = POINTS,
              .point = calloc(POINTS, sizeof(grid_point_t)),
              .has_position = true,
              .has_velocity = true};
  if (!g.point) abort();
  for (int j = 0; j < POINTS; j++) g.point[j] = on_circle(PERIOD_S * j);
  return g;
}

static void see_as_logged(grid_t *g) {
  for (int j = 0; j < g->n; j++) g->point[j].pos_w_m = g->point[j].seen_w_m;
}

static d3_t off_place(const grid_point_t *p) {
  return d3_sub(p->pos_w_m, on_circle(p->t_s).pos_w_m);
}
static double rms_m(const grid_t *g) {
  double sum = 0.0;
  for (int j = 0; j < g->n; j++) sum += pow(d3_norm(off_place(&g->point[j])), 2.0);
  return sqrt(sum / g->n / 3.0);
}

// As estimates err: together for tau_s.
static d3_t drifted(random_t *r, d3_t off, double sd, double tau_s) {
  const double keep = exp(-PERIOD_S / tau_s), fresh = sd * sqrt(1.0 - keep * keep);
  return d3_add(d3_scale(keep, off),
                d3_scale(fresh, d3(random_normal(r), random_normal(r), random_normal(r))));
}

TEST(gap_takes_errors_of_a_moment_out_of_places) {
  static const struct {
    double pos_m, vel_mps, tau_s, left_m; // sd as logged, and what may be left of it
  } row[] = {
      {0.008, 0.0, 0.03, 0.0033},  {0.008, 0.0, 0.06, 0.0045}, {0.0, 0.03, 0.03, 0.0022},
      {0.008, 0.03, 0.03, 0.0041}, {0.0, 0.0, 0.03, 2e-5},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%g m, %g m/s for %g s", row[i].pos_m, row[i].vel_mps, row[i].tau_s);
    why_t why;
    grid_t g = circle();
    random_t *const r = random_open(7 + i);
    if (!r) abort();
    d3_t place = {0.0, 0.0, 0.0}, speed = place;
    for (int j = 0; j < g.n; j++) {
      place = drifted(r, place, row[i].pos_m, row[i].tau_s);
      speed = drifted(r, speed, row[i].vel_mps, row[i].tau_s);
      g.point[j].seen_w_m = d3_add(g.point[j].seen_w_m, place);
      g.point[j].vel_w_mps = d3_add(g.point[j].vel_w_mps, speed);
    }
    see_as_logged(&g);
    if (row[i].pos_m > 0.0) CHECK(rms_m(&g) > 0.8 * row[i].pos_m);
    CHECK_OK(grid_smooth(&g, &why));
    CHECK(rms_m(&g) < row[i].left_m);
    random_close(r);
    free(g.point);
  }
}

// A velocity with a constant error moves the places before forwards as far as those after backwards.
TEST(gap_smooths_by_velocities_that_are_wrong_by_a_constant) {
  why_t why;
  grid_t g = circle();
  for (int j = 0; j < g.n; j++) g.point[j].vel_w_mps = d3_add(g.point[j].vel_w_mps, d3(0.3, 0.0, -0.2));
  see_as_logged(&g);
  CHECK_OK(grid_smooth(&g, &why));
  CHECK(rms_m(&g) < 1e-3);
  free(g.point);
}

// What is not good may be anything; after a gap in time the vehicle is elsewhere.
TEST(gap_smooths_nothing_over_a_gap) {
  why_t why;
  grid_t g = circle();
  for (int j = 0; j < g.n; j++) {
    g.point[j].segment = j >= 1000;
    g.point[j].ok = j < 2000 || j >= 2100;
    if (j >= 1000) g.point[j].seen_w_m.x += 5.0;
    if (!g.point[j].ok) g.point[j].seen_w_m.x = (double)NAN;
  }
  see_as_logged(&g);
  CHECK_OK(grid_smooth(&g, &why));
  CHECK(isnan(g.point[2050].pos_w_m.x));
  for (int j = 0; j < g.n; j++)
    if (g.point[j].ok)
      CHECK_NEAR(g.point[j].pos_w_m.x - on_circle(g.point[j].t_s).pos_w_m.x, j < 1000 ? 0.0 : 5.0, 1e-3);
  free(g.point);
}

// Of a velocity that was made of the places themselves there is nothing to learn.
TEST(gap_leaves_a_place_without_a_logged_velocity_as_it_is) {
  why_t why;
  grid_t g = circle();
  g.velocity_made = true;
  g.point[50].pos_w_m.x += 0.1;
  g.point[50].seen_w_m.x += 0.1;
  CHECK_OK(grid_smooth(&g, &why));
  CHECK(g.point[50].pos_w_m.x == g.point[50].seen_w_m.x);
  free(g.point);
}

// --- velocities -------------------------------------------------------------------------------------------

// On a circle, with what an accelerometer measures there, off by a constant.
typedef struct {
  double turn_radps, radius_m, bias_mps2;
} way_t;

static d3_t speed_mps(const way_t *w, double t_s) {
  const double a = w->turn_radps * t_s, v = w->turn_radps * w->radius_m;
  return d3(-v * sin(a), v * cos(a), 0.0);
}

static grid_t flown(const way_t *w, double sd_mps, double tau_s) {
  grid_t g = circle();
  g.has_force = g.has_attitude = true;
  random_t *const r = random_open(11);
  if (!r) abort();
  d3_t off = {0.0, 0.0, 0.0};
  for (int j = 0; j < g.n; j++) {
    grid_point_t *const p = &g.point[j];
    const double a = w->turn_radps * p->t_s, inwards = w->turn_radps * w->turn_radps * w->radius_m;
    off = drifted(r, off, sd_mps, tau_s);
    p->q_wb = (dq_t){1.0, 0.0, 0.0, 0.0};
    p->acc_b_mps2 = d3(w->bias_mps2 - inwards * cos(a), -inwards * sin(a), G_MPS2);
    p->vel_w_mps = p->seen_w_mps = d3_add(speed_mps(w, p->t_s), off);
  }
  random_close(r);
  return g;
}

static double rms_mps(const grid_t *g, const way_t *w) {
  double sum = 0.0;
  for (int j = 0; j < g->n; j++)
    sum += pow(d3_norm(d3_sub(g->point[j].vel_w_mps, speed_mps(w, g->point[j].t_s))), 2.0);
  return sqrt(sum / g->n / 3.0);
}

// What is slow may be smoothed more than what is swift, and what is known at once not at all.
TEST(gap_takes_as_much_of_a_moment_out_of_velocities_as_their_errors_ask_for) {
  static const struct {
    const char *what;
    way_t way;
    double sd_mps, tau_s, left_mps;
  } row[] = {
      {"a hover", {0.7, 0.03, 0.0}, 0.03, 0.03, 0.011},
      {"with an accelerometer that is off", {0.7, 0.03, 0.3}, 0.03, 0.03, 0.011},
      {"1.5 m/s", {4.0, 0.375, 0.0}, 0.03, 0.03, 0.0142},
      {"1.5 m/s, no errors", {4.0, 0.375, 0.0}, 0.0, 0.03, 5e-6},
      {"a hover, no errors", {0.7, 0.03, 0.0}, 0.0, 0.03, 1e-9},
      {"errors that stay", {0.7, 0.03, 0.0}, 0.03, 2.0, 0.026},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    why_t why;
    grid_t g = flown(&row[i].way, row[i].sd_mps, row[i].tau_s);
    if (row[i].tau_s < 1.0) CHECK(rms_mps(&g, &row[i].way) > 0.9 * row[i].sd_mps - 1e-9);
    CHECK_OK(grid_smooth(&g, &why));
    CHECK(rms_mps(&g, &row[i].way) < row[i].left_mps);
    CHECK(d3_norm(d3_sub(g.point[99].vel_w_mps, g.point[99].seen_w_mps)) > 0.0 || row[i].sd_mps <= 0.0);
    free(g.point);
  }
}

TEST(gap_smooths_no_velocity_of_a_flight_too_short_to_say_how_much) {
  static const struct {
    double s;
    bool smooth;
  } row[] = {{0.5, false}, {0.9, false}, {1.2, true}}; // a window, and two more for each of its weights
  const way_t way = {0.7, 0.03, 0.0};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%g s", row[i].s);
    why_t why;
    grid_t g = flown(&way, 0.03, 0.03);
    g.n = (int)(row[i].s / g.period_s);
    CHECK_OK(grid_smooth(&g, &why));
    CHECK((g.point[g.n / 2].vel_w_mps.x != g.point[g.n / 2].seen_w_mps.x) == row[i].smooth);
    free(g.point);
  }
}

TEST(gap_smooths_no_velocity_over_a_gap_nor_without_accelerations) {
  const way_t way = {0.7, 0.03, 0.0};
  for (int gap = 0; gap < 2; gap++) {
    ROW("%s", gap ? "a gap" : "no accelerations");
    why_t why;
    grid_t g = flown(&way, 0.03, 0.03);
    g.acceleration_made = !gap;
    for (int j = 1000; gap && j < g.n; j++) { // it goes on elsewhere, and swifter
      g.point[j].segment = 1;
      g.point[j].vel_w_mps.x += 5.0;
      g.point[j].seen_w_mps.x += 5.0;
    }
    CHECK_OK(grid_smooth(&g, &why));
    for (int j = 0; j < g.n; j++) {
      const double off = g.point[j].vel_w_mps.x - speed_mps(&way, g.point[j].t_s).x;
      if (gap) CHECK_NEAR(off, j < 1000 ? 0.0 : 5.0, 0.2);
      if (!gap) CHECK(g.point[j].vel_w_mps.x == g.point[j].seen_w_mps.x);
    }
    free(g.point);
  }
}
