// test_gap_check_moves.c - where a range or set point in another unit is told from one that goes its own
// ways: a row on either side of each number of check_moves.c.
#include "gap/1_read/read.h"
#include "rig/flight_csv.h"
#include "rig/test.h"
#include "vehicle/model_file.h"

#include <math.h>

#define MOST 40

// Steps up and down by rise_m, a sample each; the range below, or the set point, goes so many times as far,
// and by itself besides, by such a share of it: two up, two down, so that the two have nothing in common.
typedef struct {
  const char *what;
  int samples;
  double apart_s, rise_m, times, own;
  bool refused, set_point;
} case_t;

static done_t look(const case_t *c, const log_rows_t *rows, why_t *why) {
  static double t_s[MOST], z_m[MOST], moved_m[MOST];
  static int segment[MOST];
  gap_flight_t f = {.n = c->samples, .t_s = t_s, .segment = segment};
  f.v[SIG_Z] = z_m;
  f.v[c->set_point ? SIG_SET_Z : SIG_RANGE_DOWN] = moved_m;
  for (int i = 0; i < c->samples; i++) {
    static const double own[] = {0.0, 1.0, 2.0, 1.0};
    t_s[i] = c->apart_s * i;
    z_m[i] = i % 2 ? c->rise_m : 0.0;
    moved_m[i] = c->times * (z_m[i] + c->own * c->rise_m * own[i % 4]);
  }
  return gap_check_moves(&f, rows, why);
}

TEST(gap_a_range_or_set_point_in_another_unit_is_told_from_one_that_goes_its_own_ways) {
  static const case_t cases[] = {
      {"ten movements", 11, 0.5, 0.2, 0.1, 0.0, true, false},
      {"nine", 10, 0.5, 0.2, 0.1, 0.0, false, false},
      {"of 52 mm", 33, 0.5, 0.052, 0.1, 0.0, true, false},
      {"of 48 mm", 33, 0.5, 0.048, 0.1, 0.0, false, false},
      {"half a second apart", 33, 0.5, 0.2, 0.1, 0.0, true, false},
      {"less: there and back again in between", 33, 0.45, 0.2, 0.1, 0.0, false, false},
      {"83 % of the squares go together", 33, 0.5, 0.2, 0.1, 0.45, true, false},
      {"78 %", 33, 0.5, 0.2, 0.1, 0.53, false, false},
      {"a fifth more than a centimetre for a decimetre", 33, 0.5, 0.2, 0.12, 0.0, true, false},
      {"a third more", 33, 0.5, 0.2, 0.13, 0.0, false, false},
      {"a sixth less", 33, 0.5, 0.2, 0.085, 0.0, true, false},
      {"a quarter less", 33, 0.5, 0.2, 0.075, 0.0, false, false},
      {"0.32 times as far, as no unit does", 33, 0.5, 0.2, 0.32, 0.0, false, false},
      {"a set point in centimetres, of a place that moves by 52 mm rms", 33, 0.1, 0.104, 100.0, 0.0, true,
       true},
      {"by 48 mm", 33, 0.1, 0.096, 100.0, 0.0, false, true},
  };
  const char *const path = flight_csv_file(&(flight_csv_t){.dt_ms = 10.0, .rows = 100}, "moves.csv");
  const columns_t columns = flight_csv_columns();
  log_rows_t rows;
  model_t vehicle;
  why_t why;
  CHECK_OK(model_builtin("cf21_legacy", &vehicle, &why));
  CHECK_OK(log_rows_open(&rows, path, &columns, &vehicle, LOG_MEND, 0, &why));
  for (unsigned i = 0; i < sizeof cases / sizeof *cases; i++) {
    ROW("%s", cases[i].what);
    CHECK_STATUS(cases[i].refused ? BAD_INPUT : DONE, look(&cases[i], &rows, &why));
  }
  log_rows_close(&rows);
}
