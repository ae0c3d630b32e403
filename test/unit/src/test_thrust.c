// test_thrust.c - motor lag, and that the modelled thrust and the filtered acceleration are synchronous.
#include "flight/thrust.h"
#include "rig/splitmix.h"
#include "rig/test.h"

#include <string.h>

static lpf2_coef_t filter_of(float cutoff_Hz, float rate_Hz) {
  lpf2_coef_t c;
  CHECK_OK(lpf2_tune(&c, cutoff_Hz, rate_Hz));
  return c;
}

TEST(thrust_lag_share_is_that_of_a_first_order_lag) {
  static const struct {
    float period_s, tau_s;
  } row[] = {{0.01f, 0.0625f}, {0.002f, 0.0625f}, {0.01f, 0.001f}, {0.001f, 0.5f}, {0.1f, 0.001f}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%g s of %g s", (double)row[i].period_s, (double)row[i].tau_s);
    CHECK_NEAR(thrust_lag_share(row[i].period_s, row[i].tau_s),
               -expm1(-(double)row[i].period_s / (double)row[i].tau_s), 1e-7);
  }
  ROW("100 Hz, not the 500 Hz of the author's constant");
  CHECK_NEAR(thrust_lag_share(0.01f, 0.0625f), 0.14786, 5e-6);
}

// Time until a step of the command has come through to `share`, at 1 kHz.
static double time_to_s(double share, float tau_s, float cutoff_Hz) {
  const lpf2_coef_t c = filter_of(cutoff_Hz, 1000.0f);
  thrust_t s;
  thrust_reset(&s, 0.0f);
  int k = 0;
  while (k < 10000 &&
         (double)thrust_step(&s, &c, thrust_lag_share(0.001f, tau_s), 0.001f, 1.0f, false) < share)
    k++;
  return 0.001 * (k + 1);
}

TEST(thrust_reaches_90_percent_when_a_first_order_lag_does) {
  static const struct {
    const char *what;
    float rate_radps, cutoff_Hz;
    double share, time_s;
  } row[] = {
      {"16 rad/s, 90 %", 16.0f, 0.0f, 0.90, 0.144},
      {"16 rad/s, 99.2 %", 16.0f, 0.0f, 0.992, 0.302},
      {"7.68 rad/s, 90 %", 7.68f, 0.0f, 0.90, 0.300},
      {"16 rad/s and 8 Hz, 90 %", 16.0f, 8.0f, 0.90, 0.170},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    CHECK_NEAR(time_to_s(row[i].share, 1.0f / row[i].rate_radps, row[i].cutoff_Hz), row[i].time_s, 0.0015);
  }
}

TEST(thrust_answers_a_command_in_the_tick_that_hears_of_it) {
  // T(k) = T(k-1) + share (F(k) - T(k-1)), F(k) from the command of the period that has just ended.
  const lpf2_coef_t none = filter_of(0.0f, 100.0f), c = filter_of(8.0f, 100.0f);
  thrust_t s;
  thrust_reset(&s, 0.0f);
  CHECK_NEAR(thrust_step(&s, &none, 0.25f, 0.01f, 1.0f, false), 0.25, 1e-7);
  CHECK_NEAR(thrust_step(&s, &none, 0.25f, 0.01f, 0.0f, false), 0.1875, 1e-7);
  thrust_reset(&s, 0.0f);
  CHECK_NEAR(thrust_step(&s, &c, 0.25f, 0.01f, 1.0f, false), 0.25f * c.b0, 1e-7);
}

// The largest difference, in N, between m x filtered acceleration of an ideal vehicle and the modelled
// thrust, when the model hears each command `late` ticks after the vehicle did.
static double difference_N(float cutoff_Hz, double tau_s, int late) {
  const double period_s = 0.01, mass_kg = 0.032;
  const lpf2_coef_t c = filter_of(cutoff_Hz, 100.0f);
  const float share = thrust_lag_share((float)period_s, (float)tau_s);
  lpf2_t acc;
  thrust_t model;
  const double start_N = mass_kg * 9.81;
  lpf2_reset(&acc, 9.81f);
  thrust_reset(&model, (float)start_N);
  splitmix_t r = {1};
  double command_N[1002] = {start_N, start_N}, motors_N = start_N, worst_N = 0.0;
  for (int k = 2; k < 1002; k++) {
    command_N[k] = splitmix_bits(&r) % 20 == 0 ? splitmix_between(&r, 0.0, 0.6) : command_N[k - 1];
    // The motors during the period: an exact first-order lag behind a command that is held.
    motors_N = command_N[k] + (motors_N - command_N[k]) * exp(-period_s / tau_s);
    const double felt_N = mass_kg * (double)lpf2_step(&acc, &c, (float)(motors_N / mass_kg));
    const double modelled_N =
        (double)thrust_step(&model, &c, share, (float)period_s, (float)command_N[k - late], false);
    worst_N = fmax(worst_N, fabs(felt_N - modelled_N));
  }
  return worst_N;
}

TEST(thrust_and_filtered_acceleration_agree_tick_by_tick) {
  static const float cutoff_Hz[] = {0.0f, 3.0f, 8.0f, 30.0f, 45.0f};
  static const double tau_s[] = {0.03, 0.0625, 0.2};
  for (unsigned i = 0; i < sizeof cutoff_Hz / sizeof *cutoff_Hz; i++)
    for (unsigned k = 0; k < sizeof tau_s / sizeof *tau_s; k++) {
      ROW("%g Hz, lag %g s", (double)cutoff_Hz[i], tau_s[k]);
      CHECK_NEAR(difference_N(cutoff_Hz[i], tau_s[k], 0), 0.0, 3e-6);
      ROW("%g Hz, lag %g s, one tick late", (double)cutoff_Hz[i], tau_s[k]);
      CHECK(difference_N(cutoff_Hz[i], tau_s[k], 1) > 3e-3);
    }
}

TEST(thrust_starts_at_rest_and_stays_there) {
  const lpf2_coef_t c = filter_of(8.0f, 100.0f);
  thrust_t s;
  thrust_reset(&s, 0.31f);
  CHECK(s.since_limit_s == THRUST_LIMIT_MEMORY_S);
  for (int k = 0; k < 1000; k++) CHECK_NEAR(thrust_step(&s, &c, 0.15f, 0.01f, 0.31f, false), 0.31, 1e-6);
}

TEST(thrust_remembers_how_long_ago_a_limit_was) {
  const lpf2_coef_t c = filter_of(8.0f, 100.0f);
  thrust_t s;
  thrust_reset(&s, 0.3f);
  (void)thrust_step(&s, &c, 0.15f, 0.01f, 0.3f, true);
  CHECK(s.since_limit_s == 0.0f);
  for (int k = 0; k < 50; k++) (void)thrust_step(&s, &c, 0.15f, 0.01f, 0.3f, false);
  CHECK_NEAR(s.since_limit_s, 0.5, 1e-5);
  for (int k = 0; k < 5000; k++) (void)thrust_step(&s, &c, 0.15f, 0.01f, 0.3f, false);
  CHECK_NEAR(s.since_limit_s, THRUST_LIMIT_MEMORY_S, 0.011);
  (void)thrust_step(&s, &c, 0.15f, 0.01f, 0.3f, true);
  CHECK(s.since_limit_s == 0.0f);
}
