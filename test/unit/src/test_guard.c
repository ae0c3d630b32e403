// test_guard.c - the guard's reasons, one at a time, on inputs made up for them; and flipped bits.
#include "flight/flight.h"
#include "rig/hovering.h"
#include "rig/test.h"

#include <stddef.h>
#include <string.h>

static void hover(guard_t *g, const hover_t *h, int ms) {
  flight_param_t p;
  params_default(&p);
  for (int i = 0; i < ms; i++) {
    guard_in_t in = hovering(h, i);
    guard_step(g, &p.guard, &in);
  }
}

TEST(guard_retreats_where_thrust_carries_too_much_for_the_distance) {
  static const struct {
    const char *what;
    float zc_m, ratio;
    bool retreats;
  } row[] = {{"far by the range, much", 0.30f, 1.20f, true},
             {"just beyond what the range explains", 0.12f, 1.18f, true},
             {"a tenth of the weight dropped", 0.30f, 1.11f, false},
             {"near by the range, much", 0.06f, 1.20f, false}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    guard_t g;
    guard_init(&g);
    hover_t h = {row[i].zc_m, row[i].zc_m, row[i].zc_m, 1.0f};
    hover(&g, &h, 3000);
    CHECK(g.latched == 0);
    h.ratio = row[i].ratio;
    hover(&g, &h, 400);
    CHECK(((g.latched & GUARD_RATIO) != 0) == row[i].retreats);
    CHECK((g.action == GUARD_RETREAT) == row[i].retreats);
  }
}

TEST(guard_believes_the_range_sooner_where_the_height_has_drifted) {
  static const struct {
    const char *what;
    float zc_m, wanted_m, range_m;
    int after_ms; // 0: never
  } row[] = {{"as wanted", 0.06f, 0.06f, 0.060f, 0},
             {"1 cm nearer", 0.06f, 0.06f, 0.050f, 0},
             {"at the floor, and the height knows it", 0.041f, 0.06f, 0.041f, 1300},
             {"at the floor, and the height does not", 0.06f, 0.06f, 0.041f, 300},
             {"nearer, and the height does not know it", 0.08f, 0.08f, 0.050f, 600},
             {"a gap below the floor is wanted", 0.041f, 0.041f, 0.041f, 0}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    const hover_t h = {row[i].zc_m, row[i].wanted_m, row[i].range_m, 1.0f};
    guard_t g;
    guard_init(&g);
    const int before_ms = row[i].after_ms > 0 ? row[i].after_ms - 50 : 2500;
    hover(&g, &h, before_ms);
    CHECK((g.latched & GUARD_TOO_NEAR) == 0);
    if (row[i].after_ms == 0) continue;
    guard_init(&g);
    hover(&g, &h, row[i].after_ms + 50);
    CHECK((g.latched & GUARD_TOO_NEAR) != 0);
    CHECK(g.action == GUARD_RETREAT);
  }
}

TEST(flight_mends_what_parameters_make_within_10_ms) {
  static const struct {
    const char *what;
    size_t at;
  } row[] = {{"inner filter", offsetof(flight_t, att_filter.a1)},
             {"inner motor lag", offsetof(flight_t, att_lag_share)},
             {"outer filter", offsetof(flight_t, outer.coef.filter.b0)},
             {"outer motor lag", offsetof(flight_t, outer.coef.lag_share)},
             {"outer period", offsetof(flight_t, outer.coef.period_s)},
             {"phase", offsetof(flight_t, phase)}};
  flight_param_t p;
  params_default(&p);
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    flight_t f;
    CHECK(flight_init(&f, &p) == ST_OK);
    flight_in_t in = {.acc_b_mps2 = {0, 0, 9.81f}, .q_wb = {.w = 1.0f}, .setpoint = {.yaw = YAW_RATE}};
    for (in.step = 0; in.step < 20; in.step++) flight_step(&f, &in);
    unsigned char was[4];
    unsigned char *const at = (unsigned char *)&f + row[i].at;
    memcpy(was, at, sizeof was);
    at[3] ^= 0x20;
    CHECK(memcmp(at, was, sizeof was) != 0);
    for (const uint32_t end = in.step + 10; in.step < end; in.step++) flight_step(&f, &in);
    CHECK(memcmp(at, was, sizeof was) == 0);
  }
}
