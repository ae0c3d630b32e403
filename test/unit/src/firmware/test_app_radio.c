// test_app_radio.c - the radio falls silent: down, before the firmware's watchdog stops the motors.
#include "crazyflie/stand_in.h"
#include "firmware/glue.h"
#include "firmware/radio.h"
#include "rig/test.h"

#define WATCHDOG_MS 1000 // the firmware's
#define EACH_MS     100

typedef struct {
  const char *what;
  uint32_t fed_until_ms; // from 1 s on, every 200 ms; 0: never
  uint32_t fed_again_ms; // once; 0: not
  bool flies, hands_over, refused;
  int landings;
  uint32_t cut_ms; // when the watchdog stops the motors; 0: not within 20 s
} silence_t;

static const silence_t row[] = {
    {"fed all the time", 20000, 0, true, false, false, 0, 0},
    // Asked half a second after the last time, and fed for 8 s.
    {"silent from 5 s on", 5000, 0, true, false, false, 1, 5500 + RADIO_DOWN_MS - EACH_MS + WATCHDOG_MS},
    {"silent for 0.4 s", 5000, 5400, true, false, false, 1, 5900 + RADIO_DOWN_MS - EACH_MS + WATCHDOG_MS},
    {"silent, heard while it descends, silent for good", 5000, 6550, true, false, false, 2,
     7100 + RADIO_DOWN_MS - EACH_MS + WATCHDOG_MS},
    {"never fed", 0, 0, true, false, false, 0, 0},
    {"on the floor", 5000, 0, false, false, false, 0, 6000},
    {"the guard hands over", 5000, 0, true, true, false, 0, 6000},
    {"the high-level commander refuses", 5000, 0, true, false, true, 5, 6000},
};

static uint32_t cut_at(const silence_t *s, stand_in_t *around) {
  for (uint32_t ms = 1000; ms <= 20000; ms += 50) {
    around->clock_ms = ms;
    if (ms <= s->fed_until_ms && ms % 200 == 0) around->fed_ms = ms;
    if (s->fed_again_ms > 0 && ms == s->fed_again_ms) around->fed_ms = ms;
    if (around->fed_ms > 0 && ms >= around->fed_ms + WATCHDOG_MS) return ms;
    if (ms % EACH_MS == 0) radio_watch();
  }
  return 0;
}

TEST(radio_silence_lands_before_the_watchdog_stops_the_motors) {
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    glue_static.radio = (radio_t){.descends = false};
    glue_static.flight.guard.action = row[i].hands_over ? GUARD_HAND_OVER : GUARD_FLY;
    stand_in_t around = {.app = &glue_static, .flying = row[i].flies, .no_landing = row[i].refused};
    stand_in = &around;
    CHECK_NEAR(cut_at(&row[i], &around), row[i].cut_ms, 0.0);
    CHECK_NEAR(around.landings, row[i].landings, 0.0);
    CHECK_NEAR(around.relaxed, row[i].landings, 0.0);
    if (row[i].landings == 0) continue;
    // To the floor that the estimator's zero is, and from 3 m in less time than it is fed.
    CHECK(around.landing_m == 0.0f && 3.0f / around.landing_mps < 0.001f * RADIO_DOWN_MS);
  }
  glue_static.flight.guard.action = GUARD_FLY;
}

// A tick counter that runs over after 50 days is another number, not another order.
TEST(radio_silence_is_heard_when_the_clock_runs_over) {
  glue_static.radio = (radio_t){.descends = false};
  stand_in_t around = {.app = &glue_static, .flying = true, .fed_ms = UINT32_MAX - 200};
  stand_in = &around;
  around.clock_ms = 200;
  radio_watch();
  CHECK(around.landings == 0);
  around.clock_ms = 400;
  radio_watch();
  CHECK(around.landings == 1 && around.fed_ms == 400);
}

TEST(radio_silence_is_the_laptops_alone) {
  // Put down, and flown again with nobody there since: what fed the watchdog last was the app itself.
  glue_static.radio = (radio_t){.descends = false};
  stand_in_t around = {.app = &glue_static, .flying = true, .fed_ms = 1000, .clock_ms = 1600};
  stand_in = &around;
  radio_watch();
  CHECK(around.landings == 1 && around.fed_ms == 1600);
  around.flying = false;
  radio_watch();
  around.flying = true;
  around.clock_ms = 2400;
  radio_watch();
  CHECK(around.landings == 1 && !glue_static.radio.descends);
}
