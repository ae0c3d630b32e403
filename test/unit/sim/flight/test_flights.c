// test_flights.c - the thesis's flights in six degrees of freedom at noise `real`, fixed seeds
// (section 5.3, appendix C.3), by its own law and by the one that ships.
#include "base/lane.h"
#include "flight/scenario.h"
#include "flight/together.h"
#include "pilots/pilot_flight.h"
#include "rig/rig6.h"
#include "rig/share.h"
#include "rig/test.h"

#include <math.h>
#include <string.h>

#define SEEDS      (test_long() ? SEEDS_LONG : LANES) // no more than fly at once
#define SEEDS_LONG 10
#define LADDER     6 // segments of the close flight: 20, 10, 8, 6, 4, 2 cm
#define AT_4_CM    4
#define AT_2_CM    5
#define AT_3_CM    3 // of the test flight

static const request_t FAST = {.integrate = INTEGRATE_RK4};

typedef enum { SHIPPED, THESIS } whose_t;
static const char *const WHOSE[] = {"law that ships", "thesis's law"};

// The flight of that scenario, controller, law, noise and seed, as JSON; delete it after use.
static cJSON *fly_in(const char *scenario, fly_kind_t kind, whose_t law, const char *noise, uint64_t seed) {
  request_t request = FAST;
  request.noise = noise_find(noise);
  request.thesis_law = law == THESIS;
  request.kind = &kind;
  request.seed = seed;
  result_t result;
  why_t why;
  if (!CHECK_OK(result_init(&result, &why))) return NULL;
  CHECK_OK(scenario_find(scenario)->run(&request, &result, &why));
  cJSON *json = cJSON_Duplicate(result.json, true);
  result_free(&result);
  return json;
}

static cJSON *fly(const char *scenario, fly_kind_t kind, whose_t law, uint64_t seed) {
  return fly_in(scenario, kind, law, "real", seed);
}

// Flights of seeds from 1 on, eight at a time: each gets the bits that it gets alone (test_together.c).
typedef struct {
  const char *scenario, *noise;
  fly_kind_t kind;
  whose_t law;
  cJSON **json;
} flights_t;

static void fly_one(void *self, int i) {
  const flights_t *const f = self;
  f->json[i] = fly_in(f->scenario, f->kind, f->law, f->noise, 1 + (uint64_t)i);
}

// The close flights of a controller and law: what several tests look at is flown once.
static cJSON *const *close_flights(fly_kind_t kind, whose_t law) {
  static cJSON *flown[FLY_COUNT][2][SEEDS_LONG];
  if (!flown[kind][law][0])
    (void)together(SEEDS, fly_one, &(flights_t){"close-flight", "real", kind, law, flown[kind][law]});
  return flown[kind][law];
}

static double of(const cJSON *json, const char *table, int row, const char *key) {
  const cJSON *cell = cJSON_GetObjectItem(cJSON_GetArrayItem(cJSON_GetObjectItem(json, table), row), key);
  return cJSON_IsNumber(cell) ? cell->valuedouble : (double)NAN;
}

// Of the close flights: how many touched the ceiling in segments first..last.
static int touching(fly_kind_t kind, whose_t law, int first, int last) {
  int flights = 0;
  for (int k = 0; k < SEEDS; k++) {
    const cJSON *json = close_flights(kind, law)[k];
    CHECK(cJSON_IsTrue(cJSON_GetObjectItem(json, "finite")));
    double contacts = 0.0;
    for (int i = first; i <= last; i++) contacts += of(json, "segments", i, "contacts");
    flights += contacts > 0.0;
  }
  return flights;
}

TEST(flights6_standard_indi_holds_4_cm_and_touches_at_2_cm) {
  CHECK(touching(FLY_INDI, THESIS, 0, AT_4_CM) == 0);
  CHECK(touching(FLY_INDI, THESIS, AT_2_CM, LADDER - 1) >= SEEDS - 1);
}

