// test_app_logs.c - that a row of numbered logs shows its own element each.
#include "crazyflie/crazyflie.h"
#include "rig/test.h"

#include <stdio.h>

TEST(app_logs_each_motor_weight_and_variance_under_its_own_number) {
  static crazyflie_t c;
  crazyflie_init(&c, NULL);
  crazyflie_start(&c);
  for (int i = 0; i < MOTORS; i++) {
    c.app.flight.out.motors.force_N[i] = 0.1f * (float)(i + 1);
    c.app.in.force_N[i] = 0.2f * (float)(i + 1);
  }
  rls_t *const rls = &c.app.flight.outer.learn.rls;
  for (int i = 0; i < RBF_N; i++) {
    rls->theta.w[i] = 0.3f * (float)(i + 1);
    for (int j = 0; j < RBF_N; j++) rls->P[i][j] = i == j ? 0.4f * (float)(i + 1) : -1.0f;
  }
  static const struct {
    const char *name;
    int n;
    double first;
  } row[] = {
      {"indi.m", MOTORS, 0.1}, {"indiIn.f", MOTORS, 0.2}, {"rls.w", RBF_N, 0.3}, {"rls.p", RBF_N, 0.4}};
  for (unsigned k = 0; k < sizeof row / sizeof *row; k++)
    for (int i = 1; i <= row[k].n; i++) {
      char name[16];
      snprintf(name, sizeof name, "%s%d", row[k].name, i);
      ROW("%s", name);
      double value = 0.0;
      CHECK(crazyflie_log(&c, name, &value));
      CHECK_NEAR(value, row[k].first * i, 1e-6);
    }
}
