// test_points.c - a vehicle at instants, eight side by side: what is kept of them (gap/2_predict keeps many).
#include "base/lane.h"
#include "body/points.h"
#include "rig/test.h"

TEST(points_keep_whole_places_of_their_alignment_by_registers_of_any_width) {
  const int bits[] = {256, 512};
  CHECK(points_open(0) == NULL);
  for (int i = 0; i < 2 && bits[i] <= lane_bits(); i++) {
    ROW("%d bits", bits[i]);
    points_t *const p = points_open(bits[i]);
    if (!CHECK(p != NULL)) return;
    CHECK(points_kept_bytes(p) > 0 && points_kept_bytes(p) % POINTS_ALIGN == 0);
    points_close(p);
  }
}