static const struct {
  const char *what;
  fly_kind_t kind;
} adapted[] = {{"theory", FLY_INDI_THEORY}, {"fitted", FLY_INDI_RBF}, {"learned", FLY_INDI_LEARNED}};

#define ADAPTED (sizeof adapted / sizeof *adapted)

TEST(flights6_adapted_indi_stays_off_the_ceiling_at_2_cm) {
  for (unsigned i = 0; i < 2 * ADAPTED; i++) {
    const whose_t law = i / ADAPTED ? THESIS : SHIPPED;
    ROW("%s, %s", adapted[i % ADAPTED].what, WHOSE[law]);
    CHECK(touching(adapted[i % ADAPTED].kind, law, 0, LADDER - 1) == 0);
  }
}

typedef struct {
  double error_mm, rms_mm, tilt_deg; // of all together; the largest
} hover_t;

static hover_t hovers(fly_kind_t kind, whose_t law, int segment) {
  hover_t h = {0};
  double sum_mm2 = 0.0;
  for (int k = 0; k < SEEDS; k++) {
    const cJSON *json = close_flights(kind, law)[k];
    h.error_mm += of(json, "segments", segment, "mean_error_mm") / SEEDS;
    h.tilt_deg = fmax(h.tilt_deg, of(json, "segments", segment, "tilt_max_deg"));
    sum_mm2 += pow(of(json, "segments", segment, "rms_mm"), 2.0);
  }
  h.rms_mm = sqrt(sum_mm2 / SEEDS);
  return h;
}

TEST(flights6_thesis_law_hovers_level_and_4_mm_low_at_2_cm) {
  // Without the ceiling's term in roll and pitch 6 to 9 mm low, and tilts of 12 to 20 degrees. Of what is
  // left 1.9 mm is there without any noise (1.2 to 1.5 mm still to be climbed after 10 s), and the rest goes
  // with the wandering over the ground, which the bias observer's velocity makes wider (-2.4 mm without it).
  for (unsigned i = 0; i < ADAPTED; i++) {
    ROW("%s", adapted[i].what);
    const hover_t h = hovers(adapted[i].kind, THESIS, AT_2_CM);
    CHECK_NEAR(h.error_mm, -4.0, 0.8);
    CHECK(h.tilt_deg < 7.0);
  }
}

TEST(flights6_law_that_ships_hovers_at_2_cm_within_2_mm_of_where_it_was_told) {
  // The goal over many flights is 1.85 mm; ten have 0.1 mm of spread.
  for (unsigned i = 0; i < ADAPTED; i++) {
    ROW("%s", adapted[i].what);
    const hover_t h = hovers(adapted[i].kind, SHIPPED, AT_2_CM);
    CHECK(fabs(h.error_mm) < 0.8);
    CHECK(h.rms_mm < 2.1);
    CHECK(h.tilt_deg < 5.0);
  }
}

TEST(flights6_gains_of_the_law_that_ships_hold_2_cm_without_a_ceiling_term_too_and_less_well) {
  const hover_t plain = hovers(FLY_INDI, SHIPPED, AT_2_CM), adapts = hovers(FLY_INDI_RBF, SHIPPED, AT_2_CM);
  CHECK(touching(FLY_INDI, SHIPPED, 0, LADDER - 1) == 0);
  CHECK(plain.rms_mm > 1.2 * adapts.rms_mm);
  CHECK(plain.error_mm < adapts.error_mm - 0.5); // and lower
  CHECK(plain.rms_mm < 3.2);
}

// Of the flights that touched nothing: how many, and the mean of their standard deviations. One that
// touched bounces, and says nothing of how calm it was.
static double free_sd_mm(fly_kind_t kind, int segment, int *flights) {
  double sum = 0.0;
  cJSON *json[SEEDS_LONG] = {NULL};
  (void)together(SEEDS, fly_one, &(flights_t){"test-flight", "real", kind, THESIS, json});
  *flights = 0;
  for (int k = 0; k < SEEDS; k++) {
    if (cJSON_GetObjectItem(json[k], "contacts")->valueint == 0) {
      sum += of(json[k], "segments", segment, "sd_mm");
      ++*flights;
    }
    cJSON_Delete(json[k]);
  }
  return sum / *flights;
}

