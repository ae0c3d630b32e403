// test_lpf2.c - the low-pass against the analytic Butterworth.
#include "flight/lpf2.h"
#include "rig/splitmix.h"
#include "rig/test.h"

#include <complex.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

// |H| of the coefficients at f_Hz.
static double gain_of(const lpf2_coef_t *c, double f_Hz, double rate_Hz) {
  const double complex z1 = cexp(-(double complex)I * (2.0 * PI * f_Hz / rate_Hz));
  const double complex above = (double)c->b0 + (double)c->b1 * z1 + (double)c->b2 * z1 * z1;
  return cabs(above / (1.0 + (double)c->a1 * z1 + (double)c->a2 * z1 * z1));
}

// |H| of a second-order Butterworth after the prewarped bilinear transform.
static double butterworth(double f_Hz, double cutoff_Hz, double rate_Hz) {
  return 1.0 / sqrt(1.0 + pow(tan(PI * f_Hz / rate_Hz) / tan(PI * cutoff_Hz / rate_Hz), 4.0));
}

static const struct {
  float cutoff_Hz, rate_Hz;
} FILTER[] = {
    {8.0f, 100.0f}, {1.0f, 100.0f},  {0.5f, 100.0f},   {20.0f, 100.0f},   {30.0f, 100.0f}, {45.0f, 100.0f},
    {8.0f, 500.0f}, {30.0f, 500.0f}, {80.0f, 1000.0f}, {450.0f, 1000.0f}, {0.1f, 10.0f},   {2.0f, 40.0f},
};
#define FILTER_COUNT (sizeof FILTER / sizeof *FILTER)

TEST(lpf2_is_the_analytic_butterworth) {
  for (unsigned i = 0; i < FILTER_COUNT; i++) {
    const float cutoff = FILTER[i].cutoff_Hz, rate = FILTER[i].rate_Hz;
    ROW("%g Hz at %g Hz", (double)cutoff, (double)rate);
    lpf2_coef_t c;
    CHECK_OK(lpf2_tune(&c, cutoff, rate));
    // Rounding of a1 and a2 (1e-7) is seen at low frequencies through 1 + a1 + a2 = 4 k^2/n.
    const double k = tan(PI * (double)cutoff / (double)rate);
    const double tol = 1e-6 + 2e-7 / (4.0 * k * k);
    CHECK_NEAR(gain_of(&c, 0.0, (double)rate), 1.0, tol);
    CHECK_NEAR(gain_of(&c, (double)cutoff, (double)rate), sqrt(0.5), tol);
    CHECK_NEAR(gain_of(&c, 0.5 * (double)rate, (double)rate), 0.0, 1e-6);
    for (double f = 0.05; f < 0.5; f += 0.05)
      CHECK_NEAR(gain_of(&c, f * (double)rate, (double)rate),
                 butterworth(f * (double)rate, (double)cutoff, (double)rate), tol);
  }
}

TEST(lpf2_coefficients_are_those_of_the_formula_in_double) {
  for (unsigned i = 0; i < FILTER_COUNT; i++) {
    ROW("%g Hz at %g Hz", (double)FILTER[i].cutoff_Hz, (double)FILTER[i].rate_Hz);
    lpf2_coef_t c;
    CHECK_OK(lpf2_tune(&c, FILTER[i].cutoff_Hz, FILTER[i].rate_Hz));
    const double k = tan(PI * (double)FILTER[i].cutoff_Hz / (double)FILTER[i].rate_Hz);
    const double n = 1.0 + sqrt(2.0) * k + k * k, b0 = k * k / n;
    CHECK_NEAR(c.b0, b0, 1e-6 * b0);
    CHECK_NEAR(c.b1, 2.0 * b0, 2e-6 * b0);
    CHECK_NEAR(c.b2, b0, 1e-6 * b0);
    CHECK_NEAR(c.a1, 2.0 * (k * k - 1.0) / n, 4e-7);
    CHECK_NEAR(c.a2, (1.0 - sqrt(2.0) * k + k * k) / n, 2e-7);
  }
}

TEST(lpf2_passes_a_sine_at_the_cut_off_with_0_71) {
  lpf2_coef_t c;
  CHECK_OK(lpf2_tune(&c, 8.0f, 100.0f));
  lpf2_t s;
  lpf2_reset(&s, 0.0f);
  double power = 0.0;
  for (int i = 0; i < 1100; i++) {
    const double y = (double)lpf2_step(&s, &c, (float)sin(2.0 * PI * 0.08 * i));
    if (i >= 100) power += y * y; // 1000 samples are 80 periods
  }
  CHECK_NEAR(sqrt(2.0 * power / 1000.0), sqrt(0.5), 1e-5);
}

