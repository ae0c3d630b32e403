// test_pid.c - the sixteen PIDs of thesis tables 4.2 to 4.5.
#include "flight/scenario.h"
#include "rig/test.h"

typedef struct {
  const char *what;
  bool touches;
  double overshoot_mm;   // of those that do not touch
  double final_error_mm; // after 20 s; NaN: not given
  bool touches_at_18_ms;
} row_t;

#define NOT_GIVEN ((double)NAN)

// A row of several flights has a label each, in this order.
static const row_t rows[16] = {
    {"4.2 0.40", false, 14.7, 0.8, false}, {"4.2 0.45", false, 12.4, 1.5, false},
    {"4.2 0.48", false, 16.6, 4.1, true},  {"4.2 0.49", true, 0.0, NOT_GIVEN, true},
    {"4.3 0.10", false, 12.0, 0.1, false}, {"4.3 0.15", false, 16.1, 0.5, false},
    {"4.3 0.18", false, 14.6, 2.2, false}, {"4.3 0.19", true, 0.0, NOT_GIVEN, true},
    {"4.4 0.40", false, 0.0, 0.0, false},  {"4.4 0.45", false, 0.0, 0.0, false},
    {"4.4 0.48", false, 6.6, 0.0, false},  {"4.4 0.49", false, 4.2, 0.0, false},
    {"4.5 0.10", false, 23.3, 0.0, false}, {"4.5 0.15", false, 7.7, 0.0, false},
    {"4.5 0.18", false, 3.8, 0.0, false},  {"4.5 0.19", false, 0.0, 0.0, false},
};

static double number(const cJSON *o, const char *key) {
  return cJSON_GetObjectItem(o, key)->valuedouble;
}

// Flown once for both tests.
static const cJSON *flown(void) {
  static result_t result;
  why_t why;
  const request_t request = {.integrate = INTEGRATE_RK4};
  if (!result.json && CHECK_OK(result_init(&result, &why)))
    CHECK_OK(scenario_find("pid-tables")->run(&request, &result, &why));
  return result.json;
}

TEST(pid_tables_touch_the_ceiling_where_the_thesis_says) {
  const cJSON *segments = cJSON_GetObjectItem(flown(), "segments");
  CHECK(cJSON_GetArraySize(segments) == 16);
  for (int i = 0; i < 16; i++) {
    ROW("%s", rows[i].what);
    const cJSON *s = cJSON_GetArrayItem(segments, i);
    CHECK((number(s, "contacts") > 0) == rows[i].touches);
    if (!rows[i].touches) CHECK_NEAR(number(s, "overshoot_mm"), rows[i].overshoot_mm, 1.0);
    // The mean over the last 5 s is a little more than the error at the end, which is what is given.
    if (!isnan(rows[i].final_error_mm))
      CHECK_NEAR(number(s, "mean_error_mm"), rows[i].final_error_mm, 0.1 + 0.6 * rows[i].final_error_mm);
  }
}

TEST(discrete_pid_fails_when_its_derivative_filter_does) {
  // Forward Euler with N = 100 is unstable from 2/N = 20 ms on; the thesis's limit of 0.02 s is
  // that.
  const cJSON *discrete = cJSON_GetObjectItem(flown(), "discrete");
  CHECK(cJSON_GetArraySize(discrete) == 32);
  for (int i = 0; i < 32; i++) {
    const cJSON *row = cJSON_GetArrayItem(discrete, i);
    ROW("%s at %g s", rows[i % 16].what, number(row, "period_s"));
    CHECK_NEAR(number(row, "period_s"), i < 16 ? 0.018 : 0.0202, 1e-12);
    CHECK((number(row, "contacts") > 0) == (i < 16 ? rows[i].touches_at_18_ms : true));
  }
}
