// test_together.c - whole flights eight at a time: each comes to what it comes to alone, to the last digit.
#define _POSIX_C_SOURCE 200809L // open_memstream
#include "base/lane.h"
#include "flight/scenario.h"
#include "flight/together.h"
#include "rig/test.h"
#include <stdlib.h>
#include <string.h>

#define SEEDS 16

typedef struct {
  const char *scenario, *noise;
  fly_kind_t kind;
  integrate_kind_t integrate;
  bool log; // the app's, too
} case_t;

typedef struct {
  const case_t *as;
  char *text[SEEDS]; // all that is known of a flight; null: refused
} flights_t;

// Every sample to the last digit, with the app's logs, and what it came to.
static char *all_of(result_t *result) {
  char *text = NULL;
  size_t size;
  FILE *const file = open_memstream(&text, &size);
  if (!CHECK(file != NULL)) return NULL;
  cJSON_DeleteItemFromObject(result->json, "realtime_factor"); // differs from run to run
  char *const json = cJSON_PrintUnformatted(result->json);
  fprintf(file, "%s\n", json);
  record_write(&result->record, file);
  fclose(file);
  free(json);
  return text;
}

static void fly(void *self, int i) {
  flights_t *const f = self;
  const case_t *const as = f->as;
  const request_t request = {.kind = as->kind < FLY_COUNT ? &as->kind : NULL,
                             .noise = noise_find(as->noise),
                             .integrate = as->integrate,
                             .log = as->log,
                             .seed = 1 + (uint64_t)i};
  result_t result;
  why_t why;
  if (!CHECK_OK(result_init(&result, &why))) return;
  if (scenario_find(as->scenario)->run(&request, &result, &why) == DONE) f->text[i] = all_of(&result);
  result_free(&result);
}

static bool same(const char *a, const char *b) {
  return a && b ? strcmp(a, b) == 0 : a == b;
}

// How many flights were not refused.
static int compare(const case_t *as, int seeds, long *together_ms) {
  flights_t alone = {.as = as}, beside = alone;
  const int step = test_long() ? 1 : 3; // of few, every third is flown alone, too
  for (int i = 0; i < seeds; i += step) fly(&alone, i);
  *together_ms = together(seeds, fly, &beside);
  int flown = 0;
  for (int i = 0; i < seeds; i++) {
    ROW("%s, kind %d, %s, seed %d", as->scenario, (int)as->kind, as->noise, i + 1);
    if (i % step == 0) CHECK(same(alone.text[i], beside.text[i]));
    flown += beside.text[i] != NULL;
    free(alone.text[i]);
    free(beside.text[i]);
  }
  return flown;
}

TEST(together_flights_come_to_what_they_come_to_alone) {
  static const case_t rows[] = {
      {"test-flight", "real", FLY_INDI_RBF, INTEGRATE_RK4, true},
      {"touch-and-go", "flown", FLY_INDI_RBF, INTEGRATE_SUNDIALS, false}, // they touch, each at its time
      {"test-flight", "flown", FLY_INDI_LIVE, INTEGRATE_RK4, false},      // each learns at its time
      {"channel", "quiet", FLY_COUNT, INTEGRATE_RK4, false},              // by motion capture
      {"uneven-floor", "real", FLY_INDI_RBF, INTEGRATE_RK4, true},        // somebody stands between
      {"test-flight", "real", FLY_STOCK_PID, INTEGRATE_RK4, false},       // a pilot that is in no lane
  };
  for (unsigned i = 0; i < FEW_OR_ALL(rows, 3); i++) {
    long together_ms;
    CHECK(compare(&rows[i], LANES, &together_ms) == LANES);
    if (lane_possible() && rows[i].kind == FLY_INDI_RBF && i < 5) CHECK(together_ms > 100000);
  }
}

// A group ends one by one, and the next seeds begin a group of their own.
TEST(together_any_number_of_flights_comes_to_what_it_comes_to_alone) {
  static const case_t as = {"test-flight", "real", FLY_INDI_RBF, INTEGRATE_RK4, false};
  for (int n = TOGETHER_FEWEST - 1; n <= LANES + 1; n += 2) {
    long together_ms;
    CHECK(compare(&as, n, &together_ms) == n);
    CHECK((together_ms > 0) == (lane_possible() && n >= TOGETHER_FEWEST));
  }
}

TEST(together_every_scenario_with_every_controller_comes_to_what_it_comes_to_alone) {
  if (!test_long()) return;
  int flown = 0;
  for (int k = 0; k < scenario_count; k++)
    for (int kind = 0; kind < FLY_COUNT; kind++)
      for (int flies = 0; flies < 2; flies++) {
        const case_t as = {scenario_table[k]->name, flies ? "flown" : "real", (fly_kind_t)kind,
                           flies ? INTEGRATE_RK4 : INTEGRATE_SUNDIALS, false};
        long together_ms;
        flown += compare(&as, LANES, &together_ms);
      }
  CHECK(flown > scenario_count * LANES);
}
