// test_flyable.c - a vehicle whose sensors contradict each other is found before it flies.
#include "base/d3.h"
#include "flight/flyable.h"
#include "rig/splitmix.h"
#include "rig/test.h"

// What a wrong mount makes of a sensor's axes.
typedef void (*mount_t)(v3_t *a);
static void right_way(v3_t *a) {
  (void)a;
}
static void x_negated(v3_t *a) {
  a->x = -a->x;
}
static void y_negated(v3_t *a) {
  a->y = -a->y;
}
static void z_negated(v3_t *a) {
  a->z = -a->z;
}
static void x_y_swapped(v3_t *a) {
  const float x = a->x;
  a->x = a->y;
  a->y = x;
}
static void y_z_swapped(v3_t *a) {
  const float y = a->y;
  a->y = a->z;
  a->z = y;
}

typedef struct {
  const char *name;
  mount_t acc, gyro;
  unsigned reasons; // at least one of them; 0: flyable
} row_t;

static const row_t rows[] = {
    {"right", right_way, right_way, 0},
    {"acc x negated", x_negated, right_way, FLYABLE_TURN_X},
    {"acc y negated", y_negated, right_way, FLYABLE_TURN_Y},
    {"acc z negated", z_negated, right_way, FLYABLE_UP},
    {"acc x and y swapped", x_y_swapped, right_way, FLYABLE_TURN_X | FLYABLE_TURN_Y},
    {"acc y and z swapped", y_z_swapped, right_way, FLYABLE_UP},
    {"gyro x negated", right_way, x_negated, FLYABLE_TURN_Y},
    {"gyro y negated", right_way, y_negated, FLYABLE_TURN_X},
    {"gyro x and y swapped", right_way, x_y_swapped, FLYABLE_TURN_X | FLYABLE_TURN_Y},
    {"gyro y and z swapped", right_way, y_z_swapped, FLYABLE_TURN_X},
};

// Carried for 4 s, turned about all axes with the jolts of a hand, then put down; the estimate is
// right unless the accelerometer it rests on is not.
static unsigned carried(const row_t *row, uint64_t seed, double jolt_mps2) {
  splitmix_t r = {seed};
  flyable_t s;
  flyable_init(&s);
  dq_t q = {1.0, 0.0, 0.0, 0.0};
  for (int ms = 0; ms < 6000; ms++) {
    const double t = 1e-3 * ms;
    const bool moves = ms < 4000;
    const d3_t w =
        moves ? d3(1.2 * cos(1.8 * t), -1.2 * cos(3.1 * t + 0.4), 0.8 * sin(2.3 * t)) : d3(0.0, 0.0, 0.0);
    if (!moves) q = (dq_t){1.0, 0.0, 0.0, 0.0};
    const dq_t turn = dq_mul(q, (dq_t){0.0, w.x, w.y, w.z});
    q = dq_unit((dq_t){q.w + 5e-4 * turn.w, q.x + 5e-4 * turn.x, q.y + 5e-4 * turn.y, q.z + 5e-4 * turn.z});
    const double jolt = moves ? jolt_mps2 : 0.0, g = 9.81;
    d3_t a = dq_to_body(q, d3(jolt * sin(9.0 * t), jolt * sin(7.0 * t), g + jolt * sin(11.0 * t)));
    a = d3_add(a, d3(splitmix_normal(&r, 0.02), splitmix_normal(&r, 0.02), splitmix_normal(&r, 0.02)));
    v3_t acc = {(float)a.x, (float)a.y, (float)a.z}, rate = {(float)w.x, (float)w.y, (float)w.z};
    row->acc(&acc);
    row->gyro(&rate);
    flyable_step(&s, acc, rate, (quat_t){(float)q.w, (float)q.x, (float)q.y, (float)q.z});
  }
  return s.not_flyable;
}

TEST(a_sensor_that_is_mounted_the_wrong_way_round_is_found_while_the_vehicle_is_carried) {
  for (unsigned i = 0; i < sizeof rows / sizeof *rows; i++) {
    for (uint64_t seed = 1; seed <= 3; seed++) {
      const unsigned got = carried(&rows[i], seed, 0.5);
      ROW("%s, seed %u: %#x", rows[i].name, (unsigned)seed, got);
      CHECK(rows[i].reasons ? (got & rows[i].reasons) != 0 : got == 0);
    }
  }
}

