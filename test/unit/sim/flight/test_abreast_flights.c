// test_abreast_flights.c - whole flights side by side: each comes to what it comes to alone, to the last
// digit.
#include "base/lane.h"
#include "body/abreast.h"
#include "flight/scenario.h"
#include "rig/test.h"
#include <stdlib.h>
#include <string.h>

#define SEEDS 16

typedef struct {
  const scenario_t *scenario;
  const noise_t *noise;
  fly_kind_t kind;
  char *text[SEEDS]; // all that is known of a flight; null: refused
} flights_t;

static void fly(void *self, int i) {
  flights_t *const f = self;
  const request_t request = {
      .kind = &f->kind, .noise = f->noise, .integrate = INTEGRATE_SUNDIALS, .seed = 1 + (uint64_t)i};
  result_t result;
  why_t why;
  if (!CHECK_OK(result_init(&result, &why))) return;
  if (f->scenario->run(&request, &result, &why) == DONE) {
    cJSON_DeleteItemFromObject(result.json, "realtime_factor"); // differs from run to run
    f->text[i] = cJSON_PrintUnformatted(result.json);
  }
  result_free(&result);
}

static bool same(const char *a, const char *b) {
  return a && b ? strcmp(a, b) == 0 : a == b;
}

// How many flights were not refused.
static int compare(const scenario_t *scenario, const noise_t *noise, fly_kind_t kind, int seeds,
                   bool must_be_together) {
  flights_t alone = {.scenario = scenario, .noise = noise, .kind = kind}, beside = alone;
  for (int i = 0; i < seeds; i++) fly(&alone, i);
  const long together = abreast(seeds, fly, &beside);
  if (lane_possible() && must_be_together) CHECK(together > 0);
  int flown = 0;
  for (int i = 0; i < seeds; i++) {
    ROW("%s, %s, %s, seed %d", scenario->name, fly_name[kind], noise->name, i + 1);
    CHECK(same(alone.text[i], beside.text[i]));
    flown += alone.text[i] != NULL;
    free(alone.text[i]);
    free(beside.text[i]);
  }
  return flown;
}

// Two with their own controller, or with TEST_LONG=1 every scenario with every controller.
TEST(abreast_flights_come_to_what_they_come_to_alone) {
  if (!test_long()) {
    CHECK(compare(scenario_find("test-flight"), noise_find("real"), FLY_INDI_RBF, 8, true) == 8);
    CHECK(compare(scenario_find("touch-and-go"), noise_find("flown"), FLY_INDI_RBF, 8, true) == 8);
    return;
  }
  int flown = 0;
  for (int k = 0; k < scenario_count; k++)
    for (int kind = 0; kind < FLY_COUNT; kind++) {
      flown += compare(scenario_table[k], noise_find("real"), (fly_kind_t)kind, SEEDS, false);
      flown += compare(scenario_table[k], noise_find("flown"), (fly_kind_t)kind, SEEDS, false);
    }
  CHECK(flown > scenario_count * SEEDS);
}
