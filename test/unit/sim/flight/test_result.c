// test_result.c - what scenarios found, over seeds.
#include "flight/result.h"
#include "rig/test.h"

#include <stdlib.h>
#include <string.h>

typedef struct {
  double sd_mm, gap_mm, settle_s; // settle_s not finite: not reached
  int contacts;
  bool finite;
  double factor;
} flight_t;

static cJSON *made(const flight_t *f) {
  result_t result;
  why_t why;
  CHECK_OK(result_init(&result, &why));
  flown_t flown = {.n_segment = 2,
                   .outcome = {.contacts = f->contacts, .finite = f->finite, .realtime_factor = f->factor}};
  for (int i = 0; i < 2; i++)
    flown.segment[i] = (segment_t){.setpoint_m = 0.4 + 0.1 * i,
                                   .sd_mm = f->sd_mm + i,
                                   .min_gap_mm = f->gap_mm,
                                   .settle_1mm_s = f->settle_s,
                                   .contacts = i * f->contacts};
  result_add_flight(&result, &flown);
  cJSON_AddNumberToObject(result_add_row(&result, "learned"), "value", f->sd_mm);
  return result.json;
}

static double number(const cJSON *o, const char *key) {
  const cJSON *item = cJSON_GetObjectItem(o, key);
  return CHECK(cJSON_IsNumber(item)) ? item->valuedouble : (double)NAN;
}

static void check_aggregate(const flight_t flight[3], const flight_t *want) {
  cJSON *json[3];
  for (int i = 0; i < 3; i++) json[i] = made(&flight[i]);
  cJSON *all = result_over_seeds(json, 3, 41);
  const cJSON *segments = cJSON_GetObjectItem(all, "segments");
  CHECK(cJSON_GetArraySize(segments) == 2);
  for (int i = 0; i < 2; i++) {
    const cJSON *s = cJSON_GetArrayItem(segments, i);
    CHECK_NEAR(number(s, "setpoint_m"), 0.4 + 0.1 * i, 1e-12);
    CHECK_NEAR(number(s, "sd_mm"), want->sd_mm + i, 1e-12);
    CHECK_NEAR(number(s, "min_gap_mm"), want->gap_mm, 1e-12);
    CHECK_NEAR(number(s, "contacts"), i * want->contacts, 1e-12);
    const double settle_s = number(s, "settle_1mm_s");
    CHECK(isnan(want->settle_s) ? isnan(settle_s) : fabs(settle_s - want->settle_s) < 1e-12);
  }
  CHECK_NEAR(number(all, "contacts"), want->contacts, 1e-12);
  CHECK_NEAR(number(all, "realtime_factor"), want->factor, 1e-9);
  CHECK(cJSON_IsTrue(cJSON_GetObjectItem(all, "finite")) == want->finite);
  // The first seed's own table is not what they found together.
  CHECK(cJSON_GetObjectItem(all, "learned") == NULL);
  const cJSON *flights = cJSON_GetObjectItem(all, "flights");
  CHECK(cJSON_GetArraySize(flights) == 3);
  for (int i = 0; i < 3; i++) {
    const cJSON *own = cJSON_GetArrayItem(flights, i);
    CHECK_NEAR(number(own, "seed"), 41 + i, 0.0);
    const cJSON *row = cJSON_GetArrayItem(cJSON_GetObjectItem(own, "learned"), 0);
    CHECK_NEAR(number(row, "value"), flight[i].sd_mm, 0.0);
    CHECK_NEAR(number(own, "contacts"), flight[i].contacts, 0.0);
  }
  char *text = cJSON_Print(all);
  CHECK((strstr(text, "\"settle_1mm_s\":\tnull") != NULL) == !isfinite(want->settle_s));
  free(text);
  cJSON_Delete(all);
  for (int i = 0; i < 3; i++) cJSON_Delete(json[i]);
}

TEST(result_over_seeds_is_the_mean_of_what_can_be_averaged) {
  static const struct {
    const char *what;
    flight_t flight[3], want;
  } row[] = {
      {"all well",
       {{1, 20, 3, 0, true, 900}, {2, 18, 4, 0, true, 1000}, {6, 19, 5, 0, true, 1400}},
       {3, 18, 4, 0, true, 1100}},
      {"contacts in the first and second",
       {{1, 20, 3, 2, true, 900}, {2, 18, 4, 3, true, 1000}, {6, 19, 5, 0, true, 1400}},
       {3, 18, 4, 5, true, 1100}},
      {"one not settled",
       {{1, 20, 3, 0, true, 900}, {2, 18, (double)NAN, 0, true, 1000}, {6, 19, 5, 0, true, 1400}},
       {3, 18, (double)NAN, 0, true, 1100}},
      {"the first not finite",
       {{1, 20, 3, 0, false, 900}, {2, 18, 4, 0, true, 1000}, {6, 19, 5, 0, true, 1400}},
       {3, 18, 4, 0, false, 1100}},
      {"the last not finite",
       {{1, 20, 3, 0, true, 900}, {2, 18, 4, 0, true, 1000}, {6, 19, 5, 0, false, 1400}},
       {3, 18, 4, 0, false, 1100}},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    check_aggregate(row[i].flight, &row[i].want);
  }
}

TEST(result_without_a_text_is_an_error) {
  why_t why = {""};
  CHECK_STATUS(FAILED, result_write(NULL, stdout, &why)); // what cJSON returns without memory
  CHECK_TEXT(why.text, "out of memory");
}
