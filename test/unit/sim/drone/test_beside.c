// test_beside.c - what the sideways range sensors see.
#include "drone/beside.h"

#include "base/constants.h"
#include "rig/test.h"
#include <math.h>

#define NONE BESIDE_NONE_MM

TEST(the_sideways_sensors_see_a_wall_and_a_hand) {
  static const struct {
    const char *what;
    double y_m, yaw_deg, roll_deg, wall_y_m;
    int hand;
    uint16_t front, back, left, right;
  } row[] = {
      {"no wall", 0, 0, 0, HUGE_VAL, 0, NONE, NONE, NONE, NONE},
      {"on the left", 0.5, 0, 0, 1.5, 0, NONE, NONE, 1000, NONE},
      {"on the right", 0.5, 0, 0, -1.0, 0, NONE, NONE, NONE, 1500},
      {"in front", 0, 90, 0, 2.0, 0, 2000, NONE, NONE, NONE},
      {"behind", 0, -90, 0, 2.0, 0, NONE, 2000, NONE, NONE},
      {"at a slant", 0, 60, 0, 1.0, 0, 1154, NONE, 2000, NONE},
      {"tilted", 0, 0, 60, 1.0, 0, NONE, NONE, 2000, NONE},
      {"too far", 0, 0, 0, 4.1, 0, NONE, NONE, NONE, NONE},
      {"a hand in front", 0, 0, 0, 1.0, 1, 100, NONE, 1000, NONE},
      {"a hand behind", 0, 0, 0, HUGE_VAL, 2, NONE, 100, NONE, NONE},
      {"a hand before the wall", 0, 0, 0, 1.0, 3, NONE, NONE, 100, NONE},
      {"a hand behind the wall", 0, 0, 0, 0.05, 3, NONE, NONE, 50, NONE},
      {"a hand on the right", 0, 0, 0, HUGE_VAL, 4, NONE, NONE, NONE, 100},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    uint16_t mm[BESIDE_N];
    const dq_t yaw = dq_turn(d3(0.0, 0.0, RAD_PER_DEG * row[i].yaw_deg));
    const dq_t roll = dq_turn(d3(RAD_PER_DEG * row[i].roll_deg, 0.0, 0.0));
    beside_look(d3(0.3, row[i].y_m, 1.0), dq_mul(yaw, roll), row[i].wall_y_m, row[i].hand, mm);
    CHECK_NEAR(mm[BESIDE_FRONT], row[i].front, 1);
    CHECK_NEAR(mm[BESIDE_BACK], row[i].back, 1);
    CHECK_NEAR(mm[BESIDE_LEFT], row[i].left, 1);
    CHECK_NEAR(mm[BESIDE_RIGHT], row[i].right, 1);
  }
}
