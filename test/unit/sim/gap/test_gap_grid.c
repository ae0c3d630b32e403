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
