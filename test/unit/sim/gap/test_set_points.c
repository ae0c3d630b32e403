// test_set_points.c - what the controller was told: which of it the vehicle follows, and the track that it
// makes.
#include "gap/2_predict/grid.h"
#include "logs/log_rows.h"
#include "rig/scratch.h"
#include "rig/test.h"

#include <math.h>
#include <stdlib.h>

#define POINTS 100

static double wave(int j) {
  return 0.4 * sin(0.1 * j);
}

// A flight along x to and fro, told by place, or by speed, on x alone.
static grid_t flown(grid_point_t point[POINTS], bool by_speed, double place_m) {
  for (int j = 0; j < POINTS; j++)
    point[j] = (grid_point_t){.ok = true,
                              .q_wb = {.w = 1.0},
                              .vbat_V = 4.0 - 0.001 * j + (j % 2 ? 0.05 : -0.05),
                              .pos_w_m = {wave(j), 0.2, 0.5},
                              .set_w_m = {by_speed ? place_m : place_m + wave(j), (double)NAN, (double)NAN},
                              .set_w_mps = {by_speed ? 4.0 * cos(0.1 * j) : 0.0, (double)NAN, (double)NAN},
                              .set_yaw_rad = (double)NAN};
  return (grid_t){.n = POINTS, .point = point, .period_s = 0.01, .has_position = true};
}

TEST(set_points_that_the_vehicle_does_not_follow_are_left_out) {
  static const struct {
    const char *what;
    bool by_speed;
    double place_m;
    bool place;
  } row[] = {{"told by place", false, 0.0, true},
             {"told by speed, with a place left over", true, 0.0, false},
             {"a place that is far away", false, 3.0, false}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    grid_point_t point[POINTS];
    ROW("%s", row[i].what);
    grid_t g = flown(point, row[i].by_speed, row[i].place_m);
    CHECK(set_points_there(&g));
    set_points_judge(&g);
    CHECK(isfinite(point[7].set_w_m.x) == row[i].place);
    CHECK(isfinite(point[7].set_w_mps.x));
  }
}

TEST(set_points_make_a_track_of_nothing_that_was_measured) {
  grid_point_t point[POINTS];
  why_t why;
  for (int by_speed = 0; by_speed < 2; by_speed++) {
    grid_t track, g = flown(point, by_speed, 0.0);
    ROW("%s", by_speed ? "by speed" : "by place");
    set_points_judge(&g);
    for (int j = 0; j < POINTS; j++) point[j].pos_w_m.x += 0.01; // measured
    CHECK_OK(set_points_track(&g, &track, &why));
    // The way that 4 cos(0.1 j) m/s leads in steps of 10 ms.
    CHECK_NEAR(track.point[50].pos_w_m.x - track.point[20].pos_w_m.x, wave(50) - wave(20), 0.03);
    CHECK_NEAR(track.point[50].pos_w_m.y, 0.2, 1e-12);
    CHECK_NEAR(track.point[50].seen_w_m.x, track.point[50].pos_w_m.x, 0.0); // what a pilot follows
    CHECK_NEAR(track.point[50].vbat_V, 3.95, 0.002);
    CHECK_NEAR(track.point[50].q_wb.w, 1.0, 1e-12);
    free(track.point);
  }
}

TEST(set_points_are_none_where_the_log_has_none) {
  grid_point_t point[POINTS];
  const grid_t g = flown(point, false, 0.0);
  for (int j = 0; j < POINTS; j++) point[j].set_w_m.x = point[j].set_w_mps.x = (double)NAN;
  CHECK(!set_points_there(&g));
}

TEST(set_points_are_columns_of_a_crazyflie_s_log) {
  const columns_t c = columns_crazyflie();
  log_rows_t rows;
  log_row_t row;
  why_t why = {""};
  bool more;
  CHECK_OK(log_rows_open(
      &rows,
      scratch_file("told.csv", "timestamp,ctrltarget.z,ctrltarget.vx,ctrltarget.yaw\n10,0.4,-1,90\n", -1), &c,
      &(model_t){.mass_kg = 0.03}, LOG_MEND, 0, &why));
  CHECK_OK(log_rows_next(&rows, &row, &more, &why));
  CHECK_NEAR(row.v[SIG_SET_Z], 0.4, 1e-12);
  CHECK_NEAR(row.v[SIG_SET_VX], -1.0, 1e-12);
  CHECK(isnan(row.v[SIG_SET_YAW])); // the firmware's is a rate
  CHECK(isnan(row.v[SIG_SET_X]));
  log_rows_close(&rows);
}