TEST(a_vehicle_that_only_stood_still_is_judged_by_its_accelerometer_alone) {
  static const struct {
    const char *name;
    v3_t acc;
    unsigned want;
  } at_rest[] = {
      {"level", {0.0f, 0.0f, 9.81f}, 0},
      {"on a slope of 10 degrees, estimate still level", {1.7f, 0.0f, 9.66f}, 0},
      {"upside down", {0.0f, 0.0f, -9.81f}, FLYABLE_UP},
      {"half of g", {0.0f, 0.0f, 4.0f}, FLYABLE_UP},
      {"on its side", {9.81f, 0.0f, 0.0f}, FLYABLE_UP},
  };
  for (unsigned i = 0; i < sizeof at_rest / sizeof *at_rest; i++) {
    flyable_t s;
    flyable_init(&s);
    for (int ms = 0; ms < 1000; ms++)
      flyable_step(&s, at_rest[i].acc, (v3_t){0.0f, 0.0f, 0.0f}, (quat_t){.w = 1.0f});
    ROW("%s", at_rest[i].name);
    CHECK(s.not_flyable == at_rest[i].want);
  }
}

TEST(a_vehicle_on_its_side_is_not_flyable_though_its_estimate_agrees) {
  static const struct {
    float deg;
    unsigned want;
  } row[] = {{59.0f, 0}, {61.0f, FLYABLE_UP}};
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%g degrees", (double)row[i].deg);
    const float half = 0.5f * row[i].deg / 57.29578f;
    const quat_t q = {.w = cosf(half), .x = sinf(half)};
    const v3_t acc = quat_to_body(q, (v3_t){0.0f, 0.0f, 9.81f});
    flyable_t s;
    flyable_init(&s);
    for (int ms = 0; ms < 1000; ms++) flyable_step(&s, acc, (v3_t){0.0f, 0.0f, 0.0f}, q);
    CHECK(s.not_flyable == row[i].want);
  }
}

// What cannot be is left out: 100 rad/s can, beyond it a gyro is broken.
TEST(what_is_no_number_says_nothing_about_being_flyable) {
  flyable_t s, before;
  flyable_init(&s);
  before = s;
  flyable_step(&s, (v3_t){NAN, 0.0f, 9.81f}, (v3_t){0.0f, 0.0f, 0.0f}, (quat_t){.w = 1.0f});
  flyable_step(&s, (v3_t){0.0f, 0.0f, 9.81f}, (v3_t){INFINITY, 0.0f, 0.0f}, (quat_t){.w = 1.0f});
  flyable_step(&s, (v3_t){0.0f, 0.0f, 9.81f}, (v3_t){0.0f, 0.0f, 0.0f}, (quat_t){.w = NAN});
  flyable_step(&s, (v3_t){0.0f, 0.0f, 9.81f}, (v3_t){100.1f, 0.0f, 0.0f}, (quat_t){.w = 1.0f});
  CHECK(s.steady_s == before.steady_s && s.stretch_ms == before.stretch_ms && s.not_flyable == 0);
  flyable_step(&s, (v3_t){0.0f, 0.0f, 9.81f}, (v3_t){99.9f, 0.0f, 0.0f}, (quat_t){.w = 1.0f});
  CHECK(s.stretch_ms == 1);
}

// Stands still with this force along z until the wrong of it shows; -1: it never does.
static int ms_until_wrong(flyable_t *s, v3_t acc, float rate_radps) {
  for (int ms = 1; ms <= 2000; ms++) {
    flyable_step(s, acc, (v3_t){rate_radps, 0.0f, 0.0f}, (quat_t){.w = 1.0f});
    if (s->not_flyable != 0) return ms;
  }
  return -1;
}

