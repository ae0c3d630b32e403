// test_by_height.c - flights by the flight code's own height and climb (height.own): nearer to the ceiling
// with less error, safe where it is touched, and nothing else while it is off.
#include "flight/scenario.h"
#include "flight/together.h"
#include "rig/test.h"

#include <math.h>
#include <string.h>

#define SEEDS    8
#define AT_15_MM 7 // segment of the nearest flight

static cJSON *fly(const char *scenario, const char *noise, const char *const set[], int sets, uint64_t seed) {
  static const fly_kind_t KIND = FLY_INDI_RBF;
  request_t request = {.integrate = INTEGRATE_RK4, .kind = &KIND, .noise = noise_find(noise), .seed = seed};
  result_t result;
  why_t why;
  for (int i = 0; i < sets; i++) CHECK_OK(param_parse(set[i], &request.set[request.n_set++], &why));
  if (!CHECK_OK(result_init(&result, &why))) return NULL;
  CHECK_OK(scenario_find(scenario)->run(&request, &result, &why));
  cJSON *json = cJSON_Duplicate(result.json, true);
  result_free(&result);
  return json;
}

static double of(const cJSON *json, int segment, const char *key) {
  const cJSON *row = cJSON_GetArrayItem(cJSON_GetObjectItem(json, "segments"), segment);
  const cJSON *cell = cJSON_GetObjectItem(row, key);
  return cJSON_IsNumber(cell) ? cell->valuedouble : (double)NAN;
}

static const char *const OWN[] = {"height.own=1"};

// Seeds from 1 on, eight at a time.
typedef struct {
  const char *scenario;
  int own;
  cJSON *json[SEEDS];
} flights_t;

static void fly_one(void *self, int i) {
  flights_t *const f = self;
  f->json[i] = fly(f->scenario, "real", OWN, f->own, 1 + (uint64_t)i);
}

TEST(by_height_15_mm_are_held_with_less_error_than_by_the_estimator) {
  double sum_mm2[2] = {0.0};
  for (int own = 0; own <= 1; own++) {
    flights_t flown = {.scenario = "nearest-flight", .own = own};
    (void)together(SEEDS, fly_one, &flown);
    for (int i = 0; i < SEEDS; i++) {
      ROW("seed %d, own %d", 1 + i, own);
      CHECK_NEAR(of(flown.json[i], AT_15_MM, "setpoint_m"), 0.485, 1e-9);
      sum_mm2[own] += pow(of(flown.json[i], AT_15_MM, "rms_mm"), 2.0) / SEEDS;
      for (int k = 0; own && k <= AT_15_MM; k++) CHECK(of(flown.json[i], k, "contacts") == 0.0);
      cJSON_Delete(flown.json[i]);
    }
  }
  CHECK(sqrt(sum_mm2[1]) < 0.74 * sqrt(sum_mm2[0])); // by its climb alone 0.79
  CHECK(sqrt(sum_mm2[1]) < 1.5);
}

TEST(by_height_a_push_against_the_ceiling_ends_as_without) {
  flights_t flown = {.scenario = "touch-and-go", .own = 1};
  (void)together(SEEDS, fly_one, &flown);
  for (int k = 0; k < SEEDS; k++) {
    cJSON *const json = flown.json[k];
    ROW("seed %d", 1 + k);
    for (int i = 2; i < 8; i += 2) {
      CHECK(of(json, i, "contacts") > 0.0);
      CHECK(of(json, i + 1, "overshoot_mm") < 50.0);
      CHECK(of(json, i + 1, "rms_mm") < 20.0);
    }
    cJSON_Delete(json);
  }
}

TEST(by_height_nothing_differs_while_it_is_off) {
  static const char *const OTHER[] = {"height.tauMot=0.2", "height.delay=0", "height.walk=2",   "height.kp=9",
                                      "height.kd=30",      "height.quick=1", "height.catch=0.5"};
  for (int k = 0; k < 2; k++) {
    ROW("%s", k ? "flown" : "real");
    const char *const noise = k ? "flown" : "real";
    cJSON *as_ships = fly("nearest-flight", noise, OTHER, 0, 1);
    cJSON *other = fly("nearest-flight", noise, OTHER, sizeof OTHER / sizeof *OTHER, 1);
    // As text: what is not a number equals nothing.
    char *const want = cJSON_PrintUnformatted(cJSON_GetObjectItem(as_ships, "segments"));
    char *const got = cJSON_PrintUnformatted(cJSON_GetObjectItem(other, "segments"));
    CHECK(strcmp(want, got) == 0);
    cJSON_free(want);
    cJSON_free(got);
    CHECK(of(other, AT_15_MM, "rms_mm") > 0.0);
    cJSON_Delete(as_ships);
    cJSON_Delete(other);
  }
}