TEST(flights6_adapted_indi_by_the_thesis_law_is_calmer_at_3_cm) {
  int flights;
  const double standard_mm = free_sd_mm(FLY_INDI, AT_3_CM, &flights);
  CHECK(flights >= 5);
  for (unsigned i = 0; i < ADAPTED; i++) {
    ROW("%s", adapted[i].what);
    CHECK(free_sd_mm(adapted[i].kind, AT_3_CM, &flights) <= 0.6 * standard_mm);
    CHECK(flights >= 5);
  }
}

TEST(flights6_are_the_same_bits_for_the_same_seed) {
  for (int kind = 0; kind < FLY_COUNT; kind++) {
    if (!fly_name[kind] || kind == FLY_PID || kind == FLY_PID_FF) continue;
    ROW("%s", fly_name[kind]);
    char *text[3];
    for (int i = 0; i < 3; i++) {
      cJSON *json = fly("test-flight", (fly_kind_t)kind, SHIPPED, i == 2 ? 8 : 7);
      cJSON_DeleteItemFromObject(json, "realtime_factor");
      text[i] = cJSON_PrintUnformatted(json);
      cJSON_Delete(json);
    }
    CHECK_TEXT(text[0], text[1]);
    CHECK(strcmp(text[0], text[2]) != 0);
    for (int i = 0; i < 3; i++) cJSON_free(text[i]);
  }
}

typedef struct {
  rig6_t rig;
  pilot_flight_t state;
  pilot_t pilot;
  pilot_setpoint_t set;
} vehicle_t;

static void vehicle_init(vehicle_t *v, d3_t from_m, d3_t to_m) {
  rig6_param_t body = rig6_crazyflie();
  body.ceiling_m = 0.5;
  v->rig = rig6_at(&body, from_m, 0.0, true);
  flight_param_t param;
  params_default(&param);
  CHECK_OK(pilot_flight_init(&v->state, &param, NULL, &v->pilot));
  v->set = rig6_hold(to_m, 0.3);
}

static void vehicle_ms(vehicle_t *v) {
  const pilot_in_t in = rig6_sense(&v->rig, &v->set);
  double motor_N[PILOT_MOTORS];
  v->pilot.step(v->pilot.state, &in, motor_N);
  rig6_step(&v->rig, motor_N);
}

TEST(flights6_two_vehicles_in_one_process_do_not_know_of_each_other) {
  static vehicle_t alone, one, other;
  const d3_t from_m = {0.0, 0.0, 0.3}, to_m = {0.1, -0.1, 0.44}, away_m = {2.0, 1.0, 0.2};
  vehicle_init(&alone, from_m, to_m);
  vehicle_init(&one, from_m, to_m);
  vehicle_init(&other, away_m, from_m);
  for (int ms = 0; ms < 3000; ms++) vehicle_ms(&alone);
  for (int ms = 0; ms < 3000; ms++) {
    vehicle_ms(&one);
    vehicle_ms(&other);
  }
  CHECK(memcmp(&alone.rig.pos_w_m, &one.rig.pos_w_m, sizeof(d3_t)) == 0);
  CHECK(memcmp(&alone.rig.rate_b_radps, &one.rig.rate_b_radps, sizeof(d3_t)) == 0);
  CHECK(memcmp(alone.rig.force_N, one.rig.force_N, sizeof one.rig.force_N) == 0);
  CHECK(d3_norm(d3_sub(other.rig.pos_w_m, one.rig.pos_w_m)) > 0.1);
}

