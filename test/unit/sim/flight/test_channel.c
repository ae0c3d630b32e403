// test_channel.c - between floor and ceiling: each curve is its surface's, where the other one's is known.
#include "flight/scenario.h"
#include "rig/share.h"
#include "rig/test.h"
#include "vehicle/model_file.h"

#include <math.h>
#include <string.h>

#define SEEDS 4

static double of(const cJSON *row, const char *key) {
  const cJSON *cell = cJSON_GetObjectItem(row, key);
  return cJSON_IsNumber(cell) ? cell->valuedouble : (double)NAN;
}

static const char *text(const cJSON *row, const char *key) {
  return cJSON_GetObjectItem(row, key)->valuestring;
}

// Excess learned less excess there.
static void check_learned(const cJSON *json) {
  static const struct {
    const char *flight;
    double distance_mm, least, most;
  } want[] = {{"floor", 100, -0.006, 0.006}, {"floor", 60, -0.006, 0.006}, {"floor", 30, -0.006, 0.006},
              {"floor", 15, -0.006, 0.006},  {"unknown", 80, 0.03, 0.08},  {"unknown", 50, 0.012, 0.03},
              {"known", 50, -0.006, 0.006},  {"known", 30, -0.008, 0.008}, {"known", 20, -0.01, 0.01}};
  for (unsigned i = 0; i < sizeof want / sizeof *want; i++) {
    ROW("%s, %g mm", want[i].flight, want[i].distance_mm);
    const cJSON *row;
    int seen = 0;
    cJSON_ArrayForEach(row, cJSON_GetObjectItem(json, "learned")) {
      if (strcmp(text(row, "flight"), want[i].flight) != 0 || of(row, "distance_mm") != want[i].distance_mm)
        continue;
      const double wrong = of(row, "excess") - of(row, "there");
      CHECK(wrong >= want[i].least && wrong <= want[i].most);
      seen++;
    }
    CHECK(seen == 1);
  }
}

TEST(channel_teaches_each_curve_its_own_surface_where_the_floors_is_known) {
  for (int i = 0; i < SEEDS; i++) {
    request_t request = {.integrate = INTEGRATE_RK4, .seed = share_seed(1) + (uint64_t)i};
    result_t result;
    why_t why;
    if (!CHECK_OK(result_init(&result, &why)) ||
        !CHECK_OK(scenario_find("channel")->run(&request, &result, &why)))
      return;
    check_learned(result.json);
    const cJSON *s;
    cJSON_ArrayForEach(s, cJSON_GetObjectItem(result.json, "segments")) {
      ROW("seed %d, %s, %g m", (int)request.seed, text(s, "label"), of(s, "setpoint_m"));
      CHECK(of(s, "contacts") == 0.0 && of(s, "rms_mm") < 3.0);
    }
    result_free(&result);
  }
}

TEST(channel_is_no_flight_for_who_does_not_learn_or_has_a_ceiling_elsewhere) {
  static const fly_kind_t standard = FLY_INDI;
  request_t request = {.kind = &standard, .integrate = INTEGRATE_RK4, .seed = 1};
  result_t result;
  why_t why;
  if (!CHECK_OK(result_init(&result, &why))) return;
  CHECK_STATUS(BAD_INPUT, scenario_find("channel")->run(&request, &result, &why));
  CHECK(strstr(why.text, "allowed in channel are neither") != NULL);
  model_t vehicle;
  CHECK_OK(model_builtin("cf21_legacy", &vehicle, &why));
  vehicle.ceiling_m = 0.5;
  request = (request_t){.vehicle = &vehicle, .integrate = INTEGRATE_RK4, .seed = 1};
  CHECK_STATUS(BAD_INPUT, scenario_find("channel")->run(&request, &result, &why));
  CHECK(strstr(why.text, "ceiling_m is 0.5 m; allowed in channel is none, or 0.15") != NULL);
  result_free(&result);
}
