// test_segments.c - what a flight was like, of records that are made up.
#include "flight/segments.h"
#include "rig/test.h"

#define N 2001

// 20 s, two set points, 1 m and from 10 s on 2 m; there at once. 0.5 m of room above.
static void make(sample_t sample[N], plan_t *plan) {
  *plan = (plan_t){.way = {{0.0, 1.0}, {10.0, 2.0}}, .n_way = 2, .end_s = 20.0};
  for (int i = 0; i < N; i++)
    sample[i] = (sample_t){
        .t_s = 0.01 * i, .z_m = i < 1000 ? 1.0 : 2.0, .gap_m = 0.5, .gap_min_m = 0.5, .contacts = 0};
}

TEST(segments_judge_the_hover_over_the_last_five_seconds) {
  static const struct {
    const char *what;
    double from_s, to_s;           // of the first segment, where the height is 10 mm too much
    double mean_mm, rms_mm, sd_mm; // share 0.5: rms is sqrt(0.5) of 10, sd 5
  } row[] = {
      {"before", 0.0, 5.005, 0.0, 0.0, 0.0},
      {"all", 5.005, 10.005, 10.0, 10.0, 0.0},
      {"the older half", 5.005, 7.505, 5.0, 7.0710678, 5.0},
      {"the newer half", 7.505, 10.005, 5.0, 7.0710678, 5.0},
  };
  sample_t sample[N];
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    plan_t plan;
    segment_t segment[WAYPOINTS_MAX];
    make(sample, &plan);
    sample[1000].z_m = 1.0; // belongs to both
    for (int k = 0; k <= 1000; k++)
      if (sample[k].t_s > row[i].from_s && sample[k].t_s < row[i].to_s) sample[k].z_m += 0.01;
    const record_t record = {.sample = sample, .n = N, .room = N};
    if (!CHECK(segments_of(&record, &plan, segment) == 2)) continue;
    CHECK_NEAR(segment[0].mean_error_mm, row[i].mean_mm, 1e-6);
    CHECK_NEAR(segment[0].rms_mm, row[i].rms_mm, 1e-6);
    CHECK_NEAR(segment[0].sd_mm, row[i].sd_mm, 1e-5); // the root of a rounding
  }
}

TEST(segments_count_a_contact_that_lasts_in_each) {
  static const struct {
    const char *what;
    int touch_at, leave_at, again_at; // samples; N: never
    int want[2];
  } row[] = {
      {"never", N, N, N, {0, 0}},
      {"in the first", 500, 600, N, {1, 0}},
      {"in the second", 1500, N, N, {0, 1}},
      {"through both", 500, N, N, {1, 1}},
      {"from the start", 0, 100, N, {1, 0}},
      {"from the start to the end", 0, N, N, {1, 1}},
      {"through both, and again", 500, 1200, 1500, {1, 2}},
  };
  sample_t sample[N];
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    plan_t plan;
    segment_t segment[WAYPOINTS_MAX];
    make(sample, &plan);
    for (int k = 0; k < N; k++) {
      const bool at = (k >= row[i].touch_at && k < row[i].leave_at) || k >= row[i].again_at;
      // The gap is the rotors'; the body's top is above them.
      sample[k].touching = at;
      sample[k].gap_m = sample[k].gap_min_m = at ? 0.006 : 0.5;
      // What begins at the ceiling has not come there.
      sample[k].contacts = (row[i].touch_at > 0 && k >= row[i].touch_at) + (k >= row[i].again_at);
    }
    const record_t record = {.sample = sample, .n = N, .room = N};
    if (!CHECK(segments_of(&record, &plan, segment) == 2)) continue;
    for (int s = 0; s < 2; s++) CHECK_NEAR(segment[s].contacts, row[i].want[s], 0);
  }
}
