// test_supervised.c - the supervisor's states over time.
#include "crazyflie/supervised.h"
#include "rig/test.h"

typedef struct {
  supervised_t s;
  supervised_in_t in;
} ground_t;

// On the floor, armed by itself.
static ground_t ready(void) {
  ground_t g = {.in = {.now_ms = 40, .acc_g = {0.0f, 0.0f, 1.0f}}};
  for (int i = 0; i < 4; i++) {
    g.in.setpoint_ms = g.in.now_ms;
    (void)supervised_update(&g.s, &supervised_default, &g.in);
    g.in.now_ms += SUPERVISED_PERIOD_MS;
  }
  return g;
}

// So long with set points that are fresh, or no more.
static void pass(ground_t *g, uint32_t ms, bool fresh) {
  for (uint32_t t = 0; t < ms; t += SUPERVISED_PERIOD_MS) {
    if (fresh) g->in.setpoint_ms = g->in.now_ms;
    (void)supervised_update(&g->s, &supervised_default, &g->in);
    g->in.now_ms += SUPERVISED_PERIOD_MS;
  }
}

static ground_t flying(void) {
  ground_t g = ready();
  g.in.motors = true;
  pass(&g, 80, true);
  return g;
}

TEST(supervisor_arms_itself_in_four_steps) {
  static const supervised_state_t want[] = {SUPERVISED_NOT_PASSED, SUPERVISED_PASSED, SUPERVISED_ARMING,
                                            SUPERVISED_READY, SUPERVISED_READY};
  supervised_t s = {.armed = false};
  supervised_in_t in = {.now_ms = 40, .acc_g = {0.0f, 0.0f, 1.0f}};
  for (unsigned i = 0; i < sizeof want / sizeof *want; i++) {
    ROW("step %u", i);
    CHECK(supervised_update(&s, &supervised_default, &in) == (i < 4));
    CHECK(s.state == want[i]);
    CHECK(supervised_motors_run(&s) == (i >= 2));
    in.now_ms += SUPERVISED_PERIOD_MS;
  }
  CHECK(supervised_can_fly(&s) && !supervised_flies(&s));
  CHECK(supervised_info(&s) == (2 | 4 | 8));
}

TEST(supervisor_goes_where_the_firmware_s_goes) {
  static const struct {
    const char *what;
    float acc_z_g;
    bool motors, fresh, stop, starved;
    uint32_t ms;
    supervised_state_t want;
  } row[] = {
      {"flies on", 1.0f, true, true, false, false, 5000, SUPERVISED_FLYING},
      {"set points 0.4 s old", 1.0f, true, false, false, false, 440, SUPERVISED_FLYING},
      {"set points 0.6 s old", 1.0f, true, false, false, false, 640, SUPERVISED_LEVEL_OUT},
      {"set points 2.2 s old", 1.0f, true, false, false, false, 2240, SUPERVISED_LOCKED},
      {"motors off for 1.8 s", 1.0f, false, true, false, false, 1800, SUPERVISED_FLYING},
      {"motors off for 2.2 s", 1.0f, false, true, false, false, 2200, SUPERVISED_LANDED},
      {"on the ground for 4 s", 1.0f, false, true, false, false, 2000 + 3400, SUPERVISED_READY},
      {"tilted for 0.8 s", 0.3f, true, true, false, false, 800, SUPERVISED_FLYING},
      {"tilted for 1.2 s", 0.3f, true, true, false, false, 1200, SUPERVISED_CRASHED},
      {"upside down for 0.2 s", -0.9f, true, true, false, false, 200, SUPERVISED_CRASHED},
      {"in free fall", 0.05f, true, true, false, false, 5000, SUPERVISED_FLYING},
      {"emergency stop", 1.0f, true, true, true, false, 120, SUPERVISED_LOCKED},
      {"the watchdog starves", 1.0f, true, true, false, true, 1200, SUPERVISED_LOCKED},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    ground_t g = flying();
    CHECK(supervised_flies(&g.s));
    g.in.acc_g[2] = row[i].acc_z_g;
    g.in.motors = row[i].motors;
    g.in.stop = row[i].stop;
    g.in.fed_ms = row[i].starved ? g.in.now_ms : 0;
    pass(&g, row[i].ms, row[i].fresh);
    CHECK_TEXT(supervised_words(g.s.state), supervised_words(row[i].want));
    CHECK(supervised_motors_run(&g.s) ==
          (row[i].want != SUPERVISED_LOCKED && row[i].want != SUPERVISED_CRASHED));
  }
}

TEST(supervisor_recovers_from_a_crash_only_upright) {
  ground_t g = flying();
  g.in.acc_g[2] = -1.0f;
  pass(&g, 400, true);
  CHECK(g.s.state == SUPERVISED_CRASHED && (supervised_info(&g.s) & 0xa0) == 0xa0);
  CHECK(!supervised_recover(&g.s));
  g.in.acc_g[2] = 1.0f;
  g.in.motors = false;
  pass(&g, 80, true);
  CHECK(supervised_recover(&g.s));
  pass(&g, 4000, true);
  CHECK(supervised_can_fly(&g.s));
}

TEST(supervisor_disarms_who_waits_too_long_and_arms_anew) {
  ground_t g = ready();
  pass(&g, 29000, true);
  CHECK(g.s.state == SUPERVISED_READY);
  const uint32_t armed_ms = g.s.armed_ms;
  pass(&g, 2000, true);
  CHECK(g.s.armed_ms > armed_ms);
}

TEST(supervisor_is_armed_by_a_client_only_after_its_checks) {
  supervised_t s = {.state = SUPERVISED_CRASHED};
  CHECK(!supervised_arm(&s, true) && !s.armed);
  s.state = SUPERVISED_PASSED;
  CHECK(supervised_arm(&s, true) && s.armed);
  CHECK(supervised_arm(&s, false) && !s.armed);
}