TEST(lpf2_is_stable_at_every_cut_off_it_accepts) {
  for (double f = 1e-7; f <= 0.45; f *= 2.0) {
    ROW("cut-off %.3g of the rate", f);
    lpf2_coef_t c;
    if (lpf2_tune(&c, (float)(f * 100.0), 100.0f) != ST_OK) continue;
    CHECK(fabsf(c.a2) < 1.0f);
    CHECK(fabs((double)c.a1) < 1.0 + (double)c.a2);
    CHECK_NEAR(gain_of(&c, 0.0, 100.0), 1.0, 0.01);
  }
}

TEST(lpf2_without_a_cut_off_gives_the_input_to_the_bit) {
  lpf2_coef_t c;
  CHECK_OK(lpf2_tune(&c, 0.0f, 100.0f));
  lpf2_t s;
  lpf2_reset(&s, 3.0f);
  splitmix_t r = {1};
  for (int i = 0; i < 1000; i++) {
    const float x = (float)splitmix_normal(&r, pow(10.0, splitmix_between(&r, -30.0, 30.0)));
    const float y = lpf2_step(&s, &c, x);
    CHECK(memcmp(&x, &y, sizeof x) == 0);
  }
}

TEST(lpf2_keeps_its_coefficients_when_it_cannot_use_the_new_ones) {
  static const struct {
    const char *what;
    float cutoff_Hz, rate_Hz;
  } row[] = {
      {"negative cut-off", -1.0f, 100.0f},    {"cut-off above 0.45 of the rate", 45.1f, 100.0f},
      {"cut-off at nyquist", 50.0f, 100.0f},  {"cut-off nan", NAN, 100.0f},
      {"cut-off infinite", INFINITY, 100.0f}, {"rate zero", 0.0f, 0.0f},
      {"rate negative", 8.0f, -100.0f},       {"rate nan", 8.0f, NAN},
      {"rate infinite", 8.0f, INFINITY},      {"both infinite", INFINITY, INFINITY},
      {"rate above 100 kHz", 200.0f, 1.1e5f}, {"cut-off below 0.001 of the rate", 0.099f, 100.0f},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    lpf2_coef_t c;
    CHECK_OK(lpf2_tune(&c, 8.0f, 100.0f));
    const lpf2_coef_t before = c;
    CHECK_STATUS(ST_BAD_PARAM, lpf2_tune(&c, row[i].cutoff_Hz, row[i].rate_Hz));
    CHECK(memcmp(&c, &before, sizeof c) == 0);
  }
}

TEST(lpf2_changes_its_cut_off_in_flight_without_a_bump) {
  static const float cutoff_Hz[] = {8.0f, 20.0f, 3.0f, 0.0f, 1.0f, 45.0f, 8.0f};
  lpf2_coef_t c;
  lpf2_t still, ramp;
  lpf2_reset(&still, 5.0f);
  lpf2_reset(&ramp, 0.0f);
  float last = 0.0f;
  for (int i = 0; i < 7 * 50; i++) {
    ROW("tick %d, %g Hz", i, (double)cutoff_Hz[i / 50]);
    CHECK_OK(lpf2_tune(&c, cutoff_Hz[i / 50], 100.0f));
    CHECK_NEAR(lpf2_step(&still, &c, 5.0f), 5.0, 2e-4); // rounding through 1 + a1 + a2 at 1 Hz
    const float y = lpf2_step(&ramp, &c, 0.01f * (float)i);
    // A ramp has a lag of sqrt(2)/(2 pi f), which is made up or lost after a change, but not in one tick.
    // Without a filter there is nothing that could hold it back.
    if (cutoff_Hz[i / 50] > 0.0f && cutoff_Hz[i / 50] < 45.0f) CHECK_NEAR(y - last, 0.01, 0.025);
    last = y;
  }
}

TEST(lpf2_starts_as_if_the_value_had_been_there_for_ever) {
  lpf2_coef_t c;
  CHECK_OK(lpf2_tune(&c, 8.0f, 100.0f));
  lpf2_t s;
  lpf2_reset(&s, -9.81f);
  for (int i = 0; i < 1000; i++) CHECK_NEAR(lpf2_step(&s, &c, -9.81f), -9.81, 2e-5);
  lpf2_reset(&s, 2.0f);
  CHECK_NEAR(lpf2_step(&s, &c, 2.0f), 2.0, 1e-6);
}
