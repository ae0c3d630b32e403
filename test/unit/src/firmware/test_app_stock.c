// test_app_stock.c - what the app remembers for the stock controller from call to call.
#include "rig/flying_app.h"
#include "rig/test.h"

TEST(app_keeps_what_the_stock_controller_commanded_until_that_runs_again) {
  // It runs in every second call; between, our forces lie over its roll, pitch and yaw.
  static flying_t f;
  app_start(&f);
  app_fly(&f, 1000);
  CHECK(crazyflie_set(&f.vehicle, "ceil.shadow", 1));
  f.set.yaw_rad = 0.5;
  f.set.pos_w_m.x = 0.2;
  f.set.pos_w_m.y = -0.2;
  int changes[3] = {0}, twice[3] = {0}; // of roll, pitch, yaw; in two calls that follow each other
  bool changed[3] = {false};
  const glue_t *app = &f.vehicle.app;
  for (int ms = 0; ms < 900; ms++) {
    const int before[3] = {app->stock.roll, app->stock.pitch, app->stock.yaw};
    app_fly(&f, 1);
    const int after[3] = {app->stock.roll, app->stock.pitch, app->stock.yaw};
    for (int i = 0; i < 3; i++) {
      twice[i] += changed[i] && after[i] != before[i];
      changed[i] = after[i] != before[i];
      changes[i] += changed[i];
    }
  }
  for (int i = 0; i < 3; i++) {
    ROW("%s", (const char *[]){"roll", "pitch", "yaw"}[i]);
    CHECK(changes[i] > 100);
    CHECK(twice[i] == 0);
  }
}

TEST(app_gives_the_stock_controller_the_heading_of_now_also_where_it_knew_another) {
  static flying_t f;
  app_start(&f);
  CHECK(crazyflie_set(&f.vehicle, "ceil.shadow", 1));
  f.set.yaw_by_rate = true;
  app_fly(&f, 2500);
  CHECK(crazyflie_set(&f.vehicle, "ceil.shadow", 0));
  f.set.yaw_by_rate = false;
  f.set.yaw_rad = 1.0;
  app_fly(&f, 4000);
  CHECK_NEAR(rig6_yaw_rad(&f.rig), 1.0, 0.02);
  f.set.yaw_by_rate = true;
  app_fly(&f, 100);
  CHECK(crazyflie_set(&f.vehicle, "ceil.shadow", 1));
  for (int ms = 0; ms < 3000; ms++) {
    app_fly(&f, 1);
    if (!CHECK_NEAR(rig6_yaw_rad(&f.rig), 1.0, 0.03)) break;
  }
}