TEST(a_wrong_up_is_told_after_so_long_and_taken_back_at_once) {
  static const struct {
    const char *what;
    v3_t acc;
    float rate_radps;
    int ms;
  } row[] = {
      {"3.9 m/s2 off", {3.9f, 0, 9.81f}, 0.0f, -1},   {"4.1 m/s2 off", {4.1f, 0, 9.81f}, 0.0f, 499},
      {"hardly turned", {4.1f, 0, 9.81f}, 0.1f, 499}, {"turned", {4.1f, 0, 9.81f}, 0.11f, -1},
      {"half of g and more", {0, 0, 5.9f}, 0.0f, -1}, {"too heavy", {0, 0, 14.0f}, 0.0f, 499},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    flyable_t s;
    flyable_init(&s);
    const int ms = ms_until_wrong(&s, row[i].acc, row[i].rate_radps);
    CHECK_NEAR(ms, row[i].ms, row[i].ms < 0 ? 0 : 1); // 200 ms still, 300 ms wrong
    if (ms < 0) continue;
    CHECK(s.not_flyable == FLYABLE_UP);
    flyable_step(&s, (v3_t){0, 0, 9.81f}, (v3_t){0, 0, 0}, (quat_t){.w = 1.0f});
    CHECK(s.not_flyable == 0);
  }
}

// Turned about y at a steady rate for some stretches of 0.1 s, as a sensor feels it whose x is k of the
// truth.
static unsigned turned(float rate_radps, int stretches, float k, float size_mps2) {
  flyable_t s;
  flyable_init(&s);
  for (int ms = 0; ms < 100 * stretches; ms++) {
    const float angle = rate_radps * 0.001f * (float)ms;
    const v3_t acc = {-k * size_mps2 * sinf(angle), 0.0f,
                      size_mps2 * sqrtf(1.0f - k * k * sinf(angle) * sinf(angle))};
    flyable_step(&s, acc, (v3_t){0.0f, rate_radps, 0.0f}, (quat_t){.w = 1.0f});
  }
  return s.not_flyable;
}

TEST(a_turn_tells_of_a_wrong_axis_from_so_much_on) {
  static const struct {
    const char *what;
    float rate_radps;
    int stretches;
    float k, size_mps2;
    unsigned want;
  } row[] = {
      {"right", 1.5f, 3, 1.0f, 9.81f, 0},
      {"the other way round", 1.5f, 3, -1.0f, 9.81f, FLYABLE_TURN_X},
      {"a third", 1.5f, 3, 0.35f, 9.81f, FLYABLE_TURN_X},
      {"a half", 1.5f, 3, 0.47f, 9.81f, 0},
      {"0.39, of which the turn shows 0.38", 1.5f, 3, 0.39f, 9.81f, FLYABLE_TURN_X},
      {"0.43, of which the turn shows 0.42", 1.5f, 3, 0.43f, 9.81f, 0},
      {"one stretch, (1.39 m/s2)^2", 1.42f, 1, -1.0f, 9.81f, 0},
      {"one stretch, (1.45 m/s2)^2", 1.49f, 1, -1.0f, 9.81f, FLYABLE_TURN_X},
      {"two of (1 m/s2)^2, one forgotten by 2 %", 1.02f, 2, -1.0f, 9.81f, 0},
      {"two of (1.1 m/s2)^2", 1.13f, 2, -1.0f, 9.81f, FLYABLE_TURN_X},
      {"too slow to say anything", 0.5f, 12, -1.0f, 9.81f, 0},
      {"just not too slow", 0.62f, 12, -1.0f, 9.81f, FLYABLE_TURN_X},
      {"a jolt upwards", 1.5f, 3, -1.0f, 12.9f, 0},
      {"a jolt downwards", 1.5f, 3, -1.0f, 6.7f, 0},
      {"not quite a jolt", 1.5f, 3, -1.0f, 12.7f, FLYABLE_TURN_X},
  };
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%s", row[i].what);
    CHECK((turned(row[i].rate_radps, row[i].stretches, row[i].k, row[i].size_mps2) & ~(unsigned)FLYABLE_UP) ==
          row[i].want);
  }
}

// One stretch more where almost enough was seen.
TEST(a_stretch_that_hardly_turned_adds_nothing) {
  static const struct {
    float rate_radps;
    bool adds;
  } row[] = {{0.49f, false}, {0.53f, true}}; // 0.48 and 0.52 m/s2
  for (unsigned i = 0; i < sizeof row / sizeof *row; i++) {
    ROW("%g rad/s", (double)row[i].rate_radps);
    flyable_t s;
    flyable_init(&s);
    s.turn_x.square = 1.9f;
    for (int ms = 0; ms < 100; ms++)
      flyable_step(&s, (v3_t){0.0f, 0.0f, 9.81f}, (v3_t){0.0f, row[i].rate_radps, 0.0f}, (quat_t){.w = 1.0f});
    CHECK((s.turn_x.square != 1.9f) == row[i].adds);
  }
}