TEST(flights6_height_is_wrong_by_what_the_accelerometer_costs) {
  const uint64_t seeds[] = {1, 2, 3};
  for (unsigned s = 0; s < FEW_OR_ALL(seeds, 1); s++) {
    cJSON *json = fly("bias-hover", FLY_INDI, SHIPPED, seeds[s]);
    CHECK(cJSON_GetArraySize(cJSON_GetObjectItem(json, "bias")) == 4);
    for (int i = 0; i < 4; i++) {
      ROW("seed %d, %g m/s2", (int)seeds[s], of(json, "bias", i, "bias_mps2"));
      const double predicted_mm = of(json, "bias", i, "predicted_mm");
      CHECK_NEAR(predicted_mm, -151.2 * of(json, "bias", i, "bias_mps2"), 0.01);
      CHECK_NEAR(of(json, "bias", i, "error_mm"), predicted_mm, 0.1 * fabs(predicted_mm));
      CHECK_NEAR(of(json, "bias", i, "shift_mm"), predicted_mm, 0.1 * fabs(predicted_mm));
    }
    cJSON_Delete(json);
  }
}

TEST(flights6_gate_keeps_the_ceiling_where_it_is) {
  for (uint64_t seed = 1; seed <= SEEDS; seed++) {
    ROW("seed %d", (int)seed);
    const request_t request = {.seed = seed};
    result_t result;
    why_t why;
    if (!CHECK_OK(result_init(&result, &why))) return;
    CHECK_OK(scenario_find("hand-held")->run(&request, &result, &why));
    for (int i = 0; i < 10; i++) {
      const double gap_mm = of(result.json, "ceiling_height", i, "gap_mm");
      CHECK_NEAR(of(result.json, "ceiling_height", i, "stays_40_gate_mm"), 500.0, 5.0);
      CHECK_NEAR(of(result.json, "ceiling_height", i, "says_0_gate_mm"), 500.0, 5.0);
      if (gap_mm > 50.0) CHECK_NEAR(of(result.json, "ceiling_height", i, "says_0_no_gate_mm"), 500.0, 5.0);
    }
    CHECK(of(result.json, "ceiling_height", 9, "says_0_no_gate_mm") < 485.0);
    CHECK(of(result.json, "ceiling_height", 9, "stays_40_no_gate_mm") > 515.0);
    result_free(&result);
  }
}

// Reaches the ceiling at each of three pushes and is caught below it. Orders: 20 cm, 6 cm, and three times
// the ceiling's height and back. Pushing without a bound it winds up, and leans by 15 degrees or retreats.
static bool is_released_and_caught(const cJSON *json) {
  bool caught = true;
  for (int i = 2; i < 8; i += 2)
    caught = caught && of(json, "segments", i, "contacts") > 0.0 &&
             of(json, "segments", i, "min_gap_mm") < 10.0 &&
             of(json, "segments", i + 1, "overshoot_mm") < 50.0 &&
             of(json, "segments", i + 1, "rms_mm") < 20.0; // of all 5 s, the way down included
  return caught;
}

TEST(flights6_vehicle_that_pushes_against_a_ceiling_is_released_and_caught) {
  static const struct {
    const char *noise;
    double promised;
  } row[] = {{"real", 1.0}, {"flown", 0.97}};
  const fly_kind_t kind = FLY_INDI_RBF;
  for (unsigned k = 0; k < sizeof row / sizeof *row; k++) {
    cJSON *json[5 * LANES] = {NULL};
    const int flights = test_long() ? 5 * LANES : 2 * LANES;
    int caught = 0;
    (void)together(flights, fly_one, &(flights_t){"touch-and-go", row[k].noise, kind, SHIPPED, json});
    for (int i = 0; i < flights; i++) {
      caught += is_released_and_caught(json[i]);
      cJSON_Delete(json[i]);
    }
    ROW("%s", row[k].noise);
    CHECK_SHARE(caught, flights, row[k].promised);
  }
}
