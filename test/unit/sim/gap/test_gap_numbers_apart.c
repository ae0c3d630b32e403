// test_gap_numbers_apart.c - an effect of which some numbers are a candidate of their own.
#include "gap/4_candidates/candidates.h"
#include "rig/test.h"
#include "vehicle/model_file.h"

#include <stddef.h>

static fx_use_t wind(double fx_N, double fz_N, double plane) {
  fx_use_t use = fx_use(fx_find("wind"));
  fx_use_resize(&use, 0, fx_N);
  fx_use_resize(&use, 2, fz_N);
  use.p[8] = plane;
  return use;
}

// A force upwards has no kind; that of the force along the floor stays, whichever is found first.
TEST(gap_numbers_apart_leave_the_kind_of_the_others) {
  static const struct {
    const char *what;
    double first[3], then[3];
    double plane;
  } row[] = {{"upwards last", {0.01, 0.0, 1.0}, {0.0, -0.02, 0.0}, 1.0},
             {"upwards first", {0.0, -0.02, 0.0}, {0.01, 0.0, 1.0}, 1.0},
             {"in the world", {0.0, -0.02, 0.0}, {0.01, 0.0, 0.0}, 0.0}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    model_t m;
    why_t why;
    ROW("%s", row[i].what);
    if (!CHECK_OK(model_builtin("cf21_legacy", &m, &why))) return;
    m.n_fx = 0;
    const fx_use_t first = wind(row[i].first[0], row[i].first[1], row[i].first[2]);
    const fx_use_t then = wind(row[i].then[0], row[i].then[1], row[i].then[2]);
    CHECK_OK(model_add_fx(&m, &first, &why));
    const fx_use_t whole = effect_whole(&m, &then);
    CHECK(whole.p[0] == 0.01 && whole.p[2] == -0.02 && whole.p[8] == row[i].plane);
  }
}
