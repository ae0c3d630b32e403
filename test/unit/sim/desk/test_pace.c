// test_pace.c - the flight's clock beside that on the wall.
#include "desk/pace.h"
#include "rig/test.h"

TEST(pace_keeps_up_at_any_speed_and_drifts_nowhere) {
  static const double speed[] = {0.5, 1.0, 20.0};
  for (unsigned i = 0; i < sizeof speed / sizeof *speed; i++) {
    ROW("speed %g", speed[i]);
    double at_s = 1.0;
    pace_t p = pace_begin(speed[i], 1000.0, at_s);
    for (int ms = 0; ms <= 3600000; ms += 100) at_s = pace_until_s(&p, 1000.0 + 1e-3 * ms, at_s);
    CHECK_NEAR(at_s, 1.0 + speed[i] * 3600.0, 1e-6);
    CHECK_NEAR(p.behind_s, 0.1, 1e-6);
  }
}

TEST(pace_lets_go_of_the_time_that_a_machine_was_too_slow_for) {
  pace_t p = pace_begin(1.0, 0.0, 0.0);
  CHECK_NEAR(pace_until_s(&p, 0.1, 0.0), 0.1, 1e-12); // made up for
  CHECK_NEAR(p.behind_s, 0.1, 1e-12);
  CHECK_NEAR(pace_until_s(&p, 5.0, 0.0), PACE_BEHIND_S, 1e-12);
  CHECK_NEAR(p.behind_s, 5.0, 1e-12);
  CHECK_NEAR(pace_until_s(&p, 5.1, PACE_BEHIND_S), PACE_BEHIND_S + 0.1, 1e-12);
}
