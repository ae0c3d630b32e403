// test_app_battery_cap.c - what a low battery lets through of the thrust that is asked for.
#include "crazyflie/stand_in.h"
#include "firmware/battery_cap.h"
#include "rig/test.h"

#include <string.h>

// Thrust of a motor by its voltage, legacy propellers.
#define LEGACY                                                                                               \
  { -0.0148307f, 0.0472447f, -0.0184736f, 0.00596092f }

TEST(app_counts_as_applied_what_a_low_battery_lets_through) {
  static stand_in_t low = {.thrust_max_N = 0.12f, .volt_N = LEGACY};
  static const struct {
    float battery_V;
    uint16_t duty[MOTORS];
    float want_N[MOTORS]; // of 0.1 N each: by hand from the map
  } row[] = {
      {3.7f,
       {65535, 65535, 65535, 65535},
       {0.1f, 0.1f, 0.1f, 0.1f}}, // could give more than is ever asked for
      {2.99f, {65535, 65535, 65535, 65535}, {0.1f, 0.1f, 0.1f, 0.1f}},
      {2.5f, {65534, 60000, 30000, 0}, {0.1f, 0.1f, 0.1f, 0.1f}}, // not at the limit
      {2.5f, {65535, 52428, 26214, 0}, {0.0809604f, 0.0534517f, 0.0199013f, 0.0f}},
      {2.5f, {52428, 65535, 0, 26214}, {0.0534517f, 0.0809604f, 0.0f, 0.0199013f}},
      {2.5f, {26214, 0, 65535, 52428}, {0.0199013f, 0.0f, 0.0809604f, 0.0534517f}},
      {2.5f, {0, 26214, 52428, 65535}, {0.0f, 0.0199013f, 0.0534517f, 0.0809604f}},
  };
  stand_in = &low;
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%g V, row %u", (double)row[i].battery_V, i);
    low.battery_V = row[i].battery_V;
    memcpy(low.duty, row[i].duty, sizeof low.duty);
    float force_N[MOTORS] = {0.1f, 0.1f, 0.1f, 0.1f};
    battery_cap(force_N);
    for (int k = 0; k < MOTORS; k++) CHECK_NEAR(force_N[k], row[i].want_N[k], 1e-6);
  }
  // Never more than was asked for.
  float force_N[MOTORS] = {0.01f, 0.01f, 0.01f, 0.01f};
  low.battery_V = 2.5f;
  battery_cap(force_N);
  CHECK(force_N[3] == 0.01f && force_N[0] == 0.0f);
}

TEST(app_takes_a_battery_that_just_gives_full_thrust_for_no_low_one) {
  static stand_in_t enough = {.thrust_max_N = 0.12f, .volt_N = {0.0f, 0.03f}, .battery_V = 4.0f};
  stand_in = &enough;
  enough.duty[0] = UINT16_MAX;
  enough.duty[1] = 30000;
  float force_N[MOTORS] = {0.1f, 0.1f, 0.1f, 0.1f};
  battery_cap(force_N);
  CHECK(force_N[0] == 0.1f && force_N[1] == 0.1f);
}
